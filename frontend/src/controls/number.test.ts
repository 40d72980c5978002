import { describe, expect, it } from "vitest";
import { decimals, format, parse, refusal, shown, stepOf } from "./number";

describe("numbers as they are read", () => {
  it("have the decimals of their step", () => {
    expect([1, 0.1, 0.05, 0.001, 0.25].map(decimals)).toEqual([0, 1, 2, 3, 2]);
    expect(format(0.3, 0.05)).toBe("0.30");
    expect(format(-12, 1)).toBe("-12");
  });
  it("are not rounded away between two steps", () => {
    expect(format(0.123, 0.1)).toBe("0.123");
    expect(format(12.5, 1)).toBe("12.5");
    expect(format(-0.648, 0.01)).toBe("-0.648");
    expect(format(100, 1)).toBe("100");
    expect(format(12.0001, 1)).toBe("12");
    expect(format(0.1 + 0.2, 0.1)).toBe("0.3");
  });
  it("are never minus nought", () => {
    expect(format(-0.00001, 0.01)).toBe("0.00");
    expect(shown(-0.001)).toBe("0.00");
    expect(shown(-0.25)).toBe("−0.25");
  });
});

describe("numbers as they are typed", () => {
  it.each([
    ["12", "", 12], [" -0,5 ", "", -0.5], ["−3", "", -3], ["+.5", "", 0.5], ["1e-2", "", 0.01],
    ["3.", "", 3], ["30°", "degrees", 30], ["30 degrees", "degrees", 30], ["2 s", "s", 2],
    ["0.2 Leg", "leg lengths", 0.2],
  ])("%j in %j is %d", (text, unit, value) => expect(parse(text, unit)).toBeCloseTo(value, 12));
  it.each(["", "abc", "1.2.3", "1 2", "--1", "Infinity", "0x10", "5 s"])("%j is none", (text) =>
    expect(parse(text)).toBeNull(),
  );
  it("are refused with a reason, and never moved", () => {
    expect(refusal(61, -60, 60, "degrees")).toBe("From −60 to 60 degrees.");
    expect(refusal(-1, 0, null)).toBe("At least 0.");
    expect(refusal(2, null, 1)).toBe("At most 1.");
    expect(refusal(null, 0, 1)).toBe("Not a number.");
    expect(refusal(60, -60, 60)).toBe("");
    expect(refusal(1e9, null, null)).toBe("");
  });
});

it("a range gets about a hundred round steps", () => {
  const ranges: [number, number][] = [
    [0, 1], [-60, 60], [0.6, 1.4], [0.5, 2], [0.02, 1], [0, 4], [-0.5, 0.1],
  ];
  expect(ranges.map(([low, high]) => stepOf(low, high))).toEqual([0.01, 1, 0.005, 0.01, 0.005, 0.02, 0.005]);
});
