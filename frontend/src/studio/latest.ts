// One request in flight, and only the newest waits: what a slider passed on its way is never asked.

/** Answers questions one at a time with `answer`; those overtaken while they waited are dropped. */
export class Latest<Question, Answer> {
  #waiting: { question: Question } | null = null;
  #running: { question: Question; stop: AbortController } | null = null;
  readonly #answer: (question: Question, signal: AbortSignal) => Promise<Answer>;
  readonly #done: (answer: Answer, question: Question) => void;
  readonly #failed: (problem: unknown, question: Question) => void;
  readonly #changed: (busy: boolean) => void;

  constructor(
    answer: (question: Question, signal: AbortSignal) => Promise<Answer>,
    done: (answer: Answer, question: Question) => void,
    failed: (problem: unknown, question: Question) => void,
    changed: (busy: boolean) => void = () => undefined,
  ) {
    this.#answer = answer;
    this.#done = done;
    this.#failed = failed;
    this.#changed = changed;
  }

  get busy(): boolean {
    return this.#running !== null;
  }

  /** Ask; with `hurry` the one in flight is given up, and nobody hears its answer. */
  ask(question: Question, hurry: boolean | ((running: Question) => boolean) = false): void {
    this.#waiting = { question };
    if (!this.#running) return void this.#next();
    const give = typeof hurry === "function" ? hurry(this.#running.question) : hurry;
    if (give) this.#running.stop.abort();
  }

  /** Forget what waits and what runs. */
  drop(): void {
    this.#waiting = null;
    this.#running?.stop.abort();
  }

  async #next(): Promise<void> {
    if (!this.#waiting) return;
    const { question } = this.#waiting;
    const stop = new AbortController();
    this.#waiting = null;
    this.#running = { question, stop };
    this.#changed(true);
    try {
      const answer = await this.#answer(question, stop.signal);
      if (!stop.signal.aborted) this.#done(answer, question);
    } catch (problem) {
      if (!stop.signal.aborted) this.#failed(problem, question);
    }
    this.#running = null;
    if (this.#waiting) void this.#next();
    else this.#changed(false);
  }
}
