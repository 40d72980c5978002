import { expect, it } from "vitest";
import { search, type Command } from "./commands";

function command(name: string, can = true): Command {
  return { id: name, name, group: "Edit", run: () => undefined, can };
}

const all = ["Redo: add sad", "Undo: add sad", "Make it sad", "Sadness (not there)", "Solo"].map((name) =>
  command(name, !name.includes("not")),
);

it("finds all words anywhere, beginnings first, and nothing that cannot be done", () => {
  expect(search(all, "sad").map(({ name }) => name)).toEqual([
    "Redo: add sad",
    "Undo: add sad",
    "Make it sad",
  ]);
  expect(search(all, "so")[0]!.name).toBe("Solo");
  expect(search(all, "make sad").map(({ name }) => name)).toEqual(["Make it sad"]);
  expect(search(all, "(").map(({ name }) => name)).toEqual([]);
  expect(search(all, "")).toHaveLength(4);
});

it("puts a mood before a clip of that name", () => {
  const sample = { ...command("Open the sample tired walk"), id: "sample-tired_walk" };
  const mood = { ...command("Make it tired"), id: "mood-tired" };
  expect(search([sample, mood], "tired").map(({ id }) => id)).toEqual(["mood-tired", "sample-tired_walk"]);
  expect(search([sample, mood], "open tired")).toEqual([sample]);
});
