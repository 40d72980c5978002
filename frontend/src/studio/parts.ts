// Parts of the body as mien has them: those that stand for several, and what of.
import type { Made } from "../controls/included";

export const MADE_OF: Made = {
  arms: ["left_arm", "right_arm"],
  legs: ["left_leg", "right_leg"],
  upper: ["head", "torso", "left_arm", "right_arm"],
  left: ["left_arm", "left_leg"],
  right: ["right_arm", "right_leg"],
};

/** A text as its first sentence, without the full stop, and what follows it. */
export function firstSentence(text: string): readonly [string, string] {
  const end = text.search(/\.\s/);
  return end < 0 ? [text.replace(/\.$/, ""), ""] : [text.slice(0, end), text.slice(end + 1).trim()];
}
