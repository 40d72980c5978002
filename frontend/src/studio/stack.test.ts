import { describe, expect, it } from "vitest";
import type { Stack } from "../messages";
import * as stacks from "./stack";

function made(...names: string[]): Stack {
  return names.reduce((stack, name) => stacks.add(stack, stacks.layerFor(stack, "edit", name)), stacks.EMPTY);
}

function names(stack: Stack): string[] {
  return stack.layers.map((layer) => layer.name);
}

function idOf(stack: Stack, name: string): string {
  return stack.layers.find((layer) => layer.name === name)!.id;
}

describe("layers", () => {
  it("get ids of their own, also after one has gone", () => {
    let stack = made("a", "b", "c");
    stack = stacks.remove(stack, idOf(stack, "b"));
    stack = stacks.duplicate(stack, idOf(stack, "a"));
    expect(names(stack)).toEqual(["a", "a", "c"]);
    expect(new Set(stack.layers.map((layer) => layer.id)).size).toBe(3);
  });

  it("move within the list and no further", () => {
    const stack = made("a", "b", "c");
    expect(names(stacks.move(stack, idOf(stack, "a"), 1))).toEqual(["b", "a", "c"]);
    expect(names(stacks.move(stack, idOf(stack, "c"), -5))).toEqual(["c", "a", "b"]);
    expect(names(stacks.move(stack, idOf(stack, "a"), 99))).toEqual(["b", "c", "a"]);
    expect(stacks.move(stack, "nobody", 1)).toBe(stack);
  });

  it("leave the stack they came from alone", () => {
    const stack = made("a", "b");
    const before = JSON.stringify(stack);
    stacks.setParameter(stack, idOf(stack, "a"), "head", 20);
    stacks.bypass(stack, idOf(stack, "a"));
    stacks.move(stack, idOf(stack, "a"), 1);
    expect(JSON.stringify(stack)).toBe(before);
  });

  it("are done when on, and only the solo ones where there are any", () => {
    let stack = made("a", "b", "c");
    stack = stacks.bypass(stack, idOf(stack, "a"));
    expect(stacks.active(stack).map((layer) => layer.name)).toEqual(["b", "c"]);
    stack = stacks.solo(stack, idOf(stack, "c"));
    expect(stacks.active(stack).map((layer) => layer.name)).toEqual(["c"]);
    stack = stacks.bypass(stack, idOf(stack, "c"));
    expect(stacks.active(stack).map((layer) => layer.name)).toEqual(["b"]);
    stack = stacks.bypass(stack, idOf(stack, "b"));
    expect(stacks.active(stack)).toEqual([]);
    expect(stacks.isIdle(stack)).toBe(true);
  });

  it("lose a parameter that goes back to its default", () => {
    let stack = made("posture");
    const id = idOf(stack, "posture");
    stack = stacks.setParameter(stack, id, "head", 20);
    expect(stack.layers[0]!.parameters).toEqual({ head: 20 });
    expect(stacks.setParameter(stack, id, "head", undefined).layers[0]!.parameters).toEqual({});
  });
});

describe("the mood", () => {
  it("is one layer, below the edits, and keeps how strong and where it was", () => {
    let stack = made("posture");
    const first = stacks.setMood(stack, "", { kind: "emotion", name: "tired", parameters: {} });
    stack = stacks.change(first.stack, first.id, { strength: 0.5, parts: ["arms"] });
    const parameters = { valence: 0.6, arousal: -0.2 };
    const second = stacks.setMood(stack, "", { kind: "place", name: "recipe", parameters });
    expect(names(second.stack)).toEqual(["recipe", "posture"]);
    expect(second.stack.layers[0]).toMatchObject({ strength: 0.5, parts: ["arms"], parameters });
  });

  it("is the selected one where there are several", () => {
    let stack = stacks.add(stacks.EMPTY, stacks.layerFor(stacks.EMPTY, "emotion", "sad"));
    stack = stacks.add(stack, stacks.layerFor(stack, "emotion", "old"));
    const changed = stacks.setMood(stack, stack.layers[1]!.id, {
      kind: "emotion",
      name: "proud",
      parameters: {},
    });
    expect(names(changed.stack)).toEqual(["sad", "proud"]);
  });
});

describe("an edit's own sliders", () => {
  it("make a layer once, and change it from then on", () => {
    const first = stacks.setEdit(stacks.EMPTY, "", "posture", { head: 10 });
    const second = stacks.setEdit(first.stack, "", "posture", { trunk: 5 });
    expect(second.stack.layers).toHaveLength(1);
    expect(second.stack.layers[0]!.parameters).toEqual({ head: 10, trunk: 5 });
  });
});

it("names places and edits for people", () => {
  const place = stacks.layerFor(stacks.EMPTY, "place", "recipe", { valence: -0.5, arousal: 0.25 });
  expect(stacks.title(place)).toBe("Disc −0.50, +0.25");
  expect(stacks.title(stacks.layerFor(stacks.EMPTY, "edit", "path_length"))).toBe("Path length");
});
