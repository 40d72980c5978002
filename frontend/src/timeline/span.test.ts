import { expect, it } from "vitest";
import { moved, onFrame, outline } from "./span";

const now = { span: [1, 4], ease: 0.5 };
const at = (grip: Parameters<typeof moved>[1], to: number) => moved(now, grip, to, 10, 0.1);

it("ends stop at each other and at those of the clip", () => {
  expect(at("start", 2)).toEqual({ span: [2, 4], ease: 0.5 });
  expect(at("start", 9)).toEqual({ span: [3.9, 4], ease: 0.5 });
  expect(at("start", -9)).toEqual({ span: [0, 4], ease: 0.5 });
  expect(at("end", 99)).toEqual({ span: [1, 10], ease: 0.5 });
});

it("the whole keeps its length", () => {
  expect(at("body", 2)).toEqual({ span: [3, 6], ease: 0.5 });
  expect(at("body", 99)).toEqual({ span: [7, 10], ease: 0.5 });
  expect(at("body", -99)).toEqual({ span: [0, 3], ease: 0.5 });
});

it("the slope is at most half of the stretch", () => {
  expect(at("ease", 1.75).ease).toBe(0.75);
  expect(at("ease", 9).ease).toBe(1.5);
  expect(at("ease", 0).ease).toBe(0);
});

it("both ends at those of the clip is no span, and a whole one can be shortened", () => {
  expect(moved({ span: [0, 4], ease: 0.5 }, "end", 10, 10, 0.1).span).toBeNull();
  expect(moved({ span: null, ease: 0.5 }, "start", 2, 10, 0.1).span).toEqual([2, 10]);
});

it("a bar has its slopes, which never cross", () => {
  expect(outline(0, 100, 10, 2, 20)).toBe("M0 20L10 2L90 2L100 20Z");
  expect(outline(0, 10, 50, 2, 20)).toBe("M0 20L5 2L5 2L10 20Z");
  expect(onFrame(1.234, 0.5)).toBe(1);
});
