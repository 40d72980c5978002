import { expect, it } from "vitest";
import { clipSource } from "../motion/blend";
import { clipOf } from "../motion/fixtures";
import type { Vector } from "../motion/vectors";
import { SLIDES, slideOf, travelOf } from "./travel";

it("a foot that stands slides where its toe leaves its place, but not where it lands or peels off", () => {
  const stand = Array.from({ length: 40 }, (): Vector => [0.1, 0.02, 1]);
  const rolled = stand.map((p, i): Vector => (i < 4 || i > 35 ? [p[0], p[1], p[2] + 0.2] : p));
  const slid = stand.map((p, i): Vector => [p[0] + 0.003 * i, p[1], p[2]]);
  expect(slideOf(stand)).toBe(0);
  expect(slideOf(rolled)).toBe(0);
  expect(slideOf(slid)).toBeGreaterThan(SLIDES);
  expect(slideOf([[0, 0, 0]])).toBe(0);
});

it("a still before the action leaves no trails and no prints", () => {
  const clip = clipOf("walk");
  const whole = travelOf(clipSource(clip));
  const late = travelOf(clipSource({ ...clip, head: { ...clip.head, still: 3 } }));
  expect([whole.first, late.first]).toEqual([0, 3]);
  expect(whole.footprints.some(({ start }) => start < 3 * clip.head.frame_time)).toBe(true);
  expect(late.footprints.every(({ start }) => start >= 3 * clip.head.frame_time)).toBe(true);
});
