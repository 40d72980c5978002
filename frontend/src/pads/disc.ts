// The disc of valence (to the right) and arousal (upwards): points, the words near them, how they are said.
import { shown } from "../controls/number";
import { SLOW, within } from "../controls/steps";
import type { Word } from "../messages";

export type Point = readonly [valence: number, arousal: number];

export const STEP = 0.05;
const CENTRE = 0.1; // within this of the centre a point is in no quadrant, as in mien.emotion.circumplex

/** What each quadrant is called; the same words as mien.emotion.circumplex. */
export const QUADRANTS = [
  { valence: -1, arousal: 1, lines: ["intense", "unpleasant"], tint: "unpleasant-intense" },
  { valence: 1, arousal: 1, lines: ["intense", "pleasant"], tint: "pleasant-intense" },
  { valence: 1, arousal: -1, lines: ["mild", "pleasant"], tint: "pleasant-calm" },
  { valence: -1, arousal: -1, lines: ["mild", "unpleasant"], tint: "unpleasant-calm" },
] as const;

export function inside([valence, arousal]: Point): boolean {
  return Math.hypot(valence, arousal) <= 1 + 1e-9;
}

/** The nearest point of the disc. */
export function onto([valence, arousal]: Point): Point {
  const far = Math.hypot(valence, arousal);
  return far <= 1 ? [valence, arousal] : [tidy(valence / far), tidy(arousal / far)];
}

/** How far one coordinate may go while the other stays: to the rim. */
export function reach(other: number): number {
  return Math.sqrt(Math.max(1 - other * other, 0));
}

export function nearest(words: readonly Word[], [valence, arousal]: Point): Word | null {
  let best: Word | null = null;
  let least = Infinity;
  for (const word of words) {
    const away = Math.hypot(word.valence - valence, word.arousal - arousal);
    if (away < least) [best, least] = [word, away];
  }
  return best;
}

/** The corners of the smallest convex shape around points, one after the other (Andrew 1979). */
export function hull(points: readonly Point[]): Point[] {
  const sorted = points.toSorted(([x, y], [u, v]) => x - u || y - v);
  const half = (those: readonly Point[]): Point[] => {
    const found: Point[] = [];
    for (const point of those) {
      while (found.length > 1 && turn(found.at(-2)!, found.at(-1)!, point) <= 0) found.pop();
      found.push(point);
    }
    return found.slice(0, -1);
  };
  return sorted.length < 3 ? [] : [...half(sorted), ...half(sorted.toReversed())];
}

/** Above nothing where the way over three points turns to the left. */
function turn(one: Point, two: Point, three: Point): number {
  return (two[0] - one[0]) * (three[1] - one[1]) - (two[1] - one[1]) * (three[0] - one[0]);
}

type Somewhere = Pick<Word, "valence" | "arousal">;

export function distance(one: Somewhere, two: Somewhere): number {
  return Math.hypot(one.valence - two.valence, one.arousal - two.arousal);
}

/** A coordinate in words: "0.6 pleasant". */
export function valenceText(valence: number): string {
  return said(valence, "unpleasant", "pleasant");
}

export function arousalText(arousal: number): string {
  return said(arousal, "calm", "intense");
}

/** All that a screen reader has to say: "valence 0.6 pleasant, arousal −0.3 calm, near relaxed". */
export function text(words: readonly Word[], point: Point): string {
  const word = nearest(words, point);
  const place = `valence ${valenceText(point[0])}, arousal ${arousalText(point[1])}`;
  return word ? `${place}, near ${word.name}` : place;
}

function said(value: number, below: string, above: string): string {
  const name = Math.abs(value) < CENTRE / 2 ? "neutral" : value < 0 ? below : above;
  return `${shown(value, Math.abs(value * 10 - Math.round(value * 10)) < 1e-6 ? 1 : 2)} ${name}`;
}

/** The point after a key, or null where it means nothing: left and right valence, up and down arousal. */
export function keyed(key: string, shift: boolean, [valence, arousal]: Point, axis: "x" | "y"): Point | null {
  const by = STEP * (shift ? SLOW : 1);
  const along = (value: number, other: number, step: number) =>
    tidy(within(value + step, -reach(other), reach(other)));
  const x = (step: number): Point => [along(valence, arousal, step), arousal];
  const y = (step: number): Point => [valence, along(arousal, valence, step)];
  switch (key) {
    case "ArrowRight":
      return x(by);
    case "ArrowLeft":
      return x(-by);
    case "ArrowUp":
      return y(by);
    case "ArrowDown":
      return y(-by);
    case "PageUp":
      return axis === "x" ? x(10 * by) : y(10 * by);
    case "PageDown":
      return axis === "x" ? x(-10 * by) : y(-10 * by);
    case "Home":
    case "Backspace":
    case "Delete":
      return [0, 0];
    default:
      return null;
  }
}

function tidy(value: number): number {
  return Number(value.toFixed(6)) + 0; // no minus nought
}
