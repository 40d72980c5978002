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
  #paused = false;

  constructor(
    private readonly shelf: Shelf,
    private readonly tell: (project: Project, last: boolean) => Promise<unknown>,
    private readonly heard: (state: Keeping, why: string) => void,
  ) {}

  /** A tab that gave the work away keeps nothing, not even what it was about to send. */
  set paused(paused: boolean) {
    this.#paused = paused;
    if (!paused) return;
    clearTimeout(this.#timer);
    this.#newest = null;
  }

  keep(project: Project): void {
    if (this.#paused) return;
    this.#newest = project;
    this.heard(this.#here(project) ? "waiting" : "failed", FULL);
    clearTimeout(this.#timer);
    this.#timer = setTimeout(() => void this.#there(), WAIT);
  }

  /** The page goes: what is not with the server yet is sent now. */
  flush(): void {
    clearTimeout(this.#timer);
    if (this.#newest) void this.tell(this.#newest, true).catch(() => undefined);
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

const NAME = "mien studio keeps"; // of the lock; the browser gives it to one tab at a time
const LEFT = "mien: left"; // in the tab's own storage: when it was left while it kept the work
const RELOAD = 10_000; // milliseconds in which a tab that was left is there again, if it was reloaded
const GRACE = 1500; // milliseconds that a waiting tab gives the other one to come back
const NEVER = new Promise<void>(() => undefined);

/** Which tab keeps the work: the first one, until it is closed or another one takes it. */
export class Tabs {
  /** What this tab holds the lock by; another one each time. */
  #held: object | null = null;
  #waiting: AbortController | undefined;

  /** `lost` is called where another tab took the work, `got` where it fell to this one, which had waited. */
  constructor(
    private readonly lost: () => void,
    private readonly got: () => void,
    private readonly locks: LockManager = navigator.locks,
    private readonly own: Storage | undefined = globalThis.sessionStorage,
  ) {}

  /** Whether the work is this tab's. */
  get mine(): boolean {
    return this.#held !== null;
  }

  /** Learn whether this tab keeps the work; where it does not, it waits for it. */
  async begin(): Promise<boolean> {
    const left = Number(this.own?.getItem(LEFT) ?? 0);
    this.own?.removeItem(LEFT);
    // A tab that is reloaded goes on: the work is not for those that wait.
    const again = Date.now() - left < RELOAD;
    const mine = await this.#hold(again ? { steal: true } : { ifAvailable: true });
    if (!mine) this.#wait();
    return mine;
  }

  /** Take the work from whichever tab has it. */
  async take(): Promise<void> {
    this.#waiting?.abort();
    if (!this.#held) await this.#hold({ steal: true });
  }

  /** The page goes. */
  leave(): void {
    if (this.#held) this.own?.setItem(LEFT, String(Date.now()));
  }

  #wait(): void {
    const waiting = (this.#waiting = new AbortController());
    void this.#hold({ signal: waiting.signal }).then((mine) => {
      if (!mine) return;
      const held = this.#held;
      setTimeout(() => {
        if (!waiting.signal.aborted && held === this.#held) this.got();
      }, GRACE);
    });
  }

  /** Get the lock and hold it for as long as the page is there; whether it came. */
  #hold(options: LockOptions): Promise<boolean> {
    const mine = {};
    return new Promise((resolve) => {
      const given = (lock: Lock | null) => {
        if (lock) this.#held = mine;
        resolve(lock !== null);
        return lock ? NEVER : undefined;
      };
      // It fails where it is not waited for any more, and where another tab takes the lock away.
      this.locks.request(NAME, options, given).catch(() => {
        resolve(false);
        if (this.#held !== mine) return;
        this.#held = null;
        this.lost();
        this.#wait();
      });
    });
  }
}
