// One moment of a motion: local rotations and translations, and where that puts the joints.
import { clamp } from "../playback";
import type { Clip } from "../wire";
import type { Vector } from "./vectors";

/** Local rotations (J, 4) from child to parent, xyzw, and translations (J, 3) from the parent. */
export interface Pose {
  readonly rotations: Float64Array;
  readonly translations: Float64Array;
}

/** World rotations (J, 4) and positions (J, 3), in the clip's own axes and unit. */
export interface World {
  readonly rotations: Float64Array;
  readonly positions: Float64Array;
}

export function newPose(joints: number): Pose {
  return { rotations: new Float64Array(4 * joints), translations: new Float64Array(3 * joints) };
}

export function newWorld(joints: number): World {
  return { rotations: new Float64Array(4 * joints), positions: new Float64Array(3 * joints) };
}

/** Write the pose at a frame, which may lie between two, into `out`; before the first and after the last it holds. */
export function poseAt(clip: Clip, frame: number, out: Pose): Pose {
  const { head, rotations, translations, offsets } = clip;
  const joints = head.joints.length;
  const moving = head.moving.length;
  const at = clamp(frame, 0, head.frames - 1) || 0;
  const before = Math.floor(at);
  const share = at - before;
  const after = Math.min(before + 1, head.frames - 1);
  for (let i = 0, a = 4 * joints * before, b = 4 * joints * after; i < 4 * joints; i += 4, a += 4, b += 4) {
    between(rotations, a, rotations, b, share, out.rotations, i);
  }
  out.translations.set(offsets);
  for (let m = 0; m < moving; m++) {
    const a = 3 * (moving * before + m);
    const b = 3 * (moving * after + m);
    const to = 3 * head.moving[m];
    for (let i = 0; i < 3; i++) {
      out.translations[to + i] = (1 - share) * translations[a + i] + share * translations[b + i];
    }
  }
  return out;
}

/** Write the unit quaternion at a share of the way between two, the short way round. */
function between(
  from: Float32Array, a: number, to: Float32Array, b: number, share: number, out: Float64Array, at: number,
): void {
  const same = from[a] * to[b] + from[a + 1] * to[b + 1] + from[a + 2] * to[b + 2] + from[a + 3] * to[b + 3];
  const second = same < 0 ? -share : share;
  for (let i = 0; i < 4; i++) out[at + i] = (1 - share) * from[a + i] + second * to[b + i];
  normalise(out, at);
}

/** Make the quaternion that starts at `at` unit; where it is nothing, no turn at all. */
export function normalise(q: Float64Array, at: number): void {
  const length = Math.hypot(q[at], q[at + 1], q[at + 2], q[at + 3]);
  if (length < 1e-12) return q.set([0, 0, 0, 1], at);
  for (let i = 0; i < 4; i++) q[at + i] /= length;
}

/** Write the world transforms of a pose into `out`. */
export function fk(pose: Pose, parents: readonly number[], out: World): World {
  const { rotations: local, translations: moved } = pose;
  const { rotations: turned, positions } = out;
  for (let j = 0; j < parents.length; j++) {
    const p = parents[j];
    const q = 4 * j;
    const v = 3 * j;
    if (p < 0) {
      for (let i = 0; i < 4; i++) turned[q + i] = local[q + i];
      for (let i = 0; i < 3; i++) positions[v + i] = moved[v + i];
      continue;
    }
    const x = turned[4 * p], y = turned[4 * p + 1], z = turned[4 * p + 2], w = turned[4 * p + 3];
    const a = local[q], b = local[q + 1], c = local[q + 2], d = local[q + 3];
    turned[q] = w * a + x * d + y * c - z * b;
    turned[q + 1] = w * b - x * c + y * d + z * a;
    turned[q + 2] = w * c + x * b - y * a + z * d;
    turned[q + 3] = w * d - x * a - y * b - z * c;
    const k = moved[v], l = moved[v + 1], m = moved[v + 2];
    const s = 2 * (y * m - z * l), t = 2 * (z * k - x * m), r = 2 * (x * l - y * k);
    positions[v] = positions[3 * p] + k + w * s + y * r - z * t;
    positions[v + 1] = positions[3 * p + 1] + l + w * t + z * s - x * r;
    positions[v + 2] = positions[3 * p + 2] + m + w * r + x * t - y * s;
  }
  return out;
}

/** Where a joint is. */
export function positionOf(world: World, joint: number): Vector {
  const { positions } = world;
  return [positions[3 * joint], positions[3 * joint + 1], positions[3 * joint + 2]];
}

/** How a joint is turned. */
export function rotationOf(world: World, joint: number): Vector {
  const { rotations } = world;
  return [rotations[4 * joint], rotations[4 * joint + 1], rotations[4 * joint + 2], rotations[4 * joint + 3]];
}
