import { expect, it, vi } from "vitest";
import type { Hello } from "../messages";
import { Failed } from "./api";
import { Connection } from "./connection";

const hello = { version: "1" } as Hello;
const noWait = async () => undefined;

it("knocks until someone is there", async () => {
  const knock = vi
    .fn()
    .mockRejectedValueOnce(new Failed("lost", "gone"))
    .mockRejectedValueOnce(new Failed("lost", "gone"))
    .mockResolvedValue(hello);
  const heard: unknown[] = [];
  const connection = new Connection(knock, (...given) => heard.push(given), noWait);
  await Promise.all([connection.lost(), connection.lost()]);
  expect(knock).toHaveBeenCalledTimes(3);
  expect(heard).toEqual([
    ["lost", null],
    ["there", hello],
  ]);
});

it("stops at a server that does not know its key", async () => {
  const heard: unknown[] = [];
  const refuse = () => Promise.reject(new Failed("shut", "no", 401));
  await new Connection(refuse, (reach) => heard.push(reach), noWait).lost();
  expect(heard).toEqual(["lost", "shut"]);
});
