// Something for every widget to show: a made-up walk with known numbers.
import type { CheckInfo, Curve, Layer, ParameterInfo, Word } from "../messages";

const AT: [string, number, number][] = [
  ["neutral", 0, 0], ["afraid", -0.34, 0.64], ["angry", -0.523, 0.585], ["annoyed", -0.545, 0.412],
  ["astonished", 0.158, 0.89], ["at ease", 0.59, -0.26], ["bored", -0.664, -0.635], ["calm", 0.562, -0.305],
  ["excited", 0.618, 0.757], ["frustrated", -0.645, 0.51], ["happy", 0.826, 0.526],
  ["miserable", -0.696, -0.078], ["nervous", -0.63, 0.27], ["pleased", 0.771, 0.185],
  ["relaxed", 0.689, -0.453], ["sad", -0.648, -0.267], ["satisfied", 0.72, -0.35],
  ["sleepy", 0.279, -0.671], ["tired", 0.043, -0.628],
];
export const WORDS: Word[] = AT.map(([name, valence, arousal]) => ({ name, valence, arousal }));

const plain = {
  default: 0, low: null, high: null, neutral: null, unit: "", choices: [], optional: false,
} satisfies Partial<ParameterInfo>;

export const PARAMETERS: ParameterInfo[] = [
  { ...plain, name: "hips_height", kind: "number", doc: "hips higher (+) or lower (−)", low: -0.5,
    high: 0.1, neutral: 0, unit: "leg lengths" },
  { ...plain, name: "seed", kind: "whole", doc: "which wandering: another number, another one", low: 0 },
  { ...plain, name: "fps", kind: "number", doc: "new rate; none keeps it", default: null, low: 0.001,
    high: 10000, unit: "frames a second", optional: true },
  { ...plain, name: "rests", kind: "flag", doc: "acceleration also lengthens long rests", default: true },
  { ...plain, name: "mode", kind: "choice", doc: "blend the maps of time, or the four motions",
    default: "timemap", choices: ["timemap", "bilinear"] },
  { ...plain, name: "method", kind: "choice", doc: "how the change is added to each joint",
    default: "anatomical", choices: ["anatomical", "additive", "body_fixed"] },
  { ...plain, name: "limbs", kind: "list", doc: "limbs to retime", default: null, optional: true,
    choices: ["left_arm", "right_arm", "head", "left_leg", "right_leg"] },
  { ...plain, name: "pose", kind: "text", doc: "a named pose or one in a line", default: "none" },
  { ...plain, name: "amount", kind: "number", doc: "how much, over time", low: 0, high: 2, neutral: 1,
    default: [[0, 0], [1.5, 1]] },
];

export const PARTS = ["head", "torso", "left_arm", "right_arm", "left_leg", "right_leg"];

const layer = {
  kind: "edit", parameters: {}, strength: 1, parts: [], span: null, ease: 0.25, on: true, solo: false,
} satisfies Partial<Layer>;

export const LAYERS: Layer[] = [
  { ...layer, id: "a", kind: "emotion", name: "tired" },
  { ...layer, id: "b", name: "posture", span: [1, 4.5], ease: 0.5 },
  { ...layer, id: "c", name: "path_length", span: [3, 6], ease: 0.25, on: false },
];

const limit = { unit: "", digits: 2, source: 0.1, passed: false };

export const CHECKS: CheckInfo[] = [
  { ...limit, name: "slide", label: "foot slide", value: 0.4, allowed: 0.2,
    marks: [{ start: 1.2, end: 1.5, worst: 1.35, parts: ["left_leg"] },
      { start: 5.8, end: 6.4, worst: 6, parts: ["right_leg"] }] },
  { ...limit, name: "jerk", label: "jerk", value: 1, allowed: 2, passed: true, marks: [] },
];

/** Both feet of a walk, 1.1 s a stride; `late` seconds later. */
export function feet(frames: number, frameTime: number, late: number): Uint8Array {
  const out = new Uint8Array(2 * frames);
  for (let i = 0; i < frames; i++) {
    const phase = (i * frameTime - late) / 1.1;
    out[2 * i] = phase - Math.floor(phase) < 0.6 ? 1 : 0;
    out[2 * i + 1] = phase + 0.5 - Math.floor(phase + 0.5) < 0.6 ? 1 : 0;
  }
  return out;
}

export function curve(name: string, unit: string, frames: number, frameTime: number, size: number): Curve {
  const times = Array.from({ length: frames }, (_, i) => i * frameTime);
  const before = times.map((t) => size * (1 + 0.1 * Math.sin(11.4 * t) + 0.03 * Math.sin(41 * t)));
  const after = times.map((t, i) => 0.95 * before[i] - 0.04 * size * Math.cos(3 * t));
  return { name, unit, before_times: times, before, after_times: times, after };
}
