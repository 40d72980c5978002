import { describe, expect, it } from "vitest";
import {
  add, curveProblem, evaluate, keyAt, move, parseCurve, remove, setAt, shownCurve, valueAt,
} from "./keys";

const AT = [-0.5, 0, 0.1, 0.4, 0.75, 0.95, 1.1, 1.24, 1.5, 2.1, 2.7, 3.3, 4.05, 6];

// `mien.curve.evaluate(curve, AT)`, rounded to twelve decimals.
const FROM_PYTHON: [number[][], number[]][] = [
  [[[0, 0], [1.5, 1]],
    [0, 0, 0.012740740741, 0.175407407407, 0.5, 0.695259259259, 0.824592592593, 0.920282074074, 1, 1, 1, 1,
      1, 1]],
  [[[0.5, 1], [1, 0.2], [2.5, 0.4], [3, 2]],
    [1, 1, 1, 1, 0.6, 0.2224, 0.200666783319, 0.203968604724, 0.218256051327, 0.299877048702, 0.98497007874,
      2, 2, 2]],
  [[[1, 0.7]], Array(14).fill(0.7)],
  [[[0, 1], [1, 1], [1.25, 0], [4, 0.5], [4.1, 0.4]],
    [1, 1, 1, 1, 1, 1, 0.648, 0.004672, 0.011645379414, 0.113776108189, 0.270434259955, 0.419302779865, 0.45,
      0.4]],
  [[[0.3, 0.1], [0.9, 1.3], [2, 0.6], [2.2, 0.6], [5, 1.9]],
    [0.1, 0.1, 0.1, 0.188888888889, 1.1125, 1.295792637115, 1.238993238167, 1.140713448535, 0.902404207363,
      0.6, 0.709557215743, 1.044269314869, 1.552599990889, 1.9]],
];

describe("the curve through the keys", () => {
  it.each(FROM_PYTHON)("is that of Python through %j", (curve, expected) => {
    const found = evaluate(curve, AT);
    expected.forEach((value, i) => expect(found[i], `at ${AT[i]}`).toBeCloseTo(value, 10));
  });
  it("can be asked in any order, and for one number", () => {
    const curve = [[0, 0], [1, 1], [2, 0.5]];
    const back = evaluate(curve, [1.7, 0.2, 1.1, 0.6]);
    expect([...back]).toEqual([1.7, 0.2, 1.1, 0.6].map((time) => valueAt(curve, time)));
    expect([...evaluate(0.8, [0, 5])]).toEqual([0.8, 0.8]);
  });
});

describe("editing", () => {
  const curve = [[0.5, 0.2], [2, 1.2]];
  it("adds in order, and replaces at the same moment", () => {
    expect(add(curve, 1, 0.7)).toEqual([[0.5, 0.2], [1, 0.7], [2, 1.2]]);
    expect(add(curve, 2, 0.7)).toEqual([[0.5, 0.2], [2, 0.7]]);
    expect(add(0.8, 1, 0.7)).toEqual([[1, 0.7]]);
  });
  it("moves between the neighbours, the ends and the limits", () => {
    expect(move(curve, 0, 5, 0.5, 7)).toEqual([[1.999, 0.5], [2, 1.2]]);
    expect(move(curve, 1, 9, 3, 7)).toEqual([[0.5, 0.2], [7, 2]]);
    expect(move(curve, 0, -1, -1, 7)).toEqual([[0, 0], [2, 1.2]]);
  });
  it("removes, and the last key leaves its value", () => {
    expect(remove(curve, 0)).toEqual([[2, 1.2]]);
    expect(remove([[2, 1.2]], 0)).toBe(1.2);
  });
  it("changes nothing in place", () => {
    const before = structuredClone(curve);
    add(curve, 1, 1);
    move(curve, 0, 1, 1, 7);
    remove(curve, 0);
    expect(curve).toEqual(before);
  });
});

describe("curves as text", () => {
  it("are written and read as on the command line", () => {
    expect(shownCurve([[0, 0], [1.5, 1]])).toBe("0:0,1.5:1");
    expect(shownCurve(0.8)).toBe("0.8");
    expect(parseCurve("0:0, 1.5:1")).toEqual([[0, 0], [1.5, 1]]);
    expect(parseCurve("0.5")).toBe(0.5);
  });
  it.each(["fast", "0:1:2", "0:0,1", "", "1:", "0:0,inf:1"])("%j is none", (text) =>
    expect(curveProblem(text)).toMatch(/^A number, or times/),
  );
  it("have times that go up", () =>
    expect(curveProblem("1:0,1:1")).toBe("The times of the keys must go up."));
});

it("a key is found by a moment near it, and set there instead of beside it", () => {
  const curve = [[0.5, 1], [1, 2]];
  expect([keyAt(curve, 0.503, 0.004), keyAt(curve, 0.51, 0.004), keyAt(1, 0.5, 1)]).toEqual([0, -1, -1]);
  expect(setAt(curve, 0.503, 3, 0.004)).toEqual([[0.5, 3], [1, 2]]);
  expect(setAt(curve, 0.7, 3, 0.004)).toEqual([[0.5, 1], [0.7, 3], [1, 2]]);
  expect(setAt(1, 0.7, 3, 0.004)).toEqual([[0.7, 3]]);
});
