import { describe, expect, it } from "vitest";
import { isIncluded, toggled } from "./included";

const OF = {
  arms: ["left arm", "right arm"],
  left: ["left arm", "left leg"],
  upper: ["head", "left arm", "right arm"],
};
const ALL = ["head", "left arm", "right arm", "left leg", "arms", "left", "upper"];
const toggle = (choice: string, ...value: string[]) => toggled(choice, value, ALL, OF);

describe("choices made of others", () => {
  it("include what they are made of, and are included by it", () => {
    const included = ALL.filter((choice) => isIncluded(choice, ["arms"], OF));
    expect(included).toEqual(["left arm", "right arm", "arms"]);
    expect(isIncluded("arms", ["left arm", "right arm"], OF)).toBe(true);
    expect(isIncluded("upper", ["arms"], OF)).toBe(false);
  });

  it("take the place of their members", () => {
    expect(toggle("arms", "head", "left arm")).toEqual(["head", "arms"]);
    expect(toggle("upper", "arms")).toEqual(["upper"]);
  });

  it("give way to the members that are left when one is taken out", () => {
    expect(toggle("left arm", "arms")).toEqual(["right arm"]);
    expect(toggle("left arm", "arms", "left")).toEqual(["right arm", "left leg"]);
    expect(toggle("arms", "upper")).toEqual(["head"]);
    expect(toggle("arms", "left arm", "right arm")).toEqual([]);
  });

  it("are ordinary choices where nothing is made of others", () => {
    expect(toggled("b", ["c"], ["a", "b", "c"], {})).toEqual(["b", "c"]);
    expect(toggled("b", ["b", "c"], ["a", "b", "c"], {})).toEqual(["c"]);
  });
});
