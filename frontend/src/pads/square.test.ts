import { expect, it } from "vitest";
import python from "../../../src/mien/styles/grid.py?raw";
import { caught, keyed, nearest, NINE, text } from "./square";

it("the nine are those of the Python side", () => {
  const found = [...python.matchAll(/Corner\("(\w)", (\d), (\d), "[^"]*", "([^"]*)"\)/g)];
  expect(found.map(([, letter, path, timing, title]) => ({
    letter, path: Number(path), timing: Number(timing), title,
  }))).toEqual(NINE);
});

it("a point has a nearest of the nine and is said in words", () => {
  expect(nearest([1.7, 0.2]).letter).toBe("I");
  expect(text([1.4, 0.5])).toBe("path 1.40 longer, timing 0.50 more acceleration, near E: the original");
  expect(text([1, 2])).toBe("path 1.00 as it was, timing 2.00 more even, near B: constant speed");
});

it("keys move the handle within the square, and home is the original", () => {
  expect(keyed("ArrowRight", false, [1, 1], "y")).toEqual([1.05, 1]);
  expect(keyed("ArrowUp", true, [1, 1], "x")).toEqual([1, 1.01]);
  expect(keyed("PageDown", false, [0.2, 1], "x")).toEqual([0, 1]);
  expect(keyed("Delete", false, [0.2, 1.4], "x")).toEqual([1, 1]);
  expect(keyed("a", false, [0.2, 1.4], "x")).toBeNull();
});

it("a hand near one of the nine is caught by it", () => {
  expect(caught([0.96, 1.03])).toEqual([1, 1]);
  expect(caught([0.9, 1.03])).toEqual([0.9, 1.03]);
});
