// Curves of many frames on few pixels: a line where frames are few, else lowest and highest of each column.
import type { Curve } from "../messages";
import type { View } from "./view";

const DENSE = 2; // frames a pixel from which a line would only be a blot

/** The first index whose time is at or after `time`. */
export function indexAt(times: ArrayLike<number>, time: number): number {
  let low = 0;
  let high = times.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (times[middle] < time) low = middle + 1;
    else high = middle;
  }
  return low;
}

/** The frames in view, to both edges and beyond. */
function stretch(times: ArrayLike<number>, view: View): [number, number] {
  return [Math.max(indexAt(times, view.start) - 1, 0), Math.min(indexAt(times, view.end) + 1, times.length)];
}

export function isDense(times: ArrayLike<number>, view: View, width: number): boolean {
  const [from, to] = stretch(times, view);
  return to - from > DENSE * width;
}

/** The points of a line, as (pixel, value) one after the other. */
export function points(
  times: ArrayLike<number>, values: ArrayLike<number>, view: View, width: number,
): number[] {
  const [from, to] = stretch(times, view);
  const scale = width / (view.end - view.start);
  const out: number[] = [];
  for (let i = from; i < to; i++) out.push((times[i] - view.start) * scale, values[i]);
  return out;
}

/** What a column of pixels has to show: no peak is lost, were it one frame long. */
export interface Column {
  pixel: number;
  low: number;
  high: number;
}

/** The lowest and highest value of every column that has frames. What is no number is left out. */
export function columns(
  times: ArrayLike<number>, values: ArrayLike<number>, view: View, width: number,
): Column[] {
  const [from, to] = stretch(times, view);
  const scale = width / (view.end - view.start);
  const out: Column[] = [];
  for (let i = from; i < to; i++) {
    const value = values[i];
    if (!Number.isFinite(value)) continue;
    const pixel = Math.floor((times[i] - view.start) * scale);
    const last = out.at(-1);
    if (last?.pixel !== pixel) out.push({ pixel, low: value, high: value });
    else if (value < last.low) last.low = value;
    else if (value > last.high) last.high = value;
  }
  return out;
}

const ROOM: Record<string, number> = { cm: 2, "m/s": 0.1, degrees: 2 };
const LEAST = 0.2; // of valence and arousal, which have no unit
const START = 0.15; // seconds in which a clip may come out of a pose that is no part of it, as captures do
const FAR = 3; // times the range of all the rest

/** The least range of an axis: what is smaller is noise, and not to be magnified. */
export function leastRange(unit: string): number {
  return ROOM[unit] ?? LEAST;
}

/** Lowest and highest of several series, at least `least` apart. */
export function extent(least: number, ...series: ArrayLike<number>[]): [number, number] {
  let low = Infinity;
  let high = -Infinity;
  for (const values of series)
    for (let i = 0; i < values.length; i++) {
      if (values[i] < low) low = values[i];
      if (values[i] > high) high = values[i];
    }
  if (low > high) return [0, 1];
  const short = (least - (high - low)) / 2;
  if (short <= 0) return [low, high];
  const down = low >= 0 ? Math.min(short, low) : short; // what is never negative needs no axis below 0
  return [low - down, low - down + least];
}

/** The axis of a curve. A jump out of another pose at the start runs out of the picture (see `beyond`). */
export function axisOf({ before_times, before, after_times, after, unit }: Curve): [number, number] {
  const whole = extent(leastRange(unit), before, after);
  const from = (times: number[], values: number[]) => values.slice(indexAt(times, START));
  const [first, second] = [from(before_times, before), from(after_times, after)];
  if (!first.length && !second.length) return whole;
  const later = extent(leastRange(unit), first, second);
  return whole[1] - whole[0] > FAR * (later[1] - later[0]) ? later : whole;
}

/** What runs out of the picture: the farthest value above or below the axis, and when; null where all is in it. */
export function beyond(curve: Curve, low: number, high: number): { time: number; value: number } | null {
  let found: { time: number; value: number } | null = null;
  let most = 0;
  const series = [[curve.before_times, curve.before], [curve.after_times, curve.after]] as const;
  for (const [times, values] of series)
    values.forEach((value, i) => {
      const out = Math.max(value - high, low - value);
      if (!(out > most)) return; // what is no number neither
      most = out;
      found = { time: times[i], value };
    });
  return found;
}

/** A value with as many decimals as the range of its axis deserves. */
export function readable(value: number, low: number, high: number): string {
  const digits = Math.min(Math.max(Math.ceil(-Math.log10((high - low) / 50 || 1)), 0), 3);
  const text = value.toFixed(digits);
  return (Number(text) === 0 ? (0).toFixed(digits) : text).replace("-", "−");
}

/** Where a value stands in a lane. */
export type Height = (value: number) => number;

export function heights(low: number, high: number, height: number, margin = 2): Height {
  return (value) => height - margin - ((value - low) / (high - low)) * (height - 2 * margin);
}

/** The path of `points`; gaps where a value is no number. */
export function line(found: number[], y: Height): string {
  let out = "";
  let pen = false;
  for (let i = 0; i < found.length; i += 2) {
    const at = y(found[i + 1]);
    if (Number.isFinite(at)) out += `${pen ? "L" : "M"}${found[i].toFixed(1)} ${at.toFixed(1)}`;
    pen = Number.isFinite(at);
  }
  return out;
}

/** The outline of `columns`: along the highest values and back along the lowest. */
export function band(found: Column[], y: Height): string {
  if (!found.length) return "";
  const there = found.map(({ pixel, high }) => `${pixel + 0.5} ${(y(high) - 0.5).toFixed(1)}`);
  const back = found.map(({ pixel, low }) => `${pixel + 0.5} ${(y(low) + 0.5).toFixed(1)}`);
  return `M${there.join("L")}L${back.reverse().join("L")}Z`;
}

/** The value at a moment, between the two nearest points; null where there is none. */
export function valueAt(times: ArrayLike<number>, values: ArrayLike<number>, time: number): number | null {
  if (times.length === 0) return null;
  const i = indexAt(times, time);
  if (i === 0) return values[0];
  if (i === times.length) return values[i - 1];
  const share = (time - times[i - 1]) / (times[i] - times[i - 1]);
  return values[i - 1] + share * (values[i] - values[i - 1]);
}
