import { describe, expect, it } from "vitest";
import { WORDS } from "../demo/data";
import { layout, overlap } from "./labels";

describe("words around a disc", () => {
  it.each([200, 240, 276, 340])("cover nothing at %d pixels", (width) => {
    const middle = width / 2;
    const spots = WORDS.map((word) => ({
      x: middle + word.valence * (middle - 15),
      y: middle - word.arousal * (middle - 15),
      text: word.name,
    }));
    const frame = { left: 0, top: 0, right: width, bottom: width };
    const labels = layout(spots, 10.5, frame);
    const boxes = labels.map((label) => ({
      left: label.left, right: label.left + label.width, top: label.middle - 5, bottom: label.middle + 5,
    }));
    for (const [i, box] of boxes.entries()) {
      for (const other of boxes.slice(i + 1)) expect(overlap(box, other), labels[i].text).toBe(0);
      expect(box.left, labels[i].text).toBeGreaterThanOrEqual(0);
      expect(box.right, labels[i].text).toBeLessThanOrEqual(width);
    }
  });
  it("stay in the order they came in, the same each time", () => {
    const spots = [{ x: 50, y: 50, text: "one" }, { x: 52, y: 50, text: "two" }];
    const frame = { left: 0, top: 0, right: 100, bottom: 100 };
    expect(layout(spots, 10, frame).map((label) => label.text)).toEqual(["one", "two"]);
    expect(layout(spots, 10, frame)).toEqual(layout(spots, 10, frame));
  });
});
