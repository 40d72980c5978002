// Parts of the body as mien has them: those that stand for several, and what of.
import type { Made } from "../controls/included";

export const MADE_OF: Made = {
  arms: ["left_arm", "right_arm"],
  legs: ["left_leg", "right_leg"],
  upper: ["head", "torso", "left_arm", "right_arm"],
  left: ["left_arm", "left_leg"],
  right: ["right_arm", "right_leg"],
};
