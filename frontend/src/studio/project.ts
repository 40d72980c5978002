// Keeping the work: in this browser at once, with the server soon after, and by one tab at a time.
import type { Project } from "../messages";
import { Failed } from "./api";

const PLACE = "mien project";
const WAIT = 700; // milliseconds without a change before the server is told
const VERSION = 1;

export type Keeping = "kept" | "waiting" | "local" | "failed";

/** Where a text can be kept in this browser; what `localStorage` is. */
export type Shelf = Pick<Storage, "getItem" | "setItem">;

/** When a project was last kept: a number it carries in its view. */
export function savedAt(project: Project | null): number {
  const saved = project?.view["saved"];
  return typeof saved === "number" ? saved : 0;
}

/** The one of both that was kept last. */
export function newer(one: Project | null, other: Project | null): Project | null {
  return savedAt(other) > savedAt(one) ? other : (one ?? other);
}

/** The project that this browser keeps; null where there is none, or none that can be read. */
export function keptHere(shelf: Shelf): Project | null {
  try {
    const read = JSON.parse(shelf.getItem(PLACE) ?? "null") as Project | null;
    const fits = read && Array.isArray(read.clips) && read.view && read.mien_project === VERSION;
    return fits ? read : null;
  } catch {
    return null;
  }
}

/** Keeps the newest project it is given, here and at the server, and says how that goes. */
export class Keeper {
  #timer: ReturnType<typeof setTimeout> | undefined;
  #newest: Project | null = null;
  #busy = false;
  /** A tab that gave the work away keeps nothing. */
  paused = false;

  constructor(
    private readonly shelf: Shelf,
    private readonly tell: (project: Project, last: boolean) => Promise<unknown>,
    private readonly heard: (state: Keeping, why: string) => void,
  ) {}

  keep(project: Project): void {
    if (this.paused) return;
    this.#newest = project;
    this.heard(this.#here(project) ? "waiting" : "failed", FULL);
    clearTimeout(this.#timer);
    this.#timer = setTimeout(() => void this.#there(), WAIT);
  }

  /** The page goes: what is not with the server yet is sent now. */
  flush(): void {
    clearTimeout(this.#timer);
    if (this.#newest && !this.paused) void this.tell(this.#newest, true).catch(() => undefined);
    this.#newest = null;
  }

  /** Try again what could not be sent, as when the server is back. */
  again(): void {
    if (this.#newest) void this.#there();
  }

  #here(project: Project): boolean {
    try {
      this.shelf.setItem(PLACE, JSON.stringify(project));
      return true;
    } catch {
      return false; // this browser's place is full, or it keeps nothing
    }
  }

  async #there(): Promise<void> {
    const project = this.#newest;
    if (!project || this.#busy) return;
    this.#busy = true;
    try {
      await this.tell(project, false);
      if (this.#newest === project) {
        this.#newest = null;
        this.heard("kept", "");
      }
    } catch (problem) {
      const lost = problem instanceof Failed && (problem.kind === "lost" || problem.kind === "shut");
      this.heard(lost ? "local" : "failed", problem instanceof Error ? problem.message : String(problem));
    }
    this.#busy = false;
    if (this.#newest && this.#newest !== project) void this.#there();
  }
}

const FULL = "this browser keeps nothing more (its storage is full); the server still does";

interface Word {
  from: string;
  says: "who is there" | "I am" | "mine now";
}

/** Which tab keeps the work: the first one, until another one takes it. */
export class Tabs {
  readonly #channel = new BroadcastChannel("mien studio");
  readonly #me = crypto.randomUUID();

  /** `second` is called where another tab was here first; `taken` where another takes the work over. */
  constructor(second: () => void, taken: () => void) {
    this.#channel.onmessage = ({ data }: MessageEvent<Word>) => {
      if (data.says === "who is there" && this.owns) this.#say("I am");
      if (data.says === "I am" && this.owns) {
        this.owns = false;
        second();
      }
      if (data.says === "mine now" && this.owns) {
        this.owns = false;
        taken();
      }
    };
    this.#say("who is there");
  }

  owns = true;

  take(): void {
    this.owns = true;
    this.#say("mine now");
  }

  #say(says: Word["says"]): void {
    this.#channel.postMessage({ from: this.#me, says } satisfies Word);
  }
}
