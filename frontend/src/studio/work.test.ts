import { afterEach, beforeEach, expect, it, vi } from "vitest";
import type { WorkInfo } from "../messages";
import { Work } from "./work.svelte";

const drawing: WorkInfo = { kind: "export", what: "drawing", share: 0.5, seconds: 2 };

beforeEach(() => void vi.useFakeTimers());
afterEach(() => void vi.useRealTimers());

it("does not ask for what is quick", async () => {
  const ask = vi.fn().mockResolvedValue([drawing]);
  const end = new Work(ask).begin();
  await vi.advanceTimersByTimeAsync(900);
  end();
  await vi.advanceTimersByTimeAsync(5000);
  expect(ask).not.toHaveBeenCalled();
});

it("asks again and again while somebody waits, and forgets it then", async () => {
  const ask = vi.fn().mockResolvedValue([drawing]);
  const work = new Work(ask);
  const ends = [work.begin(), work.begin()];
  await vi.advanceTimersByTimeAsync(2100);
  expect(ask).toHaveBeenCalledTimes(3);
  expect(work.of("export")).toEqual(drawing);
  expect(work.of("edit")).toBeUndefined();
  ends[0]!();
  ends[0]!(); // the same one twice is one
  await vi.advanceTimersByTimeAsync(1000);
  expect(ask).toHaveBeenCalledTimes(5);
  ends[1]!();
  expect(work.all).toEqual([]);
  await vi.advanceTimersByTimeAsync(5000);
  expect(ask).toHaveBeenCalledTimes(5);
});

it("passes over a question that fails", async () => {
  const ask = vi.fn().mockRejectedValueOnce(new Error("lost")).mockResolvedValue([drawing]);
  const work = new Work(ask);
  work.begin();
  await vi.advanceTimersByTimeAsync(1600);
  expect(work.of("export")).toEqual(drawing);
});
