import { expect, it } from "vitest";
import { Playback } from "../playback";
import type { Clip } from "../wire";
import { stepContact } from "./contacts";

it("steps from contact to contact and stays at the last", () => {
  const contacts = Uint8Array.from([1, 0, 1, 0, 1, 1, 0, 1, 0, 1]);
  const clip = { head: { frames: 5, frame_time: 0.1 }, contacts } as unknown as Clip;
  const playback = new Playback();
  playback.set({ duration: 0.4, frameTime: 0.1, playing: true });
  const times = [1, 1, 1, -1, -1].map((way) => {
    stepContact(playback, clip, way as 1 | -1);
    return Math.round(playback.time * 10);
  });
  expect(times).toEqual([2, 3, 3, 2, 2]);
  expect(playback.playing).toBe(false);
});
