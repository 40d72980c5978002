// One number of the stack that a hand may move next: motions at its lowest, its present and its highest
// value, which the page blends between while the number is on its way.
import type { Stack } from "../messages";
import type { Clip } from "../wire";
import { change, find } from "./stack";

/** A ranged number: a layer's parameter by its name; without a name its strength; of no layer the whole's. */
export interface Knob {
  readonly layer: string;
  readonly name: string;
  readonly low: number;
  readonly high: number;
}

export interface Point {
  readonly value: number;
  readonly motion: Clip;
}

/** The motions of one knob, from its lowest value up; all else of the stack is as in `rest`. */
export interface Rail {
  readonly knob: Knob;
  readonly rest: string;
  readonly points: readonly Point[];
}

export interface Part {
  readonly motion: Clip;
  readonly weight: number;
}

/** What a knob says in a stack; null where it is not there, or is no plain number. */
export function valueAt(stack: Stack, { layer, name }: Knob): number | null {
  const there = layer ? find(stack, layer) : stack;
  const value = name ? find(stack, layer)?.parameters[name] : there?.strength;
  return typeof value === "number" ? value : null;
}

/** The stack with the knob at a value. */
export function withValue(stack: Stack, { layer, name }: Knob, value: number): Stack {
  if (!layer) return { ...stack, strength: value };
  const there = find(stack, layer);
  if (!there) return stack;
  const fields = name ? { parameters: { ...there.parameters, [name]: value } } : { strength: value };
  return change(stack, layer, fields);
}

/** All of a stack but the knob's number, as text: two that agree differ in nothing else. */
export function restOf(stack: Stack, { layer, name }: Knob): string {
  if (!layer) return JSON.stringify({ ...stack, strength: 0 });
  const layers = stack.layers.map((one) => {
    if (one.id !== layer) return one;
    if (!name) return { ...one, strength: 0 };
    const others = Object.entries(one.parameters).filter(([key]) => key !== name);
    return { ...one, parameters: others.sort(([a], [b]) => (a < b ? -1 : 1)) };
  });
  return JSON.stringify({ ...stack, layers });
}

/**
 * The values that a rail is laid through: both ends, where the knob stands, and halfway to each end. Straight
 * mixing between ends alone would be off by up to a fifth of a leg (`posture lean` over its whole range).
 */
export function stops(stack: Stack, knob: Knob): number[] {
  const { low, high } = knob;
  const now = Math.min(Math.max(valueAt(stack, knob) ?? low, low), high);
  return [...new Set([low, (low + now) / 2, now, (now + high) / 2, high])];
}

/**
 * What to mix for a stack: the two motions that its value lies between. The motion that was made last
 * counts as one of the rail's where it differs in nothing but the number. Null where the stack is not on it.
 */
export function mixture(rail: Rail, made: { motion: Clip; stack: Stack } | null, wanted: Stack): Part[] | null {
  const { knob, rest } = rail;
  const value = valueAt(wanted, knob);
  if (value === null || restOf(wanted, knob) !== rest) return null;
  const points = made && restOf(made.stack, knob) === rest ? joined(rail.points, made, knob) : rail.points;
  const above = points.findIndex((point) => point.value >= value);
  if (above <= 0) return [{ motion: points.at(above)!.motion, weight: 1 }];
  const [before, after] = [points[above - 1]!, points[above]!];
  const weight = (value - before.value) / (after.value - before.value);
  return [
    { motion: before.motion, weight: 1 - weight },
    { motion: after.motion, weight },
  ];
}

/** The points with that of what was made, which takes the place of one at its value. */
function joined(points: readonly Point[], made: { motion: Clip; stack: Stack }, knob: Knob): Point[] {
  const value = valueAt(made.stack, knob)!;
  const others = points.filter((point) => point.value !== value);
  return [...others, { value, motion: made.motion }].sort((a, b) => a.value - b.value);
}
