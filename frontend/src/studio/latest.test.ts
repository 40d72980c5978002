import { expect, it, vi } from "vitest";
import { Latest } from "./latest";

function made() {
  const open: { question: number; signal: AbortSignal; give(): void; fail(): void }[] = [];
  const done = vi.fn();
  const failed = vi.fn();
  const latest = new Latest<number, number>(
    (question, signal) =>
      new Promise((give, refuse) => {
        open.push({ question, signal, give: () => give(question * 10), fail: () => refuse(new Error("no")) });
      }),
    (answer) => done(answer),
    failed,
  );
  const settle = () => new Promise((resolve) => setTimeout(resolve, 0));
  return { latest, open, done, failed, settle };
}

it("asks the first at once and then only the newest", async () => {
  const { latest, open, done, settle } = made();
  for (const question of [1, 2, 3, 4]) latest.ask(question);
  expect(open.map((asked) => asked.question)).toEqual([1]);
  open[0]!.give();
  await settle();
  expect(open.map((asked) => asked.question)).toEqual([1, 4]);
  open[1]!.give();
  await settle();
  expect(done.mock.calls).toEqual([[10], [40]]);
  expect(latest.busy).toBe(false);
});

it("goes on after a failure", async () => {
  const { latest, open, done, failed, settle } = made();
  latest.ask(1);
  latest.ask(2);
  open[0]!.fail();
  await settle();
  expect(failed).toHaveBeenCalledOnce();
  open[1]!.give();
  await settle();
  expect(done.mock.calls).toEqual([[20]]);
});

it("does not hear what it gave up", async () => {
  const { latest, open, done, failed, settle } = made();
  latest.ask(1);
  latest.ask(2, (running) => running === 1);
  expect(open[0]!.signal.aborted).toBe(true);
  open[0]!.give();
  await settle();
  open[1]!.give();
  await settle();
  expect(done.mock.calls).toEqual([[20]]);
  expect(failed).not.toHaveBeenCalled();
});
