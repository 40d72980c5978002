import { describe, expect, it } from "vitest";
import { format, lastFrame, parse, rate, ruled } from "./timecode";

describe("timecodes", () => {
  it.each([
    [0, "00:00.00"], [1.5, "00:01.50"], [59.999, "01:00.00"], [83.456, "01:23.46"], [3725.5, "1:02:05.50"],
    [-1, "00:00.00"],
  ])("%d is %s", (seconds, text) => expect(format(seconds)).toBe(text));

  it.each([
    ["83.45", 83.45], ["1:23.45", 83.45], ["1:02:03", 3723], ["0,5", 0.5], [" 2 s ", 2], ["f90", 1.5],
    ["90f", 1.5], ["0:05.", 5], [".5", 0.5],
  ])("%j is read as %d s", (text, seconds) => expect(parse(text, 1 / 60)).toBeCloseTo(seconds, 9));

  it.each(["", "abc", "1:75", "-1", "1::2", "1:2:3:4", "f", "f1.5"])("%j is none", (text) =>
    expect(parse(text, 1 / 60)).toBeNull(),
  );

  it("come back as they went", () => {
    for (const seconds of [0, 0.01, 12.34, 59.99, 60, 754.2, 4000.07])
      expect(parse(format(seconds), 1 / 60)).toBeCloseTo(seconds, 9);
  });
});

it("a ruler has the decimals of its step", () => {
  expect(ruled(1.5, 0.5)).toBe("1.5");
  expect(ruled(3, 1)).toBe("3 s");
  expect(ruled(0.02, 0.01)).toBe("0.02");
  expect(ruled(75, 5)).toBe("1:15");
  expect(ruled(61.5, 0.5)).toBe("1:01.5");
});

it("frames are counted from nought, and rates have no tail", () => {
  expect(lastFrame(299.99166, 1 / 120)).toBe(35999);
  expect([1 / 60, 1 / 29.97, 1 / 30, 0.008333].map(rate)).toEqual(["60", "29.97", "30", "120"]);
});
