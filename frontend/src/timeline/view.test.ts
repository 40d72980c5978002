import { describe, expect, it } from "vitest";
import { all, follow, pan, ticks, toPixel, toTime, zoom } from "./view";

const FRAME = 1 / 60;

describe("the stretch that is seen", () => {
  it("goes from time to pixel and back", () => {
    const view = { start: 2, end: 4 };
    expect(toPixel(3, view, 800)).toBe(400);
    expect(toTime(400, view, 800)).toBe(3);
  });
  it("is zoomed about the pointer", () => {
    const view = zoom({ start: 2, end: 6 }, 0.5, 3, 10, FRAME);
    expect(view).toEqual({ start: 2.5, end: 4.5 });
    expect((3 - view.start) / (view.end - view.start)).toBeCloseTo(0.25, 12);
  });
  it("ends with all of the clip and with a few frames", () => {
    expect(zoom({ start: 2, end: 6 }, 100, 3, 10, FRAME)).toEqual(all(10));
    const near = zoom({ start: 2, end: 6 }, 1e-9, 3, 10, FRAME);
    expect(near.end - near.start).toBeCloseTo(8 * FRAME, 9);
  });
  it("does not leave the clip", () => {
    expect(pan({ start: 2, end: 6 }, 100, 10).end).toBeCloseTo(all(10).end, 12);
    expect(pan({ start: 2, end: 6 }, -100, 10).start).toBeCloseTo(all(10).start, 12);
    expect(pan({ start: 2, end: 6 }, 0, 3)).toEqual(all(3));
  });
  it("turns the page when the playhead leaves it", () => {
    const view = { start: 2, end: 4 };
    expect(follow(view, 3, 10)).toBe(view);
    const next = follow(view, 4.1, 10);
    expect(next.start).toBeCloseTo(4, 12);
    expect(next.end - next.start).toBeCloseTo(2, 12);
  });
  it("is there for an empty clip", () => {
    expect(toPixel(0, all(0), 500)).toBeGreaterThan(0);
    expect(Number.isFinite(zoom(all(0), 0.5, 0, 0, FRAME).end)).toBe(true);
  });
});

describe("ticks", () => {
  it("stand at round times, with words far enough apart", () => {
    for (const length of [0.1, 1, 7.5, 60, 300, 3600]) {
      const view = all(length);
      const { step, ticks: found } = ticks(view, 800, length);
      const majors = found.filter((tick) => tick.major);
      expect(toPixel(step, view, 800) - toPixel(0, view, 800)).toBeGreaterThanOrEqual(64);
      expect(majors.length).toBeGreaterThanOrEqual(2);
      for (const tick of majors) expect(tick.time / step).toBeCloseTo(Math.round(tick.time / step), 6);
      expect(found.length).toBeLessThan(100);
    }
  });
  it("end with the clip", () => {
    const last = ticks(all(7.5), 800, 7.5).ticks.at(-1)!;
    expect(last.time).toBeLessThanOrEqual(7.5 + 1e-9);
  });
});
