// The square of nine motions: path length to the right, timing upwards, the original in the middle.
import { shown } from "../controls/number";
import { type Range, stepped } from "../controls/steps";

export type Point = readonly [path: number, timing: number];

export const AXIS: Range = { low: 0, high: 2, step: 0.05 };
export const ORIGINAL: Point = [1, 1];

export interface Corner {
  letter: string;
  path: number;
  timing: number;
  title: string;
}

/** The nine by their letters in the thesis; the same as NINE in src/mien/styles/grid.py. */
export const NINE: readonly Corner[] = [
  { letter: "A", path: 0, timing: 2, title: "short paths, constant speed" },
  { letter: "B", path: 1, timing: 2, title: "constant speed" },
  { letter: "C", path: 2, timing: 2, title: "long paths, constant speed" },
  { letter: "D", path: 0, timing: 1, title: "short paths" },
  { letter: "E", path: 1, timing: 1, title: "the original" },
  { letter: "F", path: 2, timing: 1, title: "long paths" },
  { letter: "G", path: 0, timing: 0, title: "short paths, added acceleration" },
  { letter: "H", path: 1, timing: 0, title: "added acceleration" },
  { letter: "I", path: 2, timing: 0, title: "long paths, added acceleration" },
];

/** The nearest of the nine. */
export function nearest([path, timing]: Point): Corner {
  const away = (corner: Corner) => Math.hypot(corner.path - path, corner.timing - timing);
  return NINE.reduce((best, corner) => (away(corner) < away(best) ? corner : best));
}

/** "path 1.4 longer, timing 0.5 more acceleration, near F: long paths". */
export function text([path, timing]: Point): string {
  const said = (value: number, below: string, above: string) =>
    `${shown(value)} ${Math.abs(value - 1) < 0.005 ? "as it was" : value < 1 ? below : above}`;
  const near = nearest([path, timing]);
  return (
    `path ${said(path, "shorter", "longer")}, timing ${said(timing, "more acceleration", "more even")}, ` +
    `near ${near.letter}: ${near.title}`
  );
}

/** The point after a key, or null where it means nothing here. */
export function keyed(key: string, shift: boolean, [path, timing]: Point, axis: "x" | "y"): Point | null {
  if (key === "Home" || key === "Backspace" || key === "Delete") return ORIGINAL;
  const along = key === "ArrowLeft" || key === "ArrowRight" ? "x" : /^Arrow/.test(key) ? "y" : axis;
  const next = stepped(key, shift, along === "x" ? path : timing, AXIS);
  if (next === null || key === "End") return null;
  return along === "x" ? [next, timing] : [path, next];
}

/** Caught by one of the nine where the hand is near it, so that they can be met exactly. */
export function caught([path, timing]: Point, reach = 0.06): Point {
  const near = nearest([path, timing]);
  const caught = Math.hypot(near.path - path, near.timing - timing) < reach;
  return caught ? [near.path, near.timing] : [path, timing];
}
