// Curves through keys of (seconds, value): a strength that changes over time. The same curve as mien.curve.

export type Key = [number, number];
export type Varying = number | number[][];

export const MOST = 2; // the strongest a layer can be
const SAME = 1e-6; // s; two keys cannot be at one moment

/** The keys of a curve; one number has none. */
export function keysOf(value: Varying): Key[] {
  return typeof value === "number" ? [] : value.map(([time, amount]) => [time, amount] as Key);
}

/**
 * The value at moments in seconds: the monotone cubic of Fritsch & Butland (1984) through the keys, level
 * before the first and after the last, as `mien.curve.evaluate`. Between keys it never goes beyond them.
 */
export function evaluate(value: Varying, at: ArrayLike<number>): Float64Array {
  const out = new Float64Array(at.length);
  if (typeof value === "number") return out.fill(value);
  const keys = keysOf(value);
  const slopes = keys.map((_, i) => slope(keys, i));
  for (let i = 0, k = 0; i < at.length; i++) {
    if (k > 0 && at[i] < keys[k - 1][0]) k = 0;
    while (k < keys.length && keys[k][0] <= at[i]) k++;
    if (k === 0) out[i] = keys[0][1];
    else if (k === keys.length) out[i] = keys[k - 1][1];
    else out[i] = cubic(keys[k - 1], keys[k], slopes[k - 1], slopes[k], at[i]);
  }
  return out;
}

/** The value at one moment. */
export function valueAt(value: Varying, time: number): number {
  return evaluate(value, [time])[0];
}

/** The slope at a key: a weighted harmonic mean of those beside it, 0 at a top, a bottom and the ends. */
function slope(keys: Key[], i: number): number {
  if (i === 0 || i === keys.length - 1) return 0;
  const before = keys[i][0] - keys[i - 1][0];
  const after = keys[i + 1][0] - keys[i][0];
  const rise = (keys[i][1] - keys[i - 1][1]) / before;
  const next = (keys[i + 1][1] - keys[i][1]) / after;
  if (rise * next <= 0) return 0;
  const one = 2 * after + before;
  const two = after + 2 * before;
  return (one + two) / (one / rise + two / next);
}

function cubic(from: Key, to: Key, leaving: number, arriving: number, at: number): number {
  const width = to[0] - from[0];
  const u = (at - from[0]) / width;
  const rise = to[1] - from[1];
  const a = width * leaving;
  const b = width * arriving;
  return from[1] + u * (a + u * (3 * rise - 2 * a - b + u * (a + b - 2 * rise)));
}

/** Add a key, or give the one at that moment the new value. The keys stay in order. */
export function add(value: Varying, time: number, amount: number): number[][] {
  const others = keysOf(value).filter(([other]) => Math.abs(other - time) > SAME);
  return [...others, [time, amount] as Key].sort((a, b) => a[0] - b[0]);
}

/** The key at a moment, or as near as `within` seconds; -1 where there is none. */
export function keyAt(value: Varying, time: number, within: number): number {
  return keysOf(value).findIndex(([other]) => Math.abs(other - time) <= within);
}

/** Set the value at a moment: of the key that is there, or of a new one. */
export function setAt(value: Varying, time: number, amount: number, within: number): number[][] {
  const there = keysOf(value)[keyAt(value, time, within)];
  return add(value, there ? there[0] : Number(time.toFixed(4)), amount);
}

/** Move a key; it stops `apart` seconds before its neighbours, at 0, at the end, and at 0 and `MOST`. */
export function move(
  value: Varying, index: number, time: number, amount: number, duration: number, apart = 0.001,
): number[][] {
  const keys = keysOf(value);
  const low = index > 0 ? keys[index - 1][0] + apart : 0;
  const high = index < keys.length - 1 ? keys[index + 1][0] - apart : Math.max(duration, low);
  keys[index] = [Math.min(Math.max(time, low), high), Math.min(Math.max(amount, 0), MOST)];
  return keys;
}

/** Remove a key. The last one leaves its value behind as one number. */
export function remove(value: Varying, index: number): Varying {
  const keys = keysOf(value);
  const [gone] = keys.splice(index, 1);
  return keys.length ? keys : gone[1];
}

/** A curve as a person writes it: `0:0,1.5:1`; the same as mien.curve.shown. */
export function shownCurve(value: Varying): string {
  const short = (number: number) => String(Number(number.toPrecision(6)));
  if (typeof value === "number") return short(value);
  return value.map(([time, amount]) => `${short(time)}:${short(amount)}`).join(",");
}

/** What is wrong with a curve as text, or "". */
export function curveProblem(text: string): string {
  try {
    parseCurve(text);
    return "";
  } catch (problem) {
    return (problem as Error).message;
  }
}

/** Read a number or a curve from text; throws with what is wrong. */
export function parseCurve(text: string): Varying {
  const number = (part: string) => {
    const found = part.trim() === "" ? NaN : Number(part);
    if (!Number.isFinite(found)) throw new Error("A number, or times with values such as 0:0,1.5:1.");
    return found;
  };
  if (!text.includes(":")) return number(text);
  const keys = text.split(",").map((key) => {
    const parts = key.split(":");
    if (parts.length !== 2) throw new Error("A number, or times with values such as 0:0,1.5:1.");
    return parts.map(number);
  });
  for (let i = 1; i < keys.length; i++)
    if (keys[i][0] <= keys[i - 1][0]) throw new Error("The times of the keys must go up.");
  return keys;
}
