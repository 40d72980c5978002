import { describe, expect, it } from "vitest";
import { apart } from "./overlay";

describe("names in the picture", () => {
  const name = (text: string, x: number, y: number) => ({ text, x, y });

  it("are left out where they would cover one before them", () => {
    const all = [name("LeftHand", 100, 100), name("LeftThumb", 120, 104), name("LeftIndex", 130, 116)];
    expect(apart(all).map(({ text }) => text)).toEqual(["LeftHand"]);
  });

  it("stay where there is room beside, above or below", () => {
    const all = [name("LeftHand", 100, 100), name("LeftFoot", 100, 118), name("Hips", 160, 100), name("Neck", 60, 99)];
    expect(apart(all)).toEqual(all);
  });
});
