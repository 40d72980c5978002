// Whether the server is there; where it is gone, it is looked for again until it is back.
import type { Hello } from "../messages";
import { Failed } from "./api";

export type Reach = "there" | "lost" | "shut";

const WAITS = [500, 1000, 2000, 4000] as const; // milliseconds, and then the last one again and again

export class Connection {
  #looking = false;

  constructor(
    private readonly knock: () => Promise<Hello>,
    private readonly changed: (reach: Reach, hello: Hello | null) => void,
    private readonly sleep = (milliseconds: number) =>
      new Promise<void>((wake) => setTimeout(wake, milliseconds)),
  ) {}

  /** A request did not get through: look until it does again. */
  async lost(): Promise<void> {
    if (this.#looking) return;
    this.#looking = true;
    this.changed("lost", null);
    for (let turn = 0; ; turn += 1) {
      await this.sleep(WAITS[Math.min(turn, WAITS.length - 1)]!);
      try {
        const hello = await this.knock();
        this.#looking = false;
        return this.changed("there", hello);
      } catch (problem) {
        if (!(problem instanceof Failed) || problem.kind !== "shut") continue;
        // Someone is there again, who does not know this page's key.
        this.#looking = false;
        return this.changed("shut", null);
      }
    }
  }
}
