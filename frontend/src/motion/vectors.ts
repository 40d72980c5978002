// Vectors [x, y, z] and unit quaternions [x, y, z, w] as plain lists, for the few that are handled singly.

export type Vector = readonly number[];

export const add = (a: Vector, b: Vector): Vector => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
export const subtract = (a: Vector, b: Vector): Vector => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
export const scale = (s: number, a: Vector): Vector => [s * a[0], s * a[1], s * a[2]];
export const dot = (a: Vector, b: Vector): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const length = (a: Vector): number => Math.hypot(a[0], a[1], a[2]);
export const distance = (a: Vector, b: Vector): number => length(subtract(a, b));
export const unit = (a: Vector): Vector => scale(1 / Math.max(length(a), 1e-12), a);

export function cross(a: Vector, b: Vector): Vector {
  return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
}

/** The point at a share of the way from `a` to `b`. */
export function mix(a: Vector, b: Vector, share: number): Vector {
  return add(scale(1 - share, a), scale(share, b));
}

/** The sum of vectors, each with its factor. */
export function sum(...terms: readonly (readonly [number, Vector])[]): Vector {
  let x = 0;
  let y = 0;
  let z = 0;
  for (let i = 0; i < terms.length; i++) {
    const factor = terms[i][0];
    const v = terms[i][1];
    x += factor * v[0];
    y += factor * v[1];
    z += factor * v[2];
  }
  return [x, y, z];
}

/** `v` turned by the quaternion `q`. */
export function rotate(q: Vector, v: Vector): Vector {
  const x = q[0], y = q[1], z = q[2], w = q[3];
  const s = 2 * (y * v[2] - z * v[1]);
  const t = 2 * (z * v[0] - x * v[2]);
  const r = 2 * (x * v[1] - y * v[0]);
  return [v[0] + w * s + y * r - z * t, v[1] + w * t + z * s - x * r, v[2] + w * r + x * t - y * s];
}

/** The quaternion that turns by `b`, then by `a`. */
export function multiply(a: Vector, b: Vector): Vector {
  const x = a[0], y = a[1], z = a[2], w = a[3];
  const p = b[0], q = b[1], r = b[2], s = b[3];
  return [
    w * p + x * s + y * r - z * q,
    w * q - x * r + y * s + z * p,
    w * r + x * q - y * p + z * s,
    w * s - x * p - y * q - z * r,
  ];
}

export const conjugate = (q: Vector): Vector => [-q[0], -q[1], -q[2], q[3]];
