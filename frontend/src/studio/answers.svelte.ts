// What the server said about the clip that is shown: its motion, the edit, readings, checks, curves.
import type { Checks, Curve, CurvesRequest, EditRequest, Readings, Stack } from "../messages";
import type { Clip } from "../wire";
import { asSentence, Failed, type Api } from "./api";
import { Latest } from "./latest";
import { nineOf, type Nine } from "./nine";
import { EMPTY, isIdle } from "./stack";

/** So many frames an answer takes a second for at worst, on a slow machine that has other things to do. */
const FRAMES_A_SECOND = 60;

/** An edited motion, and the stack that made it. */
export interface Made {
  motion: Clip;
  stack: Stack;
  live: boolean;
}

/** Asks in the background, one at a time of each kind; the page shows whatever came last. */
export class Answers {
  original = $state.raw<Clip | null>(null);
  made = $state.raw<Made | null>(null);
  nine = $state.raw<Nine | null>(null);
  readings = $state.raw<Readings | null>(null);
  checks = $state.raw<Checks | null>(null);
  curves = $state.raw<readonly Curve[]>([]);
  editing = $state(false);
  reading = $state(false);
  checking = $state(false);
  loading = $state(false);
  /** Why the last edit could not be made; the motion before it is still shown. */
  problem = $state("");
  #clip = "";
  #wantsNine = false;
  #turn = 0;
  /** Tells this page from others. */
  readonly client = crypto.randomUUID();
  readonly #edits: Latest<EditRequest, Clip>;
  readonly #readings: Latest<EditRequest, Readings>;
  readonly #checks: Latest<EditRequest, Checks>;
  readonly #curves: Latest<CurvesRequest, Curve[]>;

  constructor(
    private readonly api: Api,
    private readonly failed: (sentence: string) => void,
    private readonly settled: () => void,
  ) {
    this.#edits = new Latest(
      (request, signal) => api.edit(request, signal, this.#patience()),
      (motion, request) => this.#edited(motion, request),
      (problem, request) => this.#refused(problem, request),
      (busy) => (this.editing = busy),
    );
    this.#readings = new Latest(
      (request, signal) => api.reading(request, signal, this.#patience()),
      (readings, request) => void (request.clip === this.#clip && (this.readings = readings)),
      (problem) => this.#quietly(problem),
      (busy) => (this.reading = busy),
    );
    this.#checks = new Latest(
      (request, signal) => api.checks(request, signal, this.#patience()),
      (checks, request) => void (request.clip === this.#clip && (this.checks = checks)),
      (problem) => this.#quietly(problem),
      (busy) => (this.checking = busy),
    );
    this.#curves = new Latest(
      (request, signal) => api.curves(request, signal),
      (curves, request) => void (request.clip === this.#clip && (this.curves = curves)),
      (problem) => this.#quietly(problem),
    );
  }

  /** Show another clip, or none; resolves when its motion is there. */
  async show(id: string): Promise<void> {
    for (const queue of [this.#edits, this.#readings, this.#checks, this.#curves]) queue.drop();
    this.#clip = id;
    this.#wantsNine = false;
    this.original = this.made = this.nine = this.readings = this.checks = null;
    this.curves = [];
    this.problem = "";
    if (!id) return;
    this.loading = true;
    try {
      const motion = await this.api.motion(id);
      if (this.#clip === id) this.original = motion;
    } finally {
      if (this.#clip === id) this.loading = false;
    }
  }

  /** Ask for what a stack makes of the clip; `live` while a slider is on its way. */
  edit(stack: Stack, live: boolean): void {
    if (!this.#clip || !this.original) return;
    if (isIdle(stack)) {
      // What was made last stays, to be blended from when the strength comes up again.
      this.#edits.drop();
      this.problem = "";
      if (!live) this.settled();
      return;
    }
    // A slider does not wait for the careful answer that it has overtaken.
    this.#edits.ask(this.#request(stack, live), (running) => live && !running.live);
  }

  /** Ask what the motion expresses, whether it is right, and how it runs. */
  measure(stack: Stack, curves: readonly string[]): void {
    if (!this.#clip || !this.original?.head.shape) return;
    this.#readings.ask(this.#request(stack, false), true);
    this.#checks.ask(this.#request(stack, false), true);
    this.draw(stack, curves);
  }

  /** Ask for curves. */
  draw(stack: Stack, curves: readonly string[]): void {
    if (!this.#clip || !this.original?.head.shape) return;
    this.#curves.ask({ clip: this.#clip, stack, names: [...curves] }, true);
  }

  /** Get the nine motions of the square, once, when someone is about to use it. */
  async wantNine(): Promise<void> {
    const clip = this.#clip;
    if (this.#wantsNine || !clip || !this.original?.head.shape) return;
    this.#wantsNine = true;
    try {
      const { head, arrays } = await this.api.square(this.#request(EMPTY, false));
      if (this.#clip === clip && this.original) this.nine = nineOf(this.original, head, arrays);
    } catch {
      this.#wantsNine = false; // the square works without, by asking each time
    }
  }

  /** Seconds to wait for an answer: longer clips take longer. */
  #patience(): number {
    return Math.max(120, Math.ceil((this.original?.head.frames ?? 0) / FRAMES_A_SECOND));
  }

  #request(stack: Stack, live: boolean): EditRequest {
    return { clip: this.#clip, stack, live, client: this.client, turn: ++this.#turn };
  }

  #edited(motion: Clip, request: EditRequest): void {
    if (request.clip !== this.#clip) return;
    this.made = { motion, stack: request.stack, live: request.live };
    this.problem = "";
    if (!request.live) this.settled();
  }

  #refused(problem: unknown, request: EditRequest): void {
    if (problem instanceof Failed && problem.kind !== "said" && problem.kind !== "late") return;
    this.problem = asSentence(problem);
    if (!request.live) this.failed(this.problem);
  }

  /** Measures that fail beside an edit are no news: the panel shows that they are missing. */
  #quietly(problem: unknown): void {
    if (problem instanceof Failed && problem.kind === "said" && !this.problem) this.problem = problem.message;
  }
}
