import { describe, expect, it } from "vitest";
import { Drag, snap, stepped } from "./steps";

const range = { low: -1, high: 1, step: 0.05 };

describe("keys", () => {
  it.each([
    ["ArrowRight", false, 0.05], ["ArrowUp", false, 0.05], ["ArrowLeft", false, -0.05],
    ["ArrowRight", true, 0.01],
    ["PageUp", false, 0.5], ["PageDown", true, -0.1], ["Home", false, -1], ["End", false, 1],
  ])("%s, shift %s", (key, shift, value) => expect(stepped(key, shift, 0, range)).toBe(value));
  it("stop at the ends and leave other keys alone", () => {
    expect(stepped("ArrowRight", false, 0.98, range)).toBe(1);
    expect(stepped("Tab", false, 0, range)).toBeNull();
    expect(stepped("k", false, 0, range)).toBeNull();
  });
  it("do not gather the errors of floating point", () => {
    let value = 0;
    for (let i = 0; i < 12; i++) value = stepped("ArrowRight", false, value, range)!;
    expect(value).toBe(0.6);
  });
});

it("a drag meets round numbers, whatever the range begins with", () => {
  expect(snap(0.33, { low: 0.02, high: 1, step: 0.05 })).toBe(0.35);
  expect(snap(0.021, { low: 0.02, high: 1, step: 0.05 })).toBe(0.02);
  expect(snap(7, range)).toBe(1);
});

it("a drag can be slowed on its way and does not jump", () => {
  const at = (clientX: number, slow = false) => ({ clientX, clientY: 0, altKey: slow, shiftKey: false });
  const drag = new Drag([0.5, 0], at(100));
  expect(drag.to(at(110), 0.01, 0)[0]).toBeCloseTo(0.6, 12);
  expect(drag.to(at(120, true), 0.01, 0)[0]).toBeCloseTo(0.62, 12);
  expect(drag.to(at(110), 0.01, 0)[0]).toBeCloseTo(0.52, 12);
});
