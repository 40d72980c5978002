import { expect, it } from "vitest";
import { bars, inView, runs } from "./contacts";

const contacts = { values: [1, 0, 1, 0, 0, 1, 0, 1, 1, 1], frameTime: 0.5 };

it("a foot stands from its first frame until the one where it leaves", () => {
  expect(runs(contacts, 0)).toEqual([{ start: 0, end: 1 }, { start: 2, end: 2 }]);
  expect(runs(contacts, 1)).toEqual([{ start: 1, end: 2 }]);
  expect(runs({ values: [], frameTime: 0.5 }, 0)).toEqual([]);
  expect(runs({ values: [1, 1, 1, 1], frameTime: 0.5 }, 1)).toEqual([{ start: 0, end: 0.5 }]);
});

it("what would touch within a pixel is one bar, and what is not seen none", () => {
  const found = [{ start: 0, end: 1 }, { start: 1.001, end: 2 }, { start: 5, end: 6 }];
  expect(inView(found, { start: 0.5, end: 4 }, 100)).toEqual([{ start: 0, end: 2 }]);
  expect(inView(found, { start: 0, end: 0.01 }, 100)).toEqual([{ start: 0, end: 1 }]);
  expect(found[0]).toEqual({ start: 0, end: 1 });
});

it("a clip of five minutes is a few hundred bars at most", () => {
  const values = Uint8Array.from({ length: 72_000 }, (_, i) => (i >> 1) % 2);
  expect(inView(runs({ values, frameTime: 1 / 120 }, 0), { start: 0, end: 300 }, 800).length).toBeLessThan(2);
});

it("bars are at least a pixel wide", () => {
  const found = [{ start: 1, end: 2 }, { start: 3, end: 3 }];
  expect(bars(found, (time) => 10 * time, 2, 8)).toBe("M10.0 2h10.0V8H10.0ZM30.0 2h1.0V8H30.0Z");
});
