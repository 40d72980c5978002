// What the viewport plays: the last answer, or what can be blended at once while a newer one is on its way.
import type { Stack } from "../messages";
import { blended, clipSource, latticeWeights, type PoseSource } from "../motion/blend";
import type { Clip } from "../wire";
import type { Answers } from "./answers.svelte";
import { share, squareOnly } from "./blending";
import { mixture } from "./rail";
import { isIdle } from "./stack";

const known = new WeakMap<Clip, PoseSource>();

/** The source of a clip; the same one for the same clip. */
export function sourceOf(clip: Clip): PoseSource {
  const there = known.get(clip) ?? clipSource(clip);
  known.set(clip, there);
  return there;
}

/** What to show as edited for a stack; null where it is the original. */
export function editedSource(answers: Answers, wanted: Stack): PoseSource | null {
  const { original, made, nine, rail } = answers;
  if (!original || isIdle(wanted)) return null;
  if (made?.stack === wanted) return sourceOf(made.motion);
  const point = nine && squareOnly(wanted);
  if (point) {
    const weights = latticeWeights(point.path, point.timing);
    return blended(nine.flat().map((clip, at) => ({ source: sourceOf(clip), weight: weights[at]! })));
  }
  const mixed = rail && mixture(rail, made, wanted);
  if (mixed) return blended(mixed.map(({ motion, weight }) => ({ source: sourceOf(motion), weight })));
  if (!made) return null;
  const part = share(made.stack, wanted);
  if (part === null || part === 1) return sourceOf(made.motion);
  return blended([
    { source: sourceOf(original), weight: 1 - part },
    { source: sourceOf(made.motion), weight: part },
  ]);
}
