import { expect, it } from "vitest";
import { columnsOf, moved } from "./roving";

it("arrows stay inside, and go by rows where there is one", () => {
  const go = (key: string, at: number) => moved(key, at, 7, 3); // 0 1 2 / 3 4 5 / 6
  expect([go("ArrowRight", 2), go("ArrowRight", 6), go("ArrowLeft", 3), go("ArrowLeft", 0)]).toEqual([3, 6, 2, 0]);
  expect([go("ArrowDown", 3), go("ArrowDown", 4), go("ArrowUp", 4), go("ArrowUp", 2)]).toEqual([6, 4, 1, 2]);
  expect([go("Home", 5), go("End", 0), go("x", 3), go("Enter", 3)]).toEqual([0, 6, null, null]);
});

it("a row is as long as the first one", () => {
  expect([columnsOf([5, 5, 5, 40, 40]), columnsOf([5, 5]), columnsOf([5, 9])]).toEqual([3, 2, 1]);
});
