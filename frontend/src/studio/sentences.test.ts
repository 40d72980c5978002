import { expect, it } from "vitest";
import { firstSentence } from "./sentences";

it("a text is its first sentence and the rest", () => {
  expect(firstSentence("Not found: left_knee. Its joints are: Hips.\n[roles]")).toEqual([
    "Not found: left_knee",
    "Its joints are: Hips.\n[roles]",
  ]);
  expect(firstSentence("Only 0.5 of it.")).toEqual(["Only 0.5 of it", ""]);
});
