import { describe, expect, it } from "vitest";
import { WORDS } from "../demo/data";
import { aside, type Box, type Label, layout, overlap } from "./labels";

const SIZES = [10.5, 9.5, 9];
// How wide the disc is in windows of 1280×720, 1360×820 and 1920×1080, and beyond.
const WIDTHS = [180, 187, 244, 276, 290, 340];

function disc(width: number): { labels: Label[]; size: number; frame: Box; corners: Box[] } {
  const middle = width / 2;
  const spots = WORDS.map((word) => ({
    x: middle + word.valence * (middle - 15),
    y: middle - word.arousal * (middle - 15),
    text: word.name,
  }));
  const frame = { left: 0, top: 0, right: width, bottom: width };
  const corners = [0, width - 64].flatMap((left) =>
    [0, width - 28].map((top) => ({ left, top, right: left + 64, bottom: top + 28 })));
  return { ...layout(spots, SIZES, frame, corners), frame, corners };
}

/** How far the nearest edge of a box is from a point. */
function away({ box, x, y }: Label): number {
  return Math.hypot(Math.max(box.left - x, x - box.right, 0), Math.max(box.top - y, y - box.bottom, 0));
}

describe("words around a disc", () => {
  it.each(WIDTHS)("cover nothing and stay inside at %d pixels", (width) => {
    const { labels, frame, corners } = disc(width);
    for (const [i, { text, box }] of labels.entries()) {
      for (const other of labels.slice(i + 1)) expect(overlap(box, other.box), text).toBe(0);
      for (const corner of corners) expect(overlap(box, corner), text).toBe(0);
      expect(overlap(box, frame), text).toBeCloseTo((box.right - box.left) * (box.bottom - box.top));
    }
  });

  it.each(WIDTHS)("stand beside their own dot and clear of the others at %d pixels", (width) => {
    const { labels, size } = disc(width);
    for (const label of labels) {
      expect(away(label), label.text).toBeLessThan(size);
      for (const { x, y, text } of labels.filter((other) => other !== label))
        expect(away({ ...label, x, y }), `${label.text}, ${text}`).toBeGreaterThan(2);
    }
  });

  it.each(WIDTHS)("are nearly all there at %d pixels", (width) => {
    const { labels } = disc(width);
    expect(labels.length).toBeGreaterThanOrEqual(width < 240 ? WORDS.length - 3 : WORDS.length);
  });

  it("stay in the order they came in, the same each time", () => {
    expect(disc(187)).toEqual(disc(187));
    const names = disc(187).labels.map(({ text }) => text);
    expect(names).toEqual(WORDS.map(({ name }) => name).filter((name) => names.includes(name)));
  });

  it.each(WIDTHS)("stay, or go a little aside for a marker on their dot, at %d pixels", (width) => {
    const { labels, frame } = disc(width);
    for (const { x, y } of labels) {
      const mark = { left: x - 8, right: x + 8, top: y - 8, bottom: y + 8 };
      const now = aside(labels, [mark], frame);
      for (const [i, label] of now.entries()) {
        const before = labels[i].box;
        if (!overlap(before, mark)) expect(label).toBe(labels[i]);
        expect(label.box.top).toBe(before.top);
        expect(Math.abs(label.box.left - before.left)).toBeLessThanOrEqual(7);
        for (const other of now.slice(i + 1)) expect(overlap(label.box, other.box)).toBe(0);
        expect(overlap(label.box, frame)).toBeCloseTo(overlap(before, frame));
      }
    }
    expect(aside(labels, [], frame)).toEqual(labels);
  });

  it("are left out where there is no room, the last before the first, or written smaller", () => {
    const spots = ["one", "two", "six"].map((text) => ({ x: 20, y: 10, text }));
    const frame = { left: 0, top: 0, right: 48, bottom: 22 };
    const here = spots.map((spot, i) => ({ ...spot, x: 20 + 0.1 * i }));
    const { labels } = layout(here, [10], { ...frame, left: 18, top: 4, bottom: 17 });
    expect(labels.map(({ text }) => text)).toEqual(["one"]);
    expect(layout([{ x: 4, y: 10, text: "frustrated" }], SIZES, { ...frame, right: 62 }).size).toBe(9.5);
  });
});
