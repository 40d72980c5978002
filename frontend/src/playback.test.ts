import { describe, expect, it } from "vitest";
import { Playback } from "./playback";

function made(): Playback {
  const playback = new Playback();
  playback.set({ duration: 2, frameTime: 0.1 });
  return playback;
}

describe("Playback", () => {
  it("loops over all, forward and backward", () => {
    const playback = made();
    playback.set({ playing: true, time: 1.9 });
    playback.advance(0.3);
    expect(playback.time).toBeCloseTo(0.2);
    playback.set({ direction: -1 });
    playback.advance(0.5);
    expect(playback.time).toBeCloseTo(1.7);
  });

  it("stays in its range", () => {
    const playback = made();
    playback.set({ playing: true, range: [1.5, 0.5], time: 1.4 });
    playback.advance(0.2);
    expect(playback.range).toEqual([0.5, 1.5]);
    expect(playback.time).toBeCloseTo(0.6);
  });

  it("has a range to the end go along with the end, and no other", () => {
    const playback = made();
    playback.set({ range: [0.3, 2] });
    playback.set({ duration: 3 });
    expect(playback.range).toEqual([0.3, 3]);
    playback.set({ duration: 1.5 });
    expect(playback.range).toEqual([0.3, 1.5]);
    playback.set({ range: [0.3, 1] });
    playback.set({ duration: 3 });
    expect(playback.range).toEqual([0.3, 1]);
  });

  it("stops at the end where it does not loop", () => {
    const playback = made();
    playback.set({ playing: true, loop: "off", time: 1.95 });
    playback.advance(1);
    expect([playback.time, playback.playing]).toEqual([2, false]);
  });

  it("steps by frames and is kept inside", () => {
    const playback = made();
    playback.set({ time: 0.52 });
    playback.step(1);
    expect(playback.time).toBeCloseTo(0.6);
    playback.step(-100);
    expect(playback.time).toBe(0);
  });

  it("shuttles faster each time", () => {
    const playback = made();
    playback.shuttle(1);
    playback.shuttle(1);
    expect([playback.speed, playback.direction]).toEqual([2, 1]);
    playback.shuttle(-1);
    expect([playback.speed, playback.direction]).toEqual([1, -1]);
    playback.shuttle(0);
    expect(playback.playing).toBe(false);
  });
});
