// A viewer with its own controls and keys: for the page without a server, and for notebooks.
import type { PoseSource } from "../motion/blend";
import { Playback, SPEEDS } from "../playback";
import css from "./player.css?inline";
import type { Theme } from "./stage";
import { Viewer, type Mode, type View } from "./viewer";

export interface PlayerOptions {
  original: PoseSource | null;
  edited: PoseSource | null;
  quality?: "high" | "low";
  theme?: Theme;
  neutral?: boolean;
  /** Whether it plays at once; not where less motion is asked for. */
  autoplay?: boolean;
  /** Whether keys are heard anywhere on the page, or only inside the player. */
  keys?: "page" | "inside";
}

interface Switch {
  label: string;
  key: string;
  help: string;
  get: () => boolean;
  set: (on: boolean) => void;
}

const MODES: readonly (readonly [Mode, string])[] = [
  ["edited", "edited"], ["original", "original"], ["overlay", "over each other"], ["side", "side by side"],
  ["wipe", "wipe"],
];
const VIEWS: readonly (readonly [View, string, string])[] = [
  ["front", "1", "Front"], ["side", "3", "Side"], ["top", "7", "Top"], ["perspective", "5", "Perspective"],
];
const TURN = Math.PI / 24;
const APART = 0.7; // metres between the figures from which both are kept in place, to be seen together

/** Build a player into `host`, which gives it its size. */
export class Player {
  readonly viewer: Viewer;
  readonly playback = new Playback();
  #root = make("section", { className: "mien-player", ariaLabel: "Motion viewer" });
  #switches: Switch[] = [];
  #refreshers: (() => void)[] = [];
  #listening = new AbortController();
  #help = make("dialog");
  #before: Mode | null = null;

  constructor(host: HTMLElement, options: PlayerOptions) {
    adopt(host);
    host.append(this.#root);
    const view = make("div", { className: "mien-view" });
    const bar = make("div", { className: "mien-bar", role: "group", ariaLabel: "Controls" });
    this.#root.append(view, bar, this.#help);
    const { quality = "high", theme = "light", neutral = false } = options;
    this.viewer = new Viewer(view, { playback: this.playback, quality, theme, neutral });
    this.viewer.setOriginal(options.original);
    this.viewer.setEdited(options.edited);
    if (options.original && options.edited) {
      this.viewer.mode = "overlay";
      this.viewer.treadmill = this.viewer.drift > APART;
    }
    this.viewer.canvas.role = "img";
    this.viewer.canvas.ariaLabel = nameOf(options);
    this.#switches = this.#listSwitches();
    this.#fill(bar, Boolean(options.original && options.edited));
    this.#explain();
    this.#listen(options.keys === "page" ? document : this.#root);
    this.#refresh();
    const still = matchMedia("(prefers-reduced-motion: reduce)").matches;
    if (options.autoplay && !still) this.playback.set({ playing: true });
  }

  dispose(): void {
    this.#listening.abort();
    this.viewer.dispose();
    this.#root.remove();
  }

  #listSwitches(): Switch[] {
    const { viewer } = this;
    const all = { hands: true, feet: true, head: true };
    return [
      { label: "Follow", key: "c", help: "camera follows the figure", get: () => viewer.follow, set: (on) => (viewer.follow = on) },
      { label: "In place", key: "y", help: "figures stay in place, the floor moves", get: () => viewer.treadmill, set: (on) => (viewer.treadmill = on) },
      { label: "Trails", key: "t", help: "paths of hands, feet and head", get: () => viewer.trails.hands,
        set: (on) => (viewer.trails = on ? all : { hands: false, feet: false, head: false }) },
      { label: "Footprints", key: "p", help: "where the feet stand", get: () => viewer.footprints, set: (on) => (viewer.footprints = on) },
      { label: "Names", key: "n", help: "names of the joints", get: () => viewer.names, set: (on) => (viewer.names = on) },
      { label: "Grid", key: "#", help: "grid of metres", get: () => viewer.grid, set: (on) => (viewer.grid = on) },
      { label: "Dark", key: "d", help: "dark", get: () => viewer.theme === "dark", set: (on) => (viewer.theme = on ? "dark" : "light") },
    ];
  }

  #fill(bar: HTMLElement, two: boolean): void {
    bar.append(this.#time());
    if (two) bar.append(this.#modes());
    for (const [view, key, label] of VIEWS) {
      bar.append(button(label, `${label} view (${key})`, () => this.viewer.view(view)));
    }
    bar.append(button("Whole", "See the figure whole (F)", () => this.viewer.frame()), make("span", { className: "gap" }));
    for (const one of this.#switches) bar.append(this.#toggle(one));
    bar.append(
      button("Picture", "Save what is seen as a picture", () => void this.#picture()),
      button("Keys", "Show the keys (?)", () => this.#help.showModal()),
    );
  }

  #time(): HTMLElement {
    const row = make("div", { className: "time" });
    const { playback } = this;
    const play = button("Play", "Play or pause (space)", () => playback.set({ playing: !playback.playing }));
    play.className = "play";
    const scrub = make("input", { type: "range", min: "0", ariaLabel: "Time" });
    scrub.addEventListener("input", () => playback.set({ playing: false, time: Number(scrub.value) }));
    const clock = make("output", { ariaLive: "off" });
    const speed = make("select", { ariaLabel: "Speed", title: "Speed (- and +)" });
    for (const value of SPEEDS) speed.add(new Option(`× ${value}`, String(value)));
    speed.addEventListener("change", () => playback.set({ speed: Number(speed.value) }));
    row.append(play, scrub, clock, speed);
    const stop = playback.subscribe(() => {
      const { time, duration, frame, frameTime, playing } = playback;
      play.textContent = playing ? "Pause" : "Play";
      scrub.max = String(duration);
      scrub.step = String(frameTime);
      scrub.value = String(time);
      const text = `${time.toFixed(2)} s, frame ${frame + 1}`;
      scrub.setAttribute("aria-valuetext", text);
      clock.textContent = text;
      speed.value = String(playback.speed);
    });
    this.#listening.signal.addEventListener("abort", stop);
    return row;
  }

  #modes(): HTMLElement {
    const select = make("select", { ariaLabel: "What is shown", title: "What is shown (V)" });
    for (const [value, text] of MODES) select.add(new Option(text, value));
    select.addEventListener("change", () => (this.viewer.mode = select.value as Mode));
    this.#refreshers.push(() => (select.value = this.viewer.mode));
    return select;
  }

  #toggle(one: Switch): HTMLElement {
    const element = button(one.label, `${one.help} (${one.key.toUpperCase()})`, () => this.#flip(one));
    this.#refreshers.push(() => (element.ariaPressed = String(one.get())));
    return element;
  }

  #flip(one: Switch): void {
    one.set(!one.get());
    this.#refresh();
  }

  #refresh(): void {
    this.#root.dataset["theme"] = this.viewer.theme;
    for (const refresh of this.#refreshers) refresh();
  }

  #explain(): void {
    const list = make("dl");
    const rows: [string, string][] = [
      ["Space", "play or pause"], ["← →", "a frame back or on, with Shift ten"], ["Home End", "start, end"],
      ["J K L", "play backward, stop, play forward"], ["- + 0", "slower, faster, as it is"],
      ["V", "next way to show both"], ["G", "original as a ghost"], ["`", "hold: the original"],
      ["1 3 7 5", "front, side, top, perspective"], ["2 4 6 8", "turn the camera"], ["F", "see the figure whole"],
      ...this.#switches.map(({ key, help }): [string, string] => [key.toUpperCase(), help]),
      ["Mouse", "drag turns, right or Shift slides, wheel comes nearer, double click picks a joint"],
    ];
    for (const [key, what] of rows) list.append(make("dt", { textContent: key }), make("dd", { textContent: what }));
    const close = button("Close", "Close", () => this.#help.close());
    this.#help.ariaLabel = "Keys";
    this.#help.append(list, close);
  }

  #listen(target: Document | HTMLElement): void {
    const { signal } = this.#listening;
    target.addEventListener("keydown", (event) => this.#press(event as KeyboardEvent), { signal });
    target.addEventListener("keyup", (event) => this.#release(event as KeyboardEvent), { signal });
  }

  #press(event: KeyboardEvent): void {
    if (event.defaultPrevented || event.ctrlKey || event.metaKey || event.altKey || this.#help.open) return;
    const { target } = event;
    const control = target instanceof HTMLElement ? target.closest("input, select, textarea, button, [role=slider]") : null;
    if (control instanceof HTMLTextAreaElement || (control instanceof HTMLInputElement && control.type !== "range")) return;
    if (event.key === " " && control instanceof HTMLButtonElement) return;
    if (control instanceof HTMLSelectElement) return;
    if (control && /^(Arrow|Home|End|Page)/.test(event.key) && !(control instanceof HTMLButtonElement)) return;
    if (!this.#act(event.key.length === 1 ? event.key.toLowerCase() : event.key, event)) return;
    event.preventDefault();
    this.#refresh();
  }

  /** Do what a key stands for; returns whether it stands for anything. */
  #act(key: string, { shiftKey, repeat }: KeyboardEvent): boolean {
    const { playback, viewer } = this;
    const found = this.#switches.find((one) => one.key === key);
    const view = VIEWS.find((one) => one[1] === key);
    const acts: Record<string, () => void> = {
      " ": () => playback.set({ playing: !playback.playing }),
      ArrowLeft: () => playback.step(shiftKey ? -10 : -1),
      ArrowRight: () => playback.step(shiftKey ? 10 : 1),
      Home: () => playback.set({ time: 0 }),
      End: () => playback.set({ time: playback.duration }),
      j: () => playback.shuttle(-1),
      k: () => playback.shuttle(0),
      l: () => playback.shuttle(1),
      "-": () => this.#pace(-1),
      "+": () => this.#pace(1),
      "=": () => this.#pace(1),
      "0": () => playback.set({ speed: 1 }),
      "4": () => viewer.camera.nudge({ yaw: -TURN }),
      "6": () => viewer.camera.nudge({ yaw: TURN }),
      "8": () => viewer.camera.nudge({ pitch: TURN }),
      "2": () => viewer.camera.nudge({ pitch: -TURN }),
      v: () => (viewer.mode = nextMode(viewer.mode)),
      g: () => (viewer.mode = viewer.mode === "overlay" ? "edited" : "overlay"),
      f: () => viewer.frame(),
      "?": () => this.#help.showModal(),
      "`": () => {
        if (repeat || viewer.mode === "original") return;
        this.#before = viewer.mode;
        viewer.mode = "original";
      },
    };
    if (found) this.#flip(found);
    else if (view) viewer.view(view[0]);
    else if (key in acts) acts[key]();
    else return false;
    return true;
  }

  #release({ key }: KeyboardEvent): void {
    if (key !== "`" || !this.#before) return;
    this.viewer.mode = this.#before;
    this.#before = null;
    this.#refresh();
  }

  #pace(step: -1 | 1): void {
    const { speed } = this.playback;
    const next = step > 0 ? SPEEDS.find((s) => s > speed + 1e-9) : SPEEDS.findLast((s) => s < speed - 1e-9);
    if (next) this.playback.set({ speed: next });
  }

  async #picture(): Promise<void> {
    const link = make("a", { href: URL.createObjectURL(await this.viewer.screenshot()), download: "mien.png" });
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
  }
}

function nextMode(mode: Mode): Mode {
  const at = MODES.findIndex(([value]) => value === mode);
  return MODES[(at + 1) % MODES.length][0];
}

function nameOf({ original, edited }: PlayerOptions): string {
  const shown = edited ?? original;
  const beside = edited && original ? `, with ${original.head.name || "its original"}` : "";
  return `${shown?.head.name || "Motion"} as a moving figure${beside}`;
}

function make<Tag extends keyof HTMLElementTagNameMap>(
  tag: Tag, fields: Partial<HTMLElementTagNameMap[Tag]> = {},
): HTMLElementTagNameMap[Tag] {
  return Object.assign(document.createElement(tag), fields);
}

function button(text: string, title: string, act: () => void): HTMLButtonElement {
  const element = make("button", { type: "button", textContent: text, title });
  element.addEventListener("click", act);
  return element;
}

/** Give the page, or the shadow tree that the host is in, the player's style once. */
function adopt(host: HTMLElement): void {
  const root = host.getRootNode();
  const tree = root instanceof ShadowRoot ? root : document;
  sheet ??= new CSSStyleSheet();
  if (tree.adoptedStyleSheets.includes(sheet)) return;
  sheet.replaceSync(css);
  tree.adoptedStyleSheets.push(sheet);
}

let sheet: CSSStyleSheet | undefined;
