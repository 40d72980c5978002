import { expect, it } from "vitest";
import type { Vector } from "../motion/vectors";
import { SLIDES, slideOf } from "./travel";

it("a foot that stands slides where its toe leaves its place, but not where it lands or peels off", () => {
  const stand = Array.from({ length: 40 }, (): Vector => [0.1, 0.02, 1]);
  const rolled = stand.map((p, i): Vector => (i < 4 || i > 35 ? [p[0], p[1], p[2] + 0.2] : p));
  const slid = stand.map((p, i): Vector => [p[0] + 0.003 * i, p[1], p[2]]);
  expect(slideOf(stand)).toBe(0);
  expect(slideOf(rolled)).toBe(0);
  expect(slideOf(slid)).toBeGreaterThan(SLIDES);
  expect(slideOf([[0, 0, 0]])).toBe(0);
});
