import { expect, it } from "vitest";
import type { ParameterInfo } from "../messages";
import { hasSlider, isCurve } from "./parameter";

const info: ParameterInfo = {
  name: "x", kind: "number", doc: "", default: 0, low: 0, high: 1, neutral: 0, unit: "",
  choices: [], optional: false,
};

it("a slider needs two ends, a range one can drag in, and a value", () => {
  expect(hasSlider(info)).toBe(true);
  expect(hasSlider({ ...info, high: null })).toBe(false);
  expect(hasSlider({ ...info, high: 10000 })).toBe(false);
  expect(hasSlider({ ...info, optional: true })).toBe(false);
});

it("keys are told from lists of words", () => {
  expect([[[0, 1]], ["head"], [], 1, null, "a"].map((value) => isCurve(value as never))).toEqual([
    true, false, false, false, false, false,
  ]);
});
