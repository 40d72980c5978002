import { expect, it } from "vitest";
import { begun, changed, redone, settled, undone } from "./history";

it("makes one step of one drag", () => {
  let history = begun(0);
  for (const value of [1, 2, 3]) history = changed(history, value, "drag", "slider");
  history = settled(history);
  history = changed(history, 4, "drag", "slider");
  expect(history.past.map((entry) => entry.value)).toEqual([0, 3]);
  history = undone(history);
  expect(history.present.value).toBe(3);
  history = undone(history);
  expect(history.present.value).toBe(0);
  expect(undone(history)).toBe(history);
});

it("goes forward again until something new is done", () => {
  let history = changed(changed(begun("a"), "b", "1"), "c", "2");
  history = redone(undone(undone(history)));
  expect(history.present).toEqual({ value: "b", label: "1" });
  history = changed(history, "d", "3");
  expect(redone(history)).toBe(history);
  expect(undone(history).present.value).toBe("b");
});

it("does not take a drag after undo for the same one", () => {
  let history = changed(begun(0), 1, "drag", "slider");
  history = changed(undone(history), 2, "drag", "slider");
  expect(undone(history).present.value).toBe(0);
});
