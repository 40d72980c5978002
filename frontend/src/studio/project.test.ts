import { afterEach, beforeEach, expect, it, vi } from "vitest";
import type { Project } from "../messages";
import { Failed } from "./api";
import { Keeper, keptHere, newer, type Keeping } from "./project";
import { freshView, readView } from "./view";

function project(saved: number): Project {
  return { clips: [], current: "", view: { saved }, mien_project: 1 };
}

function shelf(room = Infinity) {
  const held = new Map<string, string>();
  return {
    getItem: (key: string) => held.get(key) ?? null,
    setItem: (key: string, text: string) => {
      if (text.length > room) throw new DOMException("full", "QuotaExceededError");
      held.set(key, text);
    },
  };
}

beforeEach(() => void vi.useFakeTimers());
afterEach(() => void vi.useRealTimers());

it("keeps here at once, and tells the server the newest once", async () => {
  const place = shelf();
  const tell = vi.fn().mockResolvedValue(undefined);
  const heard: Keeping[] = [];
  const keeper = new Keeper(place, tell, (state) => heard.push(state));
  for (const saved of [1, 2, 3]) keeper.keep(project(saved));
  expect(keptHere(place)).toEqual(project(3));
  expect(tell).not.toHaveBeenCalled();
  await vi.advanceTimersByTimeAsync(1000);
  expect(tell.mock.calls).toEqual([[project(3), false]]);
  expect(heard.at(-1)).toBe("kept");
});

it("sends again what could not be sent", async () => {
  const tell = vi.fn().mockRejectedValueOnce(new Failed("lost", "gone")).mockResolvedValue(undefined);
  const heard: Keeping[] = [];
  const keeper = new Keeper(shelf(), tell, (state) => heard.push(state));
  keeper.keep(project(1));
  await vi.advanceTimersByTimeAsync(1000);
  expect(heard.at(-1)).toBe("local");
  keeper.again();
  await vi.advanceTimersByTimeAsync(0);
  expect(heard.at(-1)).toBe("kept");
  expect(tell).toHaveBeenCalledTimes(2);
});

it("says when this browser is full, and still tells the server", async () => {
  const tell = vi.fn().mockResolvedValue(undefined);
  const heard: Keeping[] = [];
  new Keeper(shelf(5), tell, (state) => heard.push(state)).keep(project(1));
  expect(heard).toEqual(["failed"]);
  await vi.advanceTimersByTimeAsync(1000);
  expect(tell).toHaveBeenCalledOnce();
});

it("takes the one that was kept last, and nothing from a broken place", () => {
  expect(newer(project(5), project(7))).toEqual(project(7));
  expect(newer(project(5), null)).toEqual(project(5));
  expect(newer(null, project(0))).toEqual(project(0));
  const place = shelf();
  place.setItem("mien project", "{ broken");
  expect(keptHere(place)).toBeNull();
});

it("reads of a view only what makes sense", () => {
  const view = readView({ mode: "sideways", trails: true, grid: "yes", curves: ["valence", 3] });
  expect(view).toEqual({ ...freshView(), trails: true, curves: ["valence"] });
});
