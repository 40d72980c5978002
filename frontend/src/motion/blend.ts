// Where poses come from: a clip, or the weighted mean of several motions of one skeleton, mixed as they play.
import type { Frames } from "../messages";
import { clamp } from "../playback";
import type { Clip } from "../wire";
import { newPose, normalise, poseAt, type Pose } from "./pose";

/** A motion that can be asked for its pose at any time. */
export interface PoseSource {
  readonly head: Frames;
  readonly frames: number;
  readonly frameTime: number;
  /** Seconds from the first frame to the last. */
  readonly duration: number;
  /** Write the pose at a time into `out`; before the start and after the end it holds. */
  pose(seconds: number, out: Pose): Pose;
  /** Whether the left and the right foot stand at a time. */
  contacts(seconds: number): readonly [boolean, boolean];
}

export interface Weighted {
  readonly source: PoseSource;
  readonly weight: number;
}

/** A clip as it is. */
export function clipSource(clip: Clip): PoseSource {
  const { head } = clip;
  const duration = (head.frames - 1) * head.frame_time;
  return {
    head,
    frames: head.frames,
    frameTime: head.frame_time,
    duration,
    pose: (seconds, out) => poseAt(clip, seconds / head.frame_time, out),
    contacts: (seconds) => {
      const frame = clamp(Math.round(seconds / head.frame_time), 0, head.frames - 1) || 0;
      return [clip.contacts[2 * frame] > 0, clip.contacts[2 * frame + 1] > 0];
    },
  };
}

/**
 * The weighted mean of motions of the same skeleton: weights are divided by their sum, and may lie outside 0..1 to go
 * beyond a motion. Motions that take differently long are met at the same share of their time, and the mean takes
 * their mean duration. Rotations are added with equal signs and made unit again.
 */
export function blended(parts: readonly Weighted[]): PoseSource {
  const total = parts.reduce((sum, part) => sum + part.weight, 0);
  if (!parts.length || Math.abs(total) < 1e-9) throw new Error("a blend needs weights with a sum above 0");
  const joints = parts[0].source.head.joints.length;
  if (parts.some(({ source }) => source.head.joints.length !== joints)) {
    throw new Error("a blend needs motions of one skeleton");
  }
  const most = parts.reduce((best, part) => (part.weight > best.weight ? part : best)).source;
  const used = parts
    .map(({ source, weight }) => ({ source, weight: weight / total }))
    .filter(({ weight }) => Math.abs(weight) > 1e-9)
    .sort((a, b) => b.weight - a.weight);
  if (used.length === 1) return used[0].source;
  const duration = used.reduce((sum, { source, weight }) => sum + weight * source.duration, 0);
  const frameTime = most.frameTime;
  const share = (seconds: number): number => (duration > 0 ? clamp(seconds / duration, 0, 1) : 0);
  const one = newPose(joints);
  return {
    head: most.head,
    frames: Math.round(duration / frameTime) + 1,
    frameTime,
    duration,
    contacts: (seconds) => most.contacts(share(seconds) * most.duration),
    pose: (seconds, out) => {
      out.rotations.fill(0);
      out.translations.fill(0);
      for (const { source, weight } of used) {
        accumulate(source.pose(share(seconds) * source.duration, one), weight, out);
      }
      for (let at = 0; at < out.rotations.length; at += 4) normalise(out.rotations, at);
      return out;
    },
  };
}

/** Add a pose with its weight to a sum; each rotation with the sign that is nearest to the sum so far. */
function accumulate(pose: Pose, weight: number, out: Pose): void {
  const { rotations: q, translations: v } = pose;
  const { rotations: sum, translations: moved } = out;
  for (let i = 0; i < q.length; i += 4) {
    const same = q[i] * sum[i] + q[i + 1] * sum[i + 1] + q[i + 2] * sum[i + 2] + q[i + 3] * sum[i + 3];
    const w = same < 0 ? -weight : weight;
    sum[i] += w * q[i];
    sum[i + 1] += w * q[i + 1];
    sum[i + 2] += w * q[i + 2];
    sum[i + 3] += w * q[i + 3];
  }
  for (let i = 0; i < v.length; i++) moved[i] += weight * v[i];
}

/** The weights of a three by three lattice, row by row, at a point with coordinates from 0 to 2. */
export function latticeWeights(across: number, up: number): number[] {
  const p = clamp(across, 0, 2);
  const q = clamp(up, 0, 2);
  const weights: number[] = [];
  for (let row = 0; row < 3; row++) {
    for (let column = 0; column < 3; column++) {
      weights.push(Math.max(0, 1 - Math.abs(p - column)) * Math.max(0, 1 - Math.abs(q - row)));
    }
  }
  return weights;
}
