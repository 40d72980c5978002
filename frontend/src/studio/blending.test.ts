import { describe, expect, it } from "vitest";
import { share, squareOnly } from "./blending";
import * as stacks from "./stack";

const tired = stacks.add(stacks.EMPTY, stacks.layerFor(stacks.EMPTY, "emotion", "tired"));
const both = stacks.add(tired, stacks.layerFor(tired, "edit", "posture", { head: 10 }));

describe("share", () => {
  it("is the ratio of the whole's strengths", () => {
    expect(share({ ...both, strength: 0.8 }, { ...both, strength: 0.2 })).toBeCloseTo(0.25);
  });

  it("takes the strength of an only layer too", () => {
    const half = stacks.change(tired, tired.layers[0]!.id, { strength: 0.5 });
    expect(share(tired, half)).toBeCloseTo(0.5);
    expect(share(half, { ...half, strength: 0.5 })).toBeCloseTo(0.5);
  });

  it("is not to be had where one of two layers changes, or it grows too far, or begins at nothing", () => {
    expect(share(both, stacks.change(both, both.layers[0]!.id, { strength: 0.5 }))).toBeNull();
    expect(share(tired, { ...tired, strength: 1.2 })).toBeCloseTo(1.2);
    expect(share(tired, { ...tired, strength: 1.9 })).toBeNull();
    expect(share({ ...tired, strength: 0 }, tired)).toBeNull();
    expect(share(tired, stacks.change(tired, tired.layers[0]!.id, { name: "sad" }))).toBeNull();
    expect(share(tired, { ...tired, safe: false })).toBeNull();
  });
});

it("finds the point of a stack that is the square alone", () => {
  const square = stacks.setEdit(stacks.EMPTY, "", "grid", { path: 1.5 });
  expect(squareOnly(square.stack)).toEqual({ path: 1.5, timing: 1 });
  expect(squareOnly(stacks.setEdit(square.stack, "", "posture", { head: 3 }).stack)).toBeNull();
  expect(squareOnly(stacks.change(square.stack, square.id, { parts: ["arms"] }))).toBeNull();
});
