// How a motion goes through the room, in metres with Y up and the floor at 0: the path on the floor, where it faces,
// where its feet stand, and the paths of single joints. Looked at once for a motion, at evenly spaced times; the path
// by itself, because it is wanted anew for every step of a slider.
import type { Frames } from "../messages";
import type { PoseSource } from "../motion/blend";
import { fk, newPose, newWorld, positionOf } from "../motion/pose";
import { add, cross, dot, scale, subtract, unit, type Vector } from "../motion/vectors";
import { clamp } from "../playback";

export interface Footprint {
  side: "left" | "right";
  /** Seconds. */
  start: number;
  end: number;
  /** Metres on the floor. */
  x: number;
  z: number;
  /** Metres that the toe gets away from where it mostly is while the foot stands. */
  slide: number;
}

/** The path on the floor. */
export interface Way {
  /** Seconds from one sample to the next. */
  readonly step: number;
  readonly count: number;
  /** (N, 2) x and z, without the sway of single steps. */
  readonly ground: Float64Array;
}

export interface Travel {
  readonly step: number;
  readonly count: number;
  /** The first sample that is action, after a still such as a T-pose: nothing before it leaves a trace. */
  readonly first: number;
  /** The mean direction faced, as an angle about up from Z to X. */
  readonly facing: number;
  readonly footprints: readonly Footprint[];
  /** (N, 3) places of joints by role. */
  readonly trails: Readonly<Record<string, Float32Array>>;
  /** Lowest and highest x, y, z of the drawn joints over the motion. */
  readonly low: Vector;
  readonly high: Vector;
}

const MOST = 900; // samples
const COARSE = 1 / 12; // seconds from one sample of the way to the next: it is smooth, and wanted at once
const SMOOTH = 0.35; // seconds: how far the path is smoothed
export const SLIDES = 0.04; // metres from which a foot that stands is said to slide
const ROLLS = 0.15; // share of a stand at either end, in which a foot comes down or peels off
const MERGE = 0.06; // metres: a foot that moved less has not left its print
export const TRAILS = ["left_wrist", "right_wrist", "left_toe", "right_toe", "head"] as const;

/** Return a point of the clip in the room: metres, X to the left of the calm stance, Y up, Z where it faces. */
export function inRoom(head: Frames, point: Vector): Vector {
  const m = head.metres;
  return [m * dot(head.left, point), m * (dot(head.up, point) - head.floor), m * dot(head.forward, point)];
}

export function wayOf(source: PoseSource): Way {
  const { head, duration } = source;
  const count = Math.max(2, Math.min(Math.ceil(duration / COARSE) + 1, MOST));
  const step = duration / (count - 1) || source.frameTime;
  const pose = newPose(head.joints.length);
  const world = newWorld(head.joints.length);
  const middle = middleOf(head);
  const raw = new Float64Array(2 * count);
  for (let i = 0; i < count; i++) {
    fk(source.pose(i * step, pose), head.parents, world);
    const hips = inRoom(head, positionOf(world, middle));
    raw[2 * i] = hips[0];
    raw[2 * i + 1] = hips[2];
  }
  return { step, count, ground: smooth(raw, SMOOTH / step) };
}

/** The joint in the middle of the figure. */
function middleOf(head: Frames): number {
  return head.shape?.roles["hips"] ?? head.drawn[0] ?? 0;
}

export function travelOf(source: PoseSource): Travel {
  const { head } = source;
  const count = Math.max(2, Math.min(source.frames, MOST));
  const step = source.duration / (count - 1) || source.frameTime;
  const pose = newPose(head.joints.length);
  const world = newWorld(head.joints.length);
  const first = clamp(Math.ceil((head.still * head.frame_time) / step - 1e-6), 0, count - 1);
  const roles = head.shape?.roles ?? {};
  const joint = (role: string): number => roles[role] ?? roles[ELSE[role] ?? ""] ?? -1;
  const trails: Record<string, Float32Array> = {};
  for (const role of TRAILS) if (joint(role) >= 0) trails[role] = new Float32Array(3 * count);
  const range = { low: [Infinity, Infinity, Infinity], high: [-Infinity, -Infinity, -Infinity] };
  const prints = { left: new Prints("left"), right: new Prints("right") };
  let faced: Vector = [0, 0, 0];
  for (let i = 0; i < count; i++) {
    fk(source.pose(i * step, pose), head.parents, world);
    const at = (j: number): Vector => inRoom(head, positionOf(world, j));
    for (const role of Object.keys(trails)) trails[role].set(at(joint(role)), 3 * i);
    for (const j of head.drawn) extend(range, at(j));
    if (!head.shape || i < first) continue;
    for (const role of ["hip", "shoulder"]) {
      const side = subtract(at(roles[`left_${role}`]), at(roles[`right_${role}`]));
      faced = add(faced, unit(cross(side, [0, 1, 0])));
    }
    const stands = source.contacts(i * step);
    for (const [k, side] of (["left", "right"] as const).entries()) {
      const [toe, ankle] = [at(joint(`${side}_toe`)), at(joint(`${side}_ankle`))];
      prints[side].see(i * step, stands[k], scale(0.5, add(toe, ankle)), toe);
    }
  }
  const facing = Math.hypot(faced[0], faced[2]) > 0.2 * count ? Math.atan2(faced[0], faced[2]) : 0;
  const footprints = [...prints.left.done(), ...prints.right.done()];
  return { step, count, first, facing, footprints, trails, ...range };
}

/** What stands in where a skeleton lacks a role. */
const ELSE: Record<string, string> = {
  left_wrist: "left_elbow", right_wrist: "right_elbow", left_toe: "left_ankle", right_toe: "right_ankle", head: "neck",
};

/** Where the path on the floor is at a time: x and z. */
export function groundAt({ ground, count, step }: Way, seconds: number): readonly [number, number] {
  const at = Math.min(Math.max(seconds / step, 0), count - 1);
  const i = Math.min(Math.floor(at), count - 2);
  const share = at - i;
  const mixed = (k: number): number => (1 - share) * ground[2 * i + k] + share * ground[2 * i + 2 + k];
  return [mixed(0), mixed(1)];
}

/** Collects the places of one foot while it stands. */
class Prints {
  #found: Footprint[] = [];
  #points: Vector[] = [];
  #toes: Vector[] = [];
  #start = 0;
  #last = 0;

  constructor(readonly side: "left" | "right") {}

  see(seconds: number, stands: boolean, place: Vector, toe: Vector): void {
    if (!stands) return this.#close();
    if (!this.#points.length) this.#start = seconds;
    this.#points.push(place);
    this.#toes.push(toe);
    this.#last = seconds;
  }

  done(): Footprint[] {
    this.#close();
    return this.#found;
  }

  #close(): void {
    if (!this.#points.length) return;
    const [x, z] = middleOfAll(this.#points);
    const slide = slideOf(this.#toes);
    this.#toes = [];
    const before = this.#found[this.#found.length - 1];
    if (before && Math.hypot(before.x - x, before.z - z) < MERGE) {
      before.end = this.#last;
      before.slide = Math.max(before.slide, slide);
    } else this.#found.push({ side: this.side, start: this.#start, end: this.#last, x, z, slide });
    this.#points = [];
  }
}

/** The x and z that points have mostly. */
function middleOfAll(points: readonly Vector[]): readonly [number, number] {
  const middle = (k: number): number => points.map((p) => p[k]).sort((a, b) => a - b)[points.length >> 1];
  return [middle(0), middle(2)];
}

/** How far a toe gets from where it mostly is, but for the ends of the stand. */
export function slideOf(toes: readonly Vector[]): number {
  const ends = Math.round(ROLLS * toes.length);
  const standing = toes.slice(ends, Math.max(toes.length - ends, ends + 1));
  const [x, z] = middleOfAll(standing);
  return Math.max(...standing.map((toe) => Math.hypot(toe[0] - x, toe[2] - z)));
}

function extend(range: { low: number[]; high: number[] }, point: Vector): void {
  for (let k = 0; k < 3; k++) {
    range.low[k] = Math.min(range.low[k], point[k]);
    range.high[k] = Math.max(range.high[k], point[k]);
  }
}

/** Weigh pairs over their neighbours with a Gaussian of `sigma` samples; the ends are held. */
function smooth(pairs: Float64Array, sigma: number): Float64Array {
  const count = pairs.length / 2;
  const reach = Math.ceil(3 * Math.min(sigma, count));
  const weights = Array.from({ length: 2 * reach + 1 }, (_, i) => Math.exp(-0.5 * ((i - reach) / (sigma || 1)) ** 2));
  const total = weights.reduce((a, b) => a + b);
  const out = new Float64Array(pairs.length);
  for (let i = 0; i < count; i++) {
    for (let w = 0; w < weights.length; w++) {
      const from = Math.min(Math.max(i + w - reach, 0), count - 1);
      out[2 * i] += (weights[w] / total) * pairs[2 * from];
      out[2 * i + 1] += (weights[w] / total) * pairs[2 * from + 1];
    }
  }
  return out;
}
