import { afterEach, beforeEach, expect, it, vi } from "vitest";
import type { EditRequest, Hello, ParameterInfo, Project } from "../messages";
import type { Clip } from "../wire";
import { Failed, type Api } from "./api";
import { Studio } from "./store.svelte";

const clips = ["a", "b"].map((id) => ({
  id,
  name: `${id}.bvh`,
  frames: 11,
  joints: 22,
  fps: 10,
  duration: 1,
  problem: "",
}));
const motion = { head: { frames: 11, frame_time: 0.1, shape: {}, joints: [] } } as unknown as Clip;

/** A server that has two clips and answers everything at once. */
function made(kept: Project | null = null, shelf = new Map<string, string>()) {
  const edits: EditRequest[] = [];
  const api = {
    hello: vi.fn().mockResolvedValue({ clips, given: [] } as unknown as Hello),
    project: () => (kept ? Promise.resolve(kept) : Promise.resolve(null)),
    keepProject: vi.fn().mockResolvedValue(undefined),
    motion: vi.fn().mockResolvedValue(motion),
    edit: vi.fn((request: EditRequest) => Promise.resolve(edits.push(request) && { ...motion })),
    reading: vi.fn().mockResolvedValue({}),
    checks: vi.fn().mockResolvedValue({ checks: [] }),
    curves: vi.fn().mockResolvedValue([]),
    onLost: () => undefined,
  };
  const storage = {
    getItem: (key: string) => shelf.get(key) ?? null,
    setItem: (key: string, value: string) => void shelf.set(key, value),
  } as Storage;
  return { studio: new Studio(api as unknown as Api, storage), api, edits, shelf };
}

const settle = () => vi.advanceTimersByTimeAsync(1000);

beforeEach(() => {
  vi.useFakeTimers();
  // Node has no locks to share with other tabs; there are none either.
  const request = async (_name: string, _options: object, given: (lock: object) => unknown) => given({});
  vi.stubGlobal("navigator", { locks: { request } });
  vi.stubGlobal("matchMedia", () => ({ matches: true }));
});
afterEach(() => {
  vi.useRealTimers();
  vi.unstubAllGlobals();
});

it("makes one step and one careful edit of a drag", async () => {
  const { studio, edits } = made();
  await studio.begin();
  for (const head of [5, 10, 15]) {
    studio.setEdit("posture", { head }, false);
    await vi.advanceTimersByTimeAsync(10);
  }
  studio.setEdit("posture", { head: 15 }, true);
  await settle();
  expect(edits.map(({ live }) => live)).toEqual([true, true, true, false]);
  expect(new Set(edits.map(({ turn }) => turn)).size).toBe(4);
  studio.undo();
  expect(studio.stack.layers).toEqual([]);
  expect(studio.undoLabel).toBe("");
  studio.redo();
  expect(studio.stack.layers[0]!.parameters).toEqual({ head: 15 });
});

it("takes quick arrow keys for one step, and slow ones for several", async () => {
  const { studio } = made();
  await studio.begin();
  studio.setEdit("posture", { head: 1 });
  for (const head of [2, 3, 4]) studio.setEdit("posture", { head });
  await settle();
  studio.setEdit("posture", { head: 5 });
  studio.undo();
  expect(studio.stack.layers[0]!.parameters).toEqual({ head: 4 });
  studio.undo();
  expect(studio.stack.layers).toEqual([]);
});

it("keeps a history for each clip", async () => {
  const { studio } = made();
  await studio.begin();
  studio.addLayer("emotion", "sad");
  await studio.select("b");
  expect(studio.stack.layers).toEqual([]);
  studio.undo();
  await studio.select("a");
  expect(studio.stack.layers.map(({ name }) => name)).toEqual(["sad"]);
});

it("goes on where it was left, from what was kept last", async () => {
  const first = made();
  await first.studio.begin();
  await first.studio.select("b");
  first.studio.addLayer("emotion", "sad");
  first.studio.show({ mode: "wipe" });
  const old: Project = { clips: [], current: "a", view: { saved: 1 }, mien_project: 1 };
  const { studio } = made(old, first.shelf);
  await studio.begin();
  expect([studio.current, studio.view.mode]).toEqual(["b", "wipe"]);
  expect(studio.stack.layers.map(({ name }) => name)).toEqual(["sad"]);
});

it("asks nothing for a stack that changes nothing, and keeps the blend to come back to", async () => {
  const { studio, edits } = made();
  await studio.begin();
  studio.addLayer("emotion", "sad");
  await settle();
  const count = edits.length;
  studio.change("overall", (stack) => ({ ...stack, strength: 0 }), false);
  await settle();
  expect(edits).toHaveLength(count);
  expect(studio.answers.made).not.toBeNull();
});

it("loses nothing when the server goes, and asks again when it is back", async () => {
  const { studio, api, edits } = made();
  await studio.begin();
  api.edit.mockImplementationOnce(() => {
    api.onLost();
    return Promise.reject(new Failed("lost", "gone"));
  });
  api.hello.mockRejectedValueOnce(new Failed("lost", "gone"));
  studio.addLayer("emotion", "sad");
  await vi.advanceTimersByTimeAsync(600);
  expect(studio.reach).toBe("lost");
  expect(studio.notices.all).toEqual([]);
  await vi.advanceTimersByTimeAsync(1100);
  expect(studio.reach).toBe("there");
  expect(edits.at(-1)?.stack).toEqual(studio.stack);
});

it("says why an edit cannot be made, and shows the one before", async () => {
  const { studio, api } = made();
  await studio.begin();
  studio.addLayer("emotion", "sad");
  await settle();
  const before = studio.answers.made;
  api.edit.mockRejectedValueOnce(new Failed("said", "low must be below high", 422));
  studio.addLayer("edit", "tremor");
  await settle();
  expect(studio.notices.all.map(({ text }) => text)).toEqual(["Low must be below high"]);
  expect(studio.answers.made).toBe(before);
});

it("gets ready what a slider can be blended from, once, and leaves it to the page from then on", async () => {
  const { studio, edits } = made();
  await studio.begin();
  const head = { name: "head", kind: "number", low: -60, high: 60, neutral: 0, default: 0 } as ParameterInfo;
  studio.prepareEdit("posture", head);
  await settle();
  expect(edits.map(({ stack, live }) => [stack.layers[0]!.parameters["head"], live])).toEqual([
    [-60, true],
    [-30, true],
    [0, true],
    [30, true],
    [60, true],
  ]);
  expect(studio.answers.rail!.points.map(({ value }) => value)).toEqual([-60, -30, 0, 30, 60]);
  studio.setEdit("posture", { head: 30 }, true);
  studio.prepareEdit("posture", head);
  await settle();
  expect(edits).toHaveLength(6); // the edit itself; the rail still fits
  studio.setEdit("posture", { chest: 10 }, true);
  studio.prepareEdit("posture", head);
  await settle();
  expect(studio.answers.rail!.points.map(({ value }) => value)).toEqual([-60, -15, 30, 45, 60]);
});

it("lays no rail for what cannot be blended: seeds, frequencies, and curves", async () => {
  const { studio, edits } = made();
  await studio.begin();
  const info = { name: "frequency", kind: "number", low: 1, high: 9, neutral: null, default: 2 };
  studio.prepareEdit("tremor", info as ParameterInfo);
  studio.prepareEdit("tremor", { ...info, kind: "whole", neutral: 0 } as ParameterInfo);
  studio.prepareEdit("tremor", { ...info, neutral: 1, default: [[0, 1]] } as unknown as ParameterInfo);
  await settle();
  expect(edits).toEqual([]);
});

it("selects the layer that undo or redo changes", async () => {
  const { studio } = made();
  await studio.begin();
  studio.addLayer("emotion", "tired");
  studio.addLayer("edit", "posture", { head: 10 });
  const [tired, posture] = studio.stack.layers.map(({ id }) => id);
  studio.changeLayer("strength of tired", tired!, { strength: 0.5 });
  studio.selected = posture!;
  studio.undo();
  expect(studio.selected).toBe(tired);
  studio.selected = tired!;
  studio.undo();
  studio.redo();
  expect(studio.selected).toBe(posture);
});
