import { describe, expect, it } from "vitest";
import { WORDS } from "../demo/data";
import { distance, hull, inside, keyed, nearest, onto, reach, text } from "./disc";

describe("the disc", () => {
  it("has an inside, and a rim that the handle keeps to", () => {
    expect(inside([0.6, 0.8])).toBe(true);
    expect(inside([0.8, 0.8])).toBe(false);
    expect(onto([3, 4])).toEqual([0.6, 0.8]);
    expect(onto([0.1, -0.2])).toEqual([0.1, -0.2]);
    expect(reach(0.6)).toBeCloseTo(0.8, 12);
    expect(reach(1)).toBe(0);
  });
  it("knows the nearest word", () => {
    expect(nearest(WORDS, [0.6, -0.27])?.name).toBe("at ease");
    expect(nearest([], [0, 0])).toBeNull();
    expect(distance({ valence: 0, arousal: 0 }, { valence: 0.3, arousal: -0.4 })).toBeCloseTo(0.5, 12);
  });
  it("knows what lies between points", () => {
    const corners = [[-1, 0], [0, -1], [1, 0], [0, 1]] as const;
    const within = [[0, 0], [0.5, 0.5], [-0.2, 0.1]] as const; // one of them on an edge
    expect(hull([within[0], corners[3], corners[0], within[1], corners[2], corners[1], within[2]])).toEqual(corners);
    expect(hull([[0, 0], [1, 1]])).toEqual([]);
    expect(hull([[0, 0], [1, 1], [0.5, 0.5]])).toHaveLength(2);
  });
  it("is said in words", () => {
    expect(text(WORDS, [0.7, -0.45])).toBe("valence 0.7 pleasant, arousal −0.45 calm, near relaxed");
    expect(text(WORDS, [-0.6, 0])).toBe("valence −0.6 unpleasant, arousal 0.0 neutral, near miserable");
  });
});

describe("keys", () => {
  it("go left and right in valence, up and down in arousal, whichever slider has the focus", () => {
    expect(keyed("ArrowRight", false, [0, 0], "y")).toEqual([0.05, 0]);
    expect(keyed("ArrowDown", false, [0, 0], "x")).toEqual([0, -0.05]);
    expect(keyed("ArrowUp", true, [0, 0], "x")).toEqual([0, 0.01]);
    expect(keyed("PageUp", false, [0, 0], "y")).toEqual([0, 0.5]);
  });
  it("stop at the rim without moving the other coordinate", () => {
    const [valence, arousal] = keyed("PageUp", false, [0.6, 0.6], "x")!;
    expect(arousal).toBe(0.6);
    expect(valence).toBeCloseTo(0.8, 6);
    expect(inside([valence, arousal])).toBe(true);
  });
  it("go home to neutral, and leave other keys alone", () => {
    expect(keyed("Home", false, [0.4, 0.2], "x")).toEqual([0, 0]);
    expect(keyed("Tab", false, [0.4, 0.2], "x")).toBeNull();
  });
});
