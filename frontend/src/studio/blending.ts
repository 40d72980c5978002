// What the page can show at once, before the server has answered: blends of motions that are there.
import type { Stack } from "../messages";
import { active } from "./stack";

/** As far beyond a motion as a blend still looks right; the server's answer follows anyway. */
const FURTHEST = 1.5;

/**
 * How much of the edited motion, made by `made`, shows what `wanted` asks for, and the rest is the original.
 * Null where it cannot be had by blending: where more than one strength differs, or it grows too far.
 */
export function share(made: Stack, wanted: Stack): number | null {
  if (made === wanted) return 1;
  const before = strengths(made);
  const after = strengths(wanted);
  if (!before || !after || before.rest !== after.rest || before.value <= 0) return null;
  const part = after.value / before.value;
  return part <= FURTHEST ? part : null;
}

/** The one strength of a stack (the whole's times its only active layer's), and all else as text. */
function strengths(stack: Stack): { value: number; rest: string } | null {
  if (typeof stack.strength !== "number") return null;
  const layers = active(stack);
  const [only] = layers;
  const one = layers.length === 1 && only && typeof only.strength === "number" ? only.strength : null;
  const rest = layers.map((layer) => {
    const { id: _id, solo: _solo, on: _on, ...others } = layer;
    return one === null ? others : { ...others, strength: 1 };
  });
  return {
    value: stack.strength * (one ?? 1),
    rest: JSON.stringify([rest, stack.foot_plant, stack.safe]),
  };
}

/** The square's point of a stack that does nothing else, so that it can be blended from the nine. */
export function squareOnly(stack: Stack): { path: number; timing: number } | null {
  const layers = active(stack);
  const [layer] = layers;
  if (layers.length !== 1 || layer?.kind !== "edit" || layer.name !== "grid") return null;
  if (stack.strength !== 1 || layer.strength !== 1 || layer.parts.length || layer.span) return null;
  const { path = 1, timing = 1, ...others } = layer.parameters;
  if (typeof path !== "number" || typeof timing !== "number" || Object.keys(others).length) return null;
  return { path, timing };
}
