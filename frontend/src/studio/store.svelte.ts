// The one store of the page: what is open, what is done to it, and how it is shown.
import type { ClipInfo, Hello, Layer, ParameterInfo, Project, Stack } from "../messages";
import { Playback } from "../playback";
import { Answers } from "./answers.svelte";
import type { Api } from "./api";
import { asSentence } from "./api";
import { Connection, type Reach } from "./connection";
import * as histories from "./history";
import { Notices } from "./notices.svelte";
import { Keeper, Tabs, keptHere, newer, type Keeping } from "./project";
import { withValue, type Knob } from "./rail";
import * as stacks from "./stack";
import { freshView, isOn, readView, type Toggle, type View } from "./view";
import { Work } from "./work.svelte";

/** Milliseconds in which a second change of the same kind belongs to the first. */
const QUICK = 600;
/** Says in the tab's own storage that the page was loaded before. */
const BEGUN = "mien: begun";

type StackHistory = histories.History<Stack>;

/** Which dialog is open. */
export type Dialog = "" | "export" | "joints" | "keys" | "palette" | "help";

export class Studio {
  readonly playback = new Playback();
  readonly notices = new Notices();
  readonly answers: Answers;
  readonly work: Work;
  hello = $state.raw<Hello | null>(null);
  clips = $state.raw<readonly ClipInfo[]>([]);
  current = $state("");
  selected = $state("");
  view = $state<View>(freshView());
  dialog = $state<Dialog>("");
  /** Whether original and edit go different ways, or at different speeds. */
  parting = $state(false);
  /** The joint that a dialog speaks of, to be marked in the view. */
  pointed = $state("");
  /** While it is held, the original is shown in place of the edit. */
  showsOriginal = $state(false);
  reach = $state<Reach>("there");
  keeping = $state<Keeping>("kept");
  /** Another tab keeps the work; this one only looks until it takes it over. */
  second = $state(false);
  /** How many files are being opened. */
  opening = $state(0);
  #histories = $state.raw<Readonly<Record<string, StackHistory>>>({});
  #history = $derived(this.#histories[this.current] ?? histories.begun(stacks.EMPTY));

  readonly clip = $derived(this.clips.find((clip) => clip.id === this.current));
  readonly stack = $derived(this.#history.present.value);
  readonly layer = $derived(stacks.find(this.stack, this.selected));
  readonly undoLabel = $derived(this.#history.past.length ? this.#history.present.label : "");
  readonly redoLabel = $derived(this.#history.future[0]?.label ?? "");

  readonly #connection: Connection;
  readonly #keeper: Keeper;
  #tabs: Tabs | undefined;
  #lately = { label: "", at: 0 };

  constructor(
    readonly api: Api,
    private readonly shelf: Storage = localStorage,
  ) {
    this.answers = new Answers(
      api,
      (sentence) => this.notices.error(sentence),
      () => this.answers.measure(this.stack, this.view.curves),
    );
    this.work = new Work(() => api.progress(this.answers.client));
    this.#keeper = new Keeper(
      shelf,
      (project, last) => api.keepProject(project, last),
      (state, why) => this.#heard(state, why),
    );
    this.#connection = new Connection(
      () => api.hello(),
      (reach, hello) => void this.#reached(reach, hello),
    );
    api.onLost = () => void this.#connection.lost();
    api.onShut = () => {
      // A page that never was let in says so itself.
      if (this.hello) this.reach = "shut";
    };
  }

  /** Whether there is a clip with a body that can be changed. */
  get canEdit(): boolean {
    return Boolean(this.clip && !this.clip.problem && this.answers.original);
  }

  /** Begin: learn what the server has, and go on where the work was left. */
  async begin(): Promise<void> {
    try {
      this.hello = await this.api.hello();
    } catch (problem) {
      if (this.reach === "there") this.notices.error(asSentence(problem));
      return;
    }
    this.#tabs = new Tabs(
      () => this.#becomeSecond(),
      () => void this.#inherit(),
    );
    if (!(await this.#tabs.begin())) this.#becomeSecond();
    this.clips = this.hello.clips;
    const there = await this.api.project().catch(() => null);
    await this.take(newer(there, keptHere(this.shelf)), { begin: true, named: this.#named() });
  }

  /** Take over a project: the stacks of the clips that are open, the view, and what was shown. */
  async take(project: Project | null, { begin = false, named = "" } = {}): Promise<void> {
    const given = project?.clips ?? [];
    const known = Object.fromEntries(given.map((clip) => [clip.id, histories.begun(clip.stack)]));
    this.#histories = begin ? known : { ...this.#histories, ...known };
    if (project) this.view = readView(project.view);
    const open = (id: string | undefined) => this.clips.some((clip) => clip.id === id);
    const wanted = named || (open(project?.current) ? project!.current : this.clips[0]?.id);
    await this.select(wanted ?? "");
  }

  /** The clip that was named on the command line, the first time that this tab loads the page. */
  #named(): string {
    const tab = globalThis.sessionStorage as Storage | undefined;
    if (tab?.getItem(BEGUN)) return "";
    tab?.setItem(BEGUN, "yes");
    return this.hello?.given[0] ?? "";
  }

  /** Show a clip. */
  async select(id: string): Promise<void> {
    this.current = id;
    this.selected = this.stack.layers.at(-1)?.id ?? "";
    this.playback.set({ playing: false, time: 0, range: null, ...(id ? {} : { duration: 0 }) });
    try {
      await this.answers.show(id);
    } catch (problem) {
      if (this.reach === "there") this.notices.error(asSentence(problem));
      return;
    }
    if (this.current !== id || !id) return;
    this.#skipStill();
    const calm = matchMedia("(prefers-reduced-motion: reduce)").matches;
    this.playback.set({ playing: !calm });
    this.answers.edit(this.stack, false);
    this.keep();
  }

  /** Let playing begin after a still, such as a T-pose: loops would jump at it. */
  #skipStill(): void {
    const head = this.answers.original?.head;
    if (!head?.still) return;
    const { frame_time: frameTime, still } = head;
    const duration = (head.frames - 1) * frameTime;
    const time = still * frameTime;
    this.playback.set({ duration, frameTime, time, range: [time, duration], loop: "range" });
  }

  /**
   * Change the stack; `label` is what undo calls it. While a hand is still moving (`done` false) changes of
   * the same label are one step of undo, and answers are quick ones; when it is done, careful ones.
   */
  change(label: string, to: (stack: Stack) => Stack, done = true): void {
    if (!this.current) return;
    const moving = this.#history.gesture === label;
    const next = to(this.stack);
    if (!moving && JSON.stringify(next) === JSON.stringify(this.stack)) return;
    // Arrow keys that are held or tapped quickly are one movement too.
    const now = performance.now();
    const again = done && !moving && this.#goesOn(label, next, now);
    const before = again ? { ...this.#history, gesture: label } : this.#history;
    const changed = histories.changed(before, next, label, done && !moving && !again ? "" : label);
    this.#put(done ? histories.settled(changed) : changed);
    this.#lately = { label, at: now };
    if (!stacks.find(next, this.selected)) this.selected = next.layers.at(-1)?.id ?? "";
    this.answers.edit(next, !done);
    if (done) this.keep();
  }

  /** Change a layer. */
  changeLayer(label: string, id: string, fields: Partial<Omit<Layer, "id">>, done = true): void {
    this.change(label, (stack) => stacks.change(stack, id, fields), done);
  }

  /** Make the clip a mood: the one it has changes, or it gets one. */
  setMood(mood: Pick<Layer, "kind" | "name" | "parameters">, done = true): void {
    const label = mood.kind === "place" ? "place on the disc" : stacks.moodName(mood.name);
    const { stack, id } = stacks.setMood(this.stack, this.selected, mood);
    this.change(label, () => stack, done);
    this.selected = id;
  }

  /** Set parameters of an edit by its own sliders, which bring its layer with them. */
  setEdit(edit: string, parameters: Layer["parameters"], done = true): void {
    const names = Object.keys(parameters).join(", ");
    const label = `${edit} ${names}`.replaceAll("_", " ");
    const { stack, id } = stacks.setEdit(this.stack, this.selected, edit, parameters);
    this.change(label, () => stack, done);
    this.selected = id;
  }

  /** Someone is about to move a strength: a layer's, or without one the whole's. */
  prepareStrength(layer = ""): void {
    this.#prepare(this.stack, { layer, name: "", low: 0, high: 2 });
  }

  /** Someone is about to move a parameter of an edit, whose layer may have to come first. */
  prepareEdit(edit: string, info: ParameterInfo): void {
    const { stack, id } = stacks.setEdit(this.stack, this.selected, edit, {});
    this.prepareParameter(id, info, stack);
  }

  /** Someone is about to move a parameter of a layer. */
  prepareParameter(layer: string, info: ParameterInfo, stack = this.stack): void {
    const { name, kind, low, high, neutral } = info;
    // Only amounts can be blended: halfway between two frequencies is not the one between them.
    if (kind !== "number" || low === null || high === null || neutral === null) return;
    const now = stacks.valueOf(stacks.find(stack, layer), info);
    const knob = { layer, name, low, high };
    if (typeof now === "number") this.#prepare(withValue(stack, knob, now), knob);
  }

  #prepare(stack: Stack, knob: Knob): void {
    if (this.canEdit) this.answers.wantRail(stack, knob);
  }

  addLayer(kind: Layer["kind"], name: string, parameters: Layer["parameters"] = {}): void {
    const layer = stacks.layerFor(this.stack, kind, name, parameters);
    this.change(`add ${stacks.title(layer).toLowerCase()}`, (stack) => stacks.add(stack, layer));
    this.selected = layer.id;
  }

  /** Remove a layer; the one that takes its place is selected. */
  removeLayer(id: string): void {
    const at = this.stack.layers.findIndex((layer) => layer.id === id);
    if (at < 0) return;
    this.change(`delete ${stacks.title(this.stack.layers[at]!).toLowerCase()}`, (stack) =>
      stacks.remove(stack, id),
    );
    this.selected = (this.stack.layers[at] ?? this.stack.layers.at(-1))?.id ?? "";
  }

  undo(): void {
    this.#goTo(histories.undone(this.#history));
  }

  redo(): void {
    this.#goTo(histories.redone(this.#history));
  }

  /** Change how things are shown. */
  show(fields: Partial<View>): void {
    Object.assign(this.view, fields);
    if (fields.curves) this.answers.draw(this.stack, this.view.curves);
    this.keep();
  }

  isOn(toggle: Toggle): boolean {
    return isOn(this.view, toggle, this.parting);
  }

  toggle(toggle: Toggle): void {
    this.show({ [toggle]: !this.isOn(toggle) });
  }

  /** Show the curve of a joint, in place of that of another; null takes it away. */
  pick(joint: string | null): void {
    const others = this.view.curves.filter((name) => !name.startsWith("joint:"));
    this.show({ curves: joint ? [...others, `joint:${joint}`] : others });
  }

  /** All that is worth keeping. */
  project(): Project {
    const clips = this.clips.map(({ id, name, roles }) => ({
      id,
      name,
      stack: this.#histories[id]?.present.value ?? stacks.EMPTY,
      roles,
    }));
    const view = { ...$state.snapshot(this.view), saved: Date.now() };
    return { clips, current: this.current, view, mien_project: 1 };
  }

  /** How many layers a clip has, for lists. */
  layersOf(id: string): number {
    return this.#histories[id]?.present.value.layers.length ?? 0;
  }

  /** Say which joint of the clip plays which role; none, and they are as found. Throws what is wrong with it. */
  async nameJoints(roles: ClipInfo["roles"]): Promise<void> {
    const named = await this.api.nameJoints(this.current, roles);
    this.clips = this.clips.map((clip) => (clip.id === named.id ? named : clip));
    if (this.current === named.id) await this.select(named.id);
  }

  /** Close a dialog, unless another one is open by now. */
  closeDialog(dialog: Dialog): void {
    if (this.dialog === dialog) this.dialog = "";
  }

  keep(): void {
    if (!this.second) this.#keeper.keep(this.project());
  }

  /** The page goes away. */
  leave(): void {
    this.#keeper.flush();
    this.#tabs?.leave();
  }

  /** Go on in this tab; the other one only looks from now on. */
  async takeOver(): Promise<void> {
    await this.#tabs?.take();
    this.second = this.#keeper.paused = false;
    this.keep();
  }

  #becomeSecond(): void {
    this.second = this.#keeper.paused = true;
  }

  /** The tab that kept the work was closed: go on with what it kept; undo brings back what was done here. */
  async #inherit(): Promise<void> {
    const [clips, there] = await Promise.all([this.api.clips(), this.api.project()]).catch(() => []);
    const kept = newer(there ?? null, keptHere(this.shelf));
    const before = this.#histories;
    if (clips) this.clips = clips;
    await this.take(kept);
    const stepped = (kept?.clips ?? []).map(({ id, stack }) => {
      const history = before[id] ?? histories.begun(stacks.EMPTY);
      const same = JSON.stringify(history.present.value) === JSON.stringify(stack);
      return [id, same ? history : histories.changed(history, stack, "what the other tab did", "")];
    });
    this.#histories = { ...this.#histories, ...Object.fromEntries(stepped) };
    if (!this.#tabs?.mine) return;
    this.second = this.#keeper.paused = false;
    this.notices.done("The other tab was closed: this one goes on with its work, and keeps it.");
  }

  /** Whether a change follows so soon on one of the same kind that both are one step. */
  #goesOn(label: string, next: Stack, now: number): boolean {
    const { past, present } = this.#history;
    const same = present.label === label && this.#lately.label === label && past.length > 0;
    return same && now - this.#lately.at < QUICK && next.layers.length === this.stack.layers.length;
  }

  #goTo(history: StackHistory): void {
    if (history === this.#history) return;
    const before = this.stack.layers;
    this.#put(history);
    this.#lately = { label: "", at: 0 };
    // What came back or changed is what is looked at next.
    const changed = this.stack.layers.find((layer) => !before.includes(layer));
    if (changed) this.selected = changed.id;
    else if (!stacks.find(this.stack, this.selected)) this.selected = this.stack.layers.at(-1)?.id ?? "";
    this.answers.edit(this.stack, false);
    this.keep();
  }

  #put(history: StackHistory): void {
    this.#histories = { ...this.#histories, [this.current]: history };
  }

  #heard(state: Keeping, why: string): void {
    if (state === "failed" && this.keeping !== "failed") this.notices.error(`Not kept: ${why}.`);
    this.keeping = state;
  }

  async #reached(reach: Reach, hello: Hello | null): Promise<void> {
    this.reach = reach;
    if (!hello) return;
    this.hello = hello;
    const missing = this.current && !hello.clips.some((clip) => clip.id === this.current);
    this.clips = hello.clips;
    this.#keeper.again();
    if (missing) {
      const [first] = hello.clips;
      this.notices.error("The clip is not open in mien any more: open its file again, its layers are kept.");
      return this.select(first?.id ?? "");
    }
    if (!this.answers.original) return this.select(this.current);
    this.answers.edit(this.stack, false);
  }
}
