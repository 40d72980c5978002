import { expect, it } from "vitest";
import { Playback } from "../playback";
import { nextLoop, nextSpeed, read } from "./clock";

it("a speed goes through those on offer, from wherever it is", () => {
  expect(nextSpeed(1, 1)).toBe(2);
  expect(nextSpeed(1, -1)).toBe(0.5);
  expect(nextSpeed(8, -1)).toBe(4);
  expect(nextSpeed(8, 1)).toBe(8);
  expect(nextSpeed(0.1, -1)).toBe(0.1);
});

it("the loop goes round its three ways", () => {
  expect([nextLoop("all"), nextLoop("range"), nextLoop("off")]).toEqual(["range", "off", "all"]);
});

it("a playback is read as it is now, and does not change afterwards", () => {
  const playback = new Playback();
  playback.set({ duration: 10, frameTime: 0.1, time: 2 });
  const clock = read(playback);
  playback.set({ time: 3 });
  expect([clock.time, clock.frame]).toEqual([2, 20]);
});
