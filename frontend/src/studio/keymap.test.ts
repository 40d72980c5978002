import { describe, expect, it } from "vitest";
import { KEYS, chord, commandOf, isTaken, rebound } from "./keymap";

function press(key: string, held: Partial<Record<"ctrlKey" | "metaKey" | "shiftKey" | "altKey", true>> = {}) {
  return { key, ctrlKey: false, metaKey: false, shiftKey: false, altKey: false, ...held };
}

function element(
  tagName: string,
  attributes: Record<string, string> = {},
  dataset: Record<string, string> = {},
): EventTarget {
  const getAttribute = (name: string) => attributes[name] ?? null;
  return { tagName, dataset, getAttribute } as unknown as EventTarget;
}

describe("chord", () => {
  it("writes letters big and counts Shift once", () => {
    expect(chord(press("z", { ctrlKey: true }))).toBe("Ctrl+Z");
    expect(chord(press("Z", { metaKey: true, shiftKey: true }))).toBe("Ctrl+Shift+Z");
    expect(chord(press("?", { shiftKey: true }))).toBe("?");
    expect(chord(press("ArrowLeft", { shiftKey: true }))).toBe("Shift+ArrowLeft");
    expect(chord(press(" "))).toBe("Space");
  });
});

describe("the table", () => {
  it("gives no key to two commands", () => {
    const keys = KEYS.flatMap((binding) => binding.keys);
    expect(new Set(keys).size).toBe(keys.length);
    expect(new Set(KEYS.map((binding) => binding.command)).size).toBe(KEYS.length);
  });

  it("moves a key to its new command only", () => {
    const table = rebound(KEYS, { undo: ["U"], play: ["K"] });
    expect(commandOf(table, press("u"))).toBe("undo");
    expect(commandOf(table, press("k"))).toBe("play");
    expect(commandOf(table, press("z", { ctrlKey: true }))).toBeUndefined();
    expect(table.find((binding) => binding.command === "stop")!.keys).toEqual([]);
  });

  it("never uses Tab, which moves the focus", () => {
    expect(KEYS.flatMap((binding) => binding.keys).join(" ")).not.toMatch(/Tab/);
  });
});

describe("isTaken", () => {
  it("leaves text fields alone, but for the palette", () => {
    const field = element("INPUT", { type: "text" });
    expect(isTaken(field, press("g"))).toBe(true);
    expect(isTaken(field, press("z", { ctrlKey: true }))).toBe(true);
    expect(isTaken(field, press("k", { ctrlKey: true }))).toBe(false);
  });

  it("lets a number field undo where nothing is being typed", () => {
    const field = element("INPUT", { type: "text" }, { settled: "" });
    expect(isTaken(field, press("z", { ctrlKey: true }))).toBe(false);
    expect(isTaken(field, press("z"))).toBe(true);
  });

  it("lets letters through a slider, and no arrows", () => {
    const slider = element("INPUT", { type: "range" });
    expect(isTaken(slider, press("g"))).toBe(false);
    expect(isTaken(slider, press("ArrowLeft"))).toBe(true);
    expect(isTaken(slider, press("z", { ctrlKey: true }))).toBe(false);
  });

  it("lets Space press a button", () => {
    expect(isTaken(element("BUTTON"), press(" "))).toBe(true);
    expect(isTaken(element("BUTTON"), press("ArrowLeft"))).toBe(false);
    expect(isTaken(element("CANVAS"), press(" "))).toBe(false);
    expect(isTaken(null, press(" "))).toBe(false);
  });
});
