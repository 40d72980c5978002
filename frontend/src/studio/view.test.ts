import { describe, expect, it } from "vitest";
import { freshView, isOn, parts, readView } from "./view";

describe("walking on the spot", () => {
  it("is by itself where two figures over each other would part", () => {
    const view = freshView();
    expect(isOn(view, "treadmill", true)).toBe(true);
    expect(isOn(view, "treadmill", false)).toBe(false);
    expect(isOn({ ...view, mode: "side" }, "treadmill", true)).toBe(false);
    expect(isOn({ ...view, follow: false }, "treadmill", true)).toBe(false);
  });

  it("is as it was chosen, once it was", () => {
    const chosen = readView({ treadmill: false });
    expect(isOn(chosen, "treadmill", true)).toBe(false);
    expect(isOn({ ...chosen, treadmill: true }, "treadmill", false)).toBe(true);
    expect(readView({ treadmill: "yes" }).treadmill).toBeNull();
  });

  it("does not flicker at the limit", () => {
    expect([parts(0.2, false), parts(0.2, true), parts(0.4, false), parts(0.1, true)]).toEqual([
      false,
      true,
      true,
      false,
    ]);
  });
});
