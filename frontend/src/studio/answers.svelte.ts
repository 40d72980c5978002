// What the server said about the clip that is shown: its motion, the edit, readings, checks, curves.
import type { Checks, Curve, CurvesRequest, EditRequest, Readings, Stack } from "../messages";
import type { Clip } from "../wire";
import { asSentence, Failed, type Api } from "./api";
import { Latest } from "./latest";
import { nineOf, type Nine } from "./nine";
import { restOf, stops, withValue, type Knob, type Point, type Rail } from "./rail";
import { EMPTY, isIdle } from "./stack";

/** So many frames an answer takes a second for at worst, on a slow machine that has other things to do. */
const FRAMES_A_SECOND = 60;
/** Of longer clips no rails are laid: five motions of theirs would keep the slider's own answers waiting. */
const LONGEST_RAIL = 3000;

/** An edited motion, and the stack that made it. */
export interface Made {
  motion: Clip;
  stack: Stack;
  live: boolean;
}

/** A rail that is wanted: for a knob of a stack. */
interface RailRequest {
  clip: string;
  stack: Stack;
  knob: Knob;
  rest: string;
}

/** Asks in the background, one at a time of each kind; the page shows whatever came last. */
export class Answers {
  original = $state.raw<Clip | null>(null);
  made = $state.raw<Made | null>(null);
  nine = $state.raw<Nine | null>(null);
  rail = $state.raw<Rail | null>(null);
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
  /** The rail that is there or was asked for last. */
  #wanted = "";
  #turn = 0;
  /** Tells this page from others. */
  readonly client = crypto.randomUUID();
  readonly #edits: Latest<EditRequest, Clip>;
  readonly #readings: Latest<EditRequest, Readings>;
  readonly #checks: Latest<EditRequest, Checks>;
  readonly #curves: Latest<CurvesRequest, Curve[]>;
  readonly #rails: Latest<RailRequest, Rail>;

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
    this.#rails = new Latest(
      (request, signal) => this.#layRail(request, signal),
      (rail, request) => void (request.clip === this.#clip && (this.rail = rail)),
      () => (this.#wanted = ""), // the slider works without, by asking each time
    );
  }

  /** Show another clip, or none; resolves when its motion is there. */
  async show(id: string): Promise<void> {
    for (const queue of [this.#edits, this.#readings, this.#checks, this.#curves, this.#rails]) {
      queue.drop();
    }
    this.#clip = id;
    this.#wantsNine = false;
    this.#wanted = "";
    this.original = this.made = this.nine = this.rail = this.readings = this.checks = null;
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

  /** Get the motions that a number of the stack can be blended from, when someone is about to move it. */
  wantRail(stack: Stack, knob: Knob): void {
    const shape = this.original?.head.shape;
    if (!shape || this.original!.head.frames > LONGEST_RAIL) return;
    const rest = restOf(stack, knob);
    const wanted = JSON.stringify([knob, rest]);
    if (wanted === this.#wanted) return;
    this.#wanted = wanted;
    this.#rails.ask({ clip: this.#clip, stack, knob, rest }, true);
  }

  async #layRail({ stack, knob, rest }: RailRequest, signal: AbortSignal): Promise<Rail> {
    const points: Point[] = [];
    for (const value of stops(stack, knob)) {
      // In a line of its own, so that it overtakes no edit and none overtakes it.
      const request = { ...this.#request(withValue(stack, knob, value), true), client: `${this.client} rail` };
      points.push({ value, motion: await this.api.edit(request, signal, this.#patience()) });
    }
    return { knob, rest, points };
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
