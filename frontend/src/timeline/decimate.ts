// Curves of many frames on few pixels: lowest and highest value of each column, so no peak is lost.
import type { View } from "./view";

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

/**
 * The points to draw, as (pixel, value) one after the other: all of them where they are few, else the first, the
 * lowest, the highest and the last of each column, in their order. One point beyond each edge is kept.
 */
export function decimate(times: ArrayLike<number>, values: ArrayLike<number>, view: View, width: number): number[] {
  const from = Math.max(indexAt(times, view.start) - 1, 0);
  const to = Math.min(indexAt(times, view.end) + 1, times.length);
  const scale = width / (view.end - view.start);
  const out: number[] = [];
  if (to - from <= 2 * width) {
    for (let i = from; i < to; i++) out.push((times[i] - view.start) * scale, values[i]);
    return out;
  }
  let i = from;
  while (i < to) {
    const column = Math.floor((times[i] - view.start) * scale);
    const first = i;
    let low = i;
    let high = i;
    for (; i < to && Math.floor((times[i] - view.start) * scale) === column; i++) {
      if (values[i] < values[low]) low = i;
      if (values[i] > values[high]) high = i;
    }
    const kept = [first, Math.min(low, high), Math.max(low, high), i - 1];
    kept.forEach((k, n) => {
      if (n === 0 || k !== kept[n - 1]) out.push((times[k] - view.start) * scale, values[k]);
    });
  }
  return out;
}

/** Lowest and highest of several series; a level one gets some room. */
export function extent(...series: ArrayLike<number>[]): [number, number] {
  let low = Infinity;
  let high = -Infinity;
  for (const values of series)
    for (let i = 0; i < values.length; i++) {
      if (values[i] < low) low = values[i];
      if (values[i] > high) high = values[i];
    }
  if (low > high) return [0, 1];
  if (high - low > 1e-9 * Math.max(Math.abs(low), Math.abs(high), 1e-9)) return [low, high];
  const room = Math.max(Math.abs(low) * 0.05, 1e-3);
  return [low - room, high + room];
}

/** The path of points from `decimate`, `height` pixels high; gaps where a value is no number. */
export function path(points: number[], low: number, high: number, height: number, margin = 2): string {
  let out = "";
  let pen = false;
  for (let i = 0; i < points.length; i += 2) {
    const y = height - margin - ((points[i + 1] - low) / (high - low)) * (height - 2 * margin);
    if (Number.isFinite(y)) out += `${pen ? "L" : "M"}${points[i].toFixed(1)} ${y.toFixed(1)}`;
    pen = Number.isFinite(y);
  }
  return out;
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
