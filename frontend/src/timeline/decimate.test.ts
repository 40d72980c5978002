import { describe, expect, it } from "vitest";
import {
  axisOf, band, beyond, columns, extent, heights, indexAt, isDense, line, points, readable, valueAt,
} from "./decimate";

const FRAMES = 36_000; // five minutes
const times = Float64Array.from({ length: FRAMES }, (_, i) => i / 120);
const values = times.map((t) => Math.sin(t) + 0.3 * Math.sin(50 * t));
const all = { start: 0, end: 300 };

describe("many frames on few pixels", () => {
  it("are the lowest and highest of every column", () => {
    const found = columns(times, values, all, 800);
    expect(found.map((column) => column.pixel)).toEqual(Array.from({ length: 800 }, (_, i) => i));
    for (const { pixel, low, high } of found) {
      const inside = values.filter((_, i) => Math.floor(times[i] * (800 / 300)) === pixel);
      expect([low, high]).toEqual([Math.min(...inside), Math.max(...inside)]);
    }
  });
  it("keep a spike of one frame, and leave out what is no number", () => {
    const spiked = Float64Array.from(values);
    spiked[12_345] = 9;
    spiked[20_000] = NaN;
    const found = columns(times, spiked, all, 800);
    expect(Math.max(...found.map((column) => column.high))).toBe(9);
    expect(found.length).toBe(800);
  });
  it("are a line when nearer, to both edges and beyond", () => {
    const near = { start: 10, end: 11 };
    expect([isDense(times, all, 800), isDense(times, near, 800)]).toEqual([true, false]);
    const found = points(times, values, near, 800);
    expect(found.length / 2).toBe(121 + 1);
    expect(found[0]).toBeLessThanOrEqual(0);
    expect(found.at(-2)).toBeGreaterThanOrEqual(800);
  });
});

it("a moment is found, and the value there", () => {
  expect(indexAt([0, 1, 2], 1)).toBe(1);
  expect(indexAt([0, 1, 2], 1.5)).toBe(2);
  expect(valueAt([0, 1, 2], [0, 10, 0], 1.25)).toBe(7.5);
  expect(valueAt([0, 1], [3, 4], 9)).toBe(4);
  expect(valueAt([0, 1], [3, 4], -9)).toBe(3);
  expect(valueAt([], [], 0)).toBeNull();
});

it("an axis has a least range, so that noise stays small", () => {
  expect(extent(1, [1, 5], [-2])).toEqual([-2, 5]);
  expect(extent(2, [80, 80.5])).toEqual([79.25, 81.25]);
  expect(extent(0.5, [0, 0.01])).toEqual([0, 0.5]);
  expect(extent(1, [])).toEqual([0, 1]);
  expect(extent(1, [NaN, 1, 2])).toEqual([1, 2]);
});

it("an axis leaves out a jump at the start, and no other", () => {
  const at = Array.from({ length: 100 }, (_, i) => i / 60);
  const times = { before_times: at, after_times: at };
  const made = (values: number[]) =>
    axisOf({ name: "hand speed", unit: "m/s", before: values, after: values, ...times });
  const calm = at.map((t) => 1 + Math.sin(9 * t));
  expect(made(calm.map((v, i) => (i < 4 ? 15 : v)))[1]).toBeLessThan(2.1);
  expect(made(calm.map((v, i) => (i === 50 ? 15 : v)))[1]).toBe(15);
  expect(made(calm.map((v, i) => (i < 4 ? 3 : v)))[1]).toBe(3);
});

it("what an axis leaves out is said", () => {
  const at = [0, 0.1, 0.2, 0.3];
  const curve = (before: number[], after: number[]) =>
    ({ name: "hand speed", unit: "m/s", before, after, before_times: at, after_times: at });
  expect(beyond(curve([1, 2, 1, 2], [1, 2, 0, 1]), 0, 2)).toBeNull();
  expect(beyond(curve([9, 2, 1, 2], [15, 12, 0, 1]), 0, 2)).toEqual({ time: 0, value: 15 });
  expect(beyond(curve([1, -5, 1, 2], [1, 2, NaN, 3]), 0, 2)).toEqual({ time: 0.1, value: -5 });
});

it("values have as many decimals as their axis deserves", () => {
  expect(readable(0.0555, 0, 0.4)).toBe("0.056");
  expect(readable(84.123, 74, 86)).toBe("84.1");
  expect(readable(-312.4, -400, 100)).toBe("−312");
});

it("a line has gaps where there is no number, a band goes there and back", () => {
  const y = heights(0, 1, 44);
  expect(line([0, 0, 1, NaN, 2, 1], y)).toBe("M0.0 42.0M2.0 2.0");
  const found = [{ pixel: 0, low: 0, high: 1 }, { pixel: 1, low: 0.5, high: 1 }];
  expect(band(found, y)).toBe("M0.5 1.5L1.5 1.5L1.5 22.5L0.5 42.5Z");
  expect(band([], y)).toBe("");
});
