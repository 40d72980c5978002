// How far the server is with what this page waits for; asked now and then, and only where it takes long.
import type { WorkInfo } from "../messages";

const LONG = 1000; // milliseconds from which on it is worth knowing
const AGAIN = 500;

export class Work {
  all = $state.raw<readonly WorkInfo[]>([]);
  #waiting = 0;
  #timer: ReturnType<typeof setTimeout> | undefined;

  constructor(private readonly ask: () => Promise<WorkInfo[]>) {}

  /** What is worked out of a kind. */
  of(kind: string): WorkInfo | undefined {
    return this.all.find((work) => work.kind === kind);
  }

  /** Somebody waits, until what is returned is called. */
  begin(): () => void {
    if (this.#waiting++ === 0) this.#timer = setTimeout(() => void this.#look(), LONG);
    let over = false;
    return () => {
      if (over) return;
      over = true;
      if (--this.#waiting) return;
      clearTimeout(this.#timer);
      this.all = [];
    };
  }

  async #look(): Promise<void> {
    const all = await this.ask().catch(() => []);
    if (!this.#waiting) return;
    this.all = all;
    clearTimeout(this.#timer);
    this.#timer = setTimeout(() => void this.#look(), AGAIN);
  }
}
