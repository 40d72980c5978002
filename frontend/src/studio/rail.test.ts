import { expect, it } from "vitest";
import type { Clip } from "../wire";
import { mixture, restOf, stops, valueAt, withValue, type Knob, type Rail } from "./rail";
import * as stacks from "./stack";

const both = stacks.add(
  stacks.add(stacks.EMPTY, stacks.layerFor(stacks.EMPTY, "emotion", "tired")),
  { ...stacks.layerFor(stacks.EMPTY, "edit", "posture", { head: 10, chest: 5 }), id: "layer 2" },
);
const head: Knob = { layer: "layer 2", name: "head", low: -60, high: 60 };
const strength: Knob = { layer: "layer 1", name: "", low: 0, high: 2 };
const whole: Knob = { layer: "", name: "", low: 0, high: 2 };
const motions = ["low", "now", "high", "made"].map((name) => ({ name }) as unknown as Clip);
const [low, now, high, made] = motions as [Clip, Clip, Clip, Clip];
const rail: Rail = {
  knob: head,
  rest: restOf(both, head),
  points: [
    { value: -60, motion: low },
    { value: 10, motion: now },
    { value: 60, motion: high },
  ],
};
const at = (value: number) => withValue(both, head, value);

it("reads and sets a parameter or a strength of one layer, or of the whole", () => {
  expect([valueAt(both, head), valueAt(both, strength), valueAt(both, whole)]).toEqual([10, 1, 1]);
  expect(withValue(both, whole, 0.5)).toEqual({ ...both, strength: 0.5 });
  expect(restOf(withValue(both, whole, 0.5), whole)).toBe(restOf(both, whole));
  expect(at(20).layers[1]!.parameters).toEqual({ head: 20, chest: 5 });
  expect(withValue(both, strength, 0.5).layers[0]!.strength).toBe(0.5);
  expect(valueAt(both, { ...head, layer: "layer 9" })).toBeNull();
  expect(valueAt(stacks.change(both, "layer 1", { strength: [[0, 1]] }), strength)).toBeNull();
});

it("is laid through both ends, the present value, and halfway between, each once", () => {
  expect(stops(both, head)).toEqual([-60, -25, 10, 35, 60]);
  expect(stops(at(60), head)).toEqual([-60, 0, 60]);
  expect(stops(at(90), head)).toEqual([-60, 0, 60]);
  expect(stops(both, strength)).toEqual([0, 0.5, 1, 1.5, 2]);
});

it("mixes the two motions that a value lies between", () => {
  expect(mixture(rail, null, at(35))).toEqual([
    { motion: now, weight: 0.5 },
    { motion: high, weight: 0.5 },
  ]);
  expect(mixture(rail, null, at(-60))).toEqual([{ motion: low, weight: 1 }]);
  expect(mixture(rail, null, at(-80))).toEqual([{ motion: low, weight: 1 }]);
  expect(mixture(rail, null, at(80))).toEqual([{ motion: high, weight: 1 }]);
});

it("takes in what was made last, in place of the point at its value", () => {
  expect(mixture(rail, { motion: made, stack: at(40) }, at(50))).toEqual([
    { motion: made, weight: 0.5 },
    { motion: high, weight: 0.5 },
  ]);
  expect(mixture(rail, { motion: made, stack: at(10) }, at(10))).toEqual([
    { motion: low, weight: 0 },
    { motion: made, weight: 1 },
  ]);
  const other = stacks.change(at(40), "layer 1", { strength: 0.5 });
  expect(mixture(rail, { motion: made, stack: other }, at(35))![0]!.motion).toBe(now);
});

it("knows a stack by what it does, not by the order in which parameters were set", () => {
  const reset = stacks.setParameter(both, "layer 2", "head", 35);
  expect(Object.keys(reset.layers[1]!.parameters)).toEqual(["chest", "head"]);
  expect(mixture(rail, null, reset)).not.toBeNull();
});

it("is not for a stack that differs in anything else", () => {
  expect(mixture(rail, null, stacks.setParameter(both, "layer 2", "chest", 6))).toBeNull();
  expect(mixture(rail, null, { ...both, safe: false })).toBeNull();
  expect(mixture(rail, null, stacks.remove(both, "layer 2"))).toBeNull();
});
