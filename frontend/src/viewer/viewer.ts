// The 3D view of one or two motions: the original, the edited one, or both over each other, beside each other, or
// with a line between them. Draws when something changed, and while the playback, which it drives, is playing.
import { Mesh, MeshBasicMaterial, SphereGeometry, Vector3, WebGLRenderer } from "three";
import type { PoseSource } from "../motion/blend";
import type { Vector } from "../motion/vectors";
import { clamp, Playback } from "../playback";
import { Actor, type Trails } from "./actor";
import { OrbitCamera, type View } from "./camera";
import { Overlay } from "./overlay";
import { plainPalette } from "./solids";
import { Stage, type Theme } from "./stage";

export type { Theme, Trails, View };
export type Mode = "original" | "edited" | "overlay" | "side" | "wipe";
/** How two motions that take differently long go together: by seconds, or by the share of each. */
export type Timing = "time" | "phase";

export interface ViewerOptions {
  quality?: "high" | "low";
  theme?: Theme;
  /** One colour for the whole figure, for those who judge it. */
  neutral?: boolean;
  /** The clock that is shown; the viewer makes one where none is given, and drives it either way. */
  playback?: Playback;
  /** Called with the name of the joint under the pointer, or null. */
  onHover?: (joint: string | null) => void;
  /** Called with the name of the joint that was double-clicked, or null beside the figure. */
  onPick?: (joint: string | null) => void;
}

/** A stretch of seconds of the edited motion in which parts are tinted red; no parts is the whole body. */
export interface Mark {
  start: number;
  end: number;
  parts: readonly string[];
}

export interface Stats {
  /** Pictures a second while playing. */
  fps: number;
  /** Milliseconds that the last picture took of the page's time. */
  ms: number;
  /** What draws: the graphics card, or the name of a program that stands in for one. */
  renderer: string;
}

const PLAIN: Vector = [190, 192, 196];
const REACH = 16; // pixels from a joint that still mean it
const PAUSE = 0.25; // seconds: longer gaps between pictures are no time that passed

/** Part of the picture: who is in it, and where, as shares of the width. */
interface Pane {
  actors: readonly Actor[];
  lead: Actor;
  view: readonly [number, number];
  cut: readonly [number, number];
}

export class Viewer {
  readonly playback: Playback;
  readonly canvas: HTMLCanvasElement;
  readonly camera: OrbitCamera;
  #host: HTMLElement;
  #options: ViewerOptions;
  #renderer: WebGLRenderer;
  #stage: Stage;
  #overlay: Overlay;
  #marker = new Mesh(new SphereGeometry(1, 16, 12), new MeshBasicMaterial({ depthTest: false, transparent: true }));
  #original: Actor | null = null;
  #edited: Actor | null = null;
  #mode: Mode = "edited";
  #timing: Timing = "time";
  #treadmill = false;
  #follow = true;
  #names = false;
  #grid = true;
  #footprints = false;
  #trails: Trails = { hands: false, feet: false, head: false };
  #neutral: boolean;
  #theme: Theme;
  #wipe = 0.5;
  #marks: readonly Mark[] = [];
  #hovered: number | null = null;
  #selected: string | null = null;
  #request = 0;
  #last = 0;
  #pace = { pictures: 0, since: 0, fps: 0, ms: 0 };
  #stops: (() => void)[] = [];
  #lost = false;
  #drawnBy: string | null = null;
  #disposed = false;

  constructor(host: HTMLElement, options: ViewerOptions = {}) {
    this.#host = host;
    this.#options = options;
    this.#theme = options.theme ?? "light";
    this.#neutral = options.neutral ?? false;
    this.playback = options.playback ?? new Playback();
    const high = options.quality !== "low";
    this.#renderer = new WebGLRenderer({ antialias: high, powerPreference: "high-performance" });
    this.#renderer.setPixelRatio(high ? Math.min(devicePixelRatio, 2) : 1);
    this.#renderer.shadowMap.enabled = high;
    this.canvas = this.#renderer.domElement;
    Object.assign(this.canvas.style, { display: "block", position: "absolute", inset: "0" });
    if (getComputedStyle(host).position === "static") host.style.position = "relative";
    host.append(this.canvas);
    this.#stage = new Stage(this.#theme, high);
    this.#marker.renderOrder = 5;
    this.#stage.scene.add(this.#marker);
    this.#overlay = new Overlay(host, (share) => (this.wipe = share));
    this.#overlay.theme = this.#theme;
    this.camera = new OrbitCamera(this.canvas, () => this.invalidate());
    this.camera.smooth = !matchMedia("(prefers-reduced-motion: reduce)").matches;
    this.#listen();
    this.resize();
    hook(this);
  }

  // ---- what is shown

  setOriginal(source: PoseSource | null): void {
    const other = source?.head.clip !== this.#original?.source.head.clip;
    this.#original = this.#cast(this.#original, source);
    this.#recast(other);
  }

  setEdited(source: PoseSource | null): void {
    const first = !this.#original && !this.#edited;
    this.#edited = this.#cast(this.#edited, source);
    this.#recast(first);
  }

  get mode(): Mode {
    return this.#mode;
  }

  set mode(mode: Mode) {
    this.#mode = mode;
    this.#changed();
    this.#leave();
  }

  get timing(): Timing {
    return this.#timing;
  }

  set timing(timing: Timing) {
    this.#timing = timing;
    this.#changed();
  }

  /** Keep figures in place while the floor slides below them. */
  get treadmill(): boolean {
    return this.#treadmill;
  }

  set treadmill(on: boolean) {
    this.#treadmill = on;
    this.invalidate();
  }

  /** How far on the floor the two figures get from each other, in metres. */
  get drift(): number {
    const [original, edited] = [this.#original, this.#edited];
    if (!original || !edited) return 0;
    const { duration } = this.playback;
    const away = Array.from({ length: 25 }, (_, i) => {
      const [[ax, az], [bx, bz]] = [original, edited].map((actor) => actor.groundAt(this.#at(actor, (i / 24) * duration)));
      return Math.hypot(ax - bx, az - bz);
    });
    return Math.max(...away);
  }

  /** Let the camera go with the figure. */
  get follow(): boolean {
    return this.#follow;
  }

  set follow(on: boolean) {
    this.#follow = on;
    this.invalidate();
  }

  get trails(): Trails {
    return this.#trails;
  }

  set trails(trails: Trails) {
    this.#trails = { ...trails };
    this.#leave();
  }

  get footprints(): boolean {
    return this.#footprints;
  }

  set footprints(on: boolean) {
    this.#footprints = on;
    this.#leave();
  }

  /** Names beside the joints. */
  get names(): boolean {
    return this.#names;
  }

  set names(on: boolean) {
    this.#names = on;
    this.invalidate();
  }

  get grid(): boolean {
    return this.#grid;
  }

  set grid(on: boolean) {
    this.#grid = on;
    this.#stage.grid = on;
    this.invalidate();
  }

  get theme(): Theme {
    return this.#theme;
  }

  set theme(theme: Theme) {
    this.#theme = theme;
    this.#stage.theme = theme;
    this.#overlay.theme = theme;
    this.invalidate();
  }

  get neutral(): boolean {
    return this.#neutral;
  }

  set neutral(on: boolean) {
    this.#neutral = on;
    for (const actor of this.#actors()) actor.palette = this.#palette();
    this.invalidate();
  }

  /** Share of the width that shows the original in mode "wipe". */
  get wipe(): number {
    return this.#wipe;
  }

  set wipe(share: number) {
    this.#wipe = clamp(share, 0, 1);
    this.invalidate();
  }

  /** Tint parts of the edited figure red while these stretches of its time are shown. */
  setMarks(marks: readonly Mark[]): void {
    this.#marks = marks;
    this.invalidate();
  }

  /** The joint that is marked as chosen, by name. */
  get selected(): string | null {
    return this.#selected;
  }

  set selected(joint: string | null) {
    this.#selected = joint;
    this.invalidate();
  }

  // ---- camera

  /** See the figure whole; without following, all of its way. */
  frame({ jump = false } = {}): void {
    const lead = this.#lead();
    if (!lead) return;
    const { low, high } = lead.travel;
    const tall = Math.max(high[1], 0.3);
    const still = this.#follow || this.#treadmill;
    this.#settle(lead);
    const { anchor } = this.camera;
    const middle = still ? new Vector3(anchor.x, 0, anchor.z) : new Vector3((low[0] + high[0]) / 2, 0, (low[2] + high[2]) / 2);
    middle.y = tall / 2;
    const way = still ? 0 : Math.hypot(high[0] - low[0], high[2] - low[2]);
    this.#aspect(this.#panes().length > 1 && this.#mode === "side" ? 0.5 : 1);
    this.camera.frame(Math.max(tall, way), Math.max(0.8 * tall, way), middle, { jump });
    this.invalidate();
  }

  view(name: View): void {
    this.camera.view(name);
  }

  // ---- pictures

  /** Ask for a new picture. */
  invalidate(): void {
    if (!this.#request && !this.#disposed && !this.#lost) this.#request = requestAnimationFrame((now) => this.#tick(now));
  }

  /** Draw now. */
  draw(): void {
    if (this.#disposed || this.#lost) return;
    const start = performance.now();
    for (const actor of this.#actors()) actor.seek(this.#secondsOf(actor));
    const panes = this.#panes();
    const width = this.#host.clientWidth;
    const height = this.#host.clientHeight;
    this.#mark();
    for (const actor of this.#actors()) {
      actor.ghost = this.#mode === "overlay" && actor === this.#original && this.#edited !== null;
      const [x, z] = this.#treadmill ? actor.ground : [0, 0];
      actor.position.set(-x, 0, -z);
    }
    this.#renderer.setScissorTest(panes.length > 1);
    for (const pane of panes) {
      this.#settle(pane.lead);
      for (const actor of this.#actors()) actor.visible = pane.actors.includes(actor);
      this.#point(pane.lead);
      const [from, to] = pane.view;
      this.#renderer.setViewport(from * width, 0, (to - from) * width, height);
      this.#renderer.setScissor(pane.cut[0] * width, 0, (pane.cut[1] - pane.cut[0]) * width, height);
      this.#aspect(to - from);
      this.#renderer.render(this.#stage.scene, this.camera.apply());
    }
    if (!panes.length) {
      this.#marker.visible = false;
      this.#renderer.render(this.#stage.scene, this.camera.apply());
    }
    this.#write(panes, width, height);
    this.#pace.ms = performance.now() - start;
  }

  /** The picture as PNG, without what is written on it. */
  screenshot(): Promise<Blob> {
    this.draw();
    return new Promise((resolve, reject) => {
      this.canvas.toBlob((blob) => (blob ? resolve(blob) : reject(new Error("the picture could not be made"))), "image/png");
    });
  }

  get stats(): Stats {
    const { fps, ms } = this.#pace;
    // Asked once: the answer waits for all that is being drawn.
    this.#drawnBy ??= rendererName(this.#renderer);
    return { fps, ms, renderer: this.#drawnBy };
  }

  /** Places of the leading figure's joints in pixels of the canvas, by name. */
  jointsOnScreen(): Record<string, readonly [number, number]> {
    const pane = this.#panes().at(-1);
    if (!pane) return {};
    this.draw();
    return Object.fromEntries(this.#projected(pane).map(({ name, x, y }) => [name, [x, y] as const]));
  }

  /** How many colours the picture has: one or two where nothing was drawn. */
  colours(): number {
    this.draw();
    const gl = this.#renderer.getContext();
    const { drawingBufferWidth: width, drawingBufferHeight: height } = gl;
    const pixels = new Uint8Array(4 * width * height);
    gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
    return new Set(new Uint32Array(pixels.buffer)).size;
  }

  /** Take the size of the host. */
  resize(): void {
    const { clientWidth: width, clientHeight: height } = this.#host;
    if (!width || !height) return;
    this.#renderer.setSize(width, height);
    if (!this.playback.playing) this.draw();
    this.invalidate();
  }

  /** Give everything back, the graphics card's memory too. */
  dispose(): void {
    if (this.#disposed) return;
    this.#disposed = true;
    cancelAnimationFrame(this.#request);
    for (const stop of this.#stops) stop();
    for (const actor of this.#actors()) actor.dispose();
    this.camera.dispose();
    this.#stage.dispose();
    this.#overlay.dispose();
    this.#marker.geometry.dispose();
    this.#marker.material.dispose();
    this.#renderer.dispose();
    this.#renderer.forceContextLoss();
    this.canvas.remove();
  }

  // ---- inside

  #cast(actor: Actor | null, source: PoseSource | null): Actor | null {
    if (!source) {
      actor?.dispose();
      return null;
    }
    if (actor) {
      actor.play(source);
      return actor;
    }
    const palette = this.#palette();
    const made = new Actor(source, { quality: this.#options.quality ?? "high", ...(palette ? { palette } : {}) });
    this.#stage.scene.add(made);
    return made;
  }

  /** All figures there are. */
  #actors(): readonly Actor[] {
    return [this.#original, this.#edited].filter((actor) => actor !== null);
  }

  #palette(): readonly Vector[] | undefined {
    return this.#neutral ? plainPalette(PLAIN) : undefined;
  }

  #recast(reframe: boolean): void {
    this.#changed();
    this.#leave();
    this.#hovered = null;
    const lead = this.#lead();
    if (!reframe || !lead) return;
    lead.seek(this.#secondsOf(lead));
    this.camera.facing = lead.travel.facing;
    const { smooth } = this.camera;
    this.camera.smooth = false;
    this.camera.view("perspective");
    this.frame({ jump: true });
    this.camera.smooth = smooth;
  }

  /** The figure that is looked at. */
  #lead(): Actor | null {
    return this.#mode === "original" ? (this.#original ?? this.#edited) : (this.#edited ?? this.#original);
  }

  #panes(): readonly Pane[] {
    const lead = this.#lead();
    const [original, edited] = [this.#original, this.#edited];
    if (!lead) return [];
    const whole = [0, 1] as const;
    if (!original || !edited || this.#mode === "original" || this.#mode === "edited") {
      return [{ actors: [lead], lead, view: whole, cut: whole }];
    }
    if (this.#mode === "overlay") return [{ actors: [original, edited], lead, view: whole, cut: whole }];
    if (this.#mode === "side") {
      const [left, right] = [[0, 0.5] as const, [0.5, 1] as const];
      return [
        { actors: [original], lead: original, view: left, cut: left },
        { actors: [edited], lead: edited, view: right, cut: right },
      ];
    }
    return [
      { actors: [original], lead: edited, view: whole, cut: [0, this.#wipe] },
      { actors: [edited], lead: edited, view: whole, cut: [this.#wipe, 1] },
    ];
  }

  #secondsOf(actor: Actor): number {
    return this.#at(actor, this.playback.time);
  }

  /** Seconds of a figure's own motion at a time of the playback. */
  #at(actor: Actor, time: number): number {
    const { duration } = this.playback;
    return this.#timing === "phase" && duration > 0 ? (time / duration) * actor.source.duration : time;
  }

  /** The playback lasts as long as what is seen. */
  #changed(): void {
    const lead = this.#lead();
    if (lead) {
      // The original may be looked at for a moment: that must not move the time.
      const seen = this.#timing === "phase" || this.#mode === "edited" ? [this.#edited ?? lead] : this.#actors();
      const duration = Math.max(...seen.map((actor) => actor.source.duration));
      const { frameTime } = (this.#edited ?? lead).source;
      if (duration !== this.playback.duration || frameTime !== this.playback.frameTime) {
        this.playback.set({ duration, frameTime });
      }
    }
    this.invalidate();
  }

  #leave(): void {
    for (const actor of this.#actors()) {
      const behind = this.#mode === "overlay" && actor === this.#original && this.#edited;
      actor.leave(behind ? { hands: false, feet: false, head: false } : this.#trails, this.#footprints && !behind);
    }
    this.invalidate();
  }

  /** Put the camera's anchor, the light and the floor where a figure is. */
  #settle(actor: Actor): void {
    const [x, z] = actor.ground;
    if (this.#treadmill) this.camera.anchor.set(0, 0, 0);
    else if (this.#follow) this.camera.anchor.set(x, 0, z);
    this.#stage.slide(this.#treadmill ? x : 0, this.#treadmill ? z : 0);
    this.#stage.lookAt(this.#treadmill ? 0 : x, this.#treadmill ? 0 : z);
    this.#stage.distance = this.camera.distance;
  }

  #aspect(share: number): void {
    this.camera.camera.aspect = (share * this.#host.clientWidth) / Math.max(this.#host.clientHeight, 1);
  }

  #mark(): void {
    const seconds = this.#edited?.seconds ?? 0;
    const now = this.#marks.filter(({ start, end }) => seconds >= start - 1e-6 && seconds <= end + 1e-6);
    this.#edited?.mark(now.flatMap(({ parts }) => (parts.length ? parts : ["all"])));
  }

  /** Show which joint is under the pointer, or else which is chosen. */
  #point(actor: Actor): void {
    const { joints } = actor.source.head;
    const chosen = this.#selected === null ? -1 : joints.indexOf(this.#selected);
    const joint = this.#hovered ?? chosen;
    this.#marker.visible = joint >= 0 && joint < joints.length;
    if (!this.#marker.visible) return;
    this.#marker.position.copy(actor.joint(joint));
    this.#marker.scale.setScalar(0.0055 * this.camera.distance);
    this.#marker.material.color.set(joint === chosen ? "#ffcf33" : "#ffffff");
  }

  /** Where the drawn joints of a part of the picture are, in pixels of the canvas. */
  #projected({ lead, view: [from, to] }: Pane): { joint: number; name: string; x: number; y: number; z: number }[] {
    const { clientWidth: width, clientHeight: height } = this.#host;
    const { head } = lead.source;
    const roles = new Set(Object.values(head.shape?.roles ?? {}));
    const all = head.drawn.map((joint) => {
      const { x, y, z } = lead.joint(joint).project(this.camera.camera);
      const across = from + ((x + 1) / 2) * (to - from);
      return { joint, name: head.joints[joint], x: across * width, y: ((1 - y) / 2) * height, z };
    });
    // What people look for before twists and fingers, and of those what is nearest to the camera.
    return all.sort((a, b) => Number(roles.has(b.joint)) - Number(roles.has(a.joint)) || a.z - b.z);
  }

  #write(panes: readonly Pane[], width: number, height: number): void {
    const two = panes.length > 1;
    this.#overlay.name(two ? "original" : "", two ? "edited" : "", this.#mode === "wipe" ? this.#wipe : 0.5);
    this.#overlay.wipe(two && this.#mode === "wipe" ? this.#wipe : null);
    const slope = Math.tan((this.camera.camera.fov * Math.PI) / 360);
    this.#overlay.scale(height / (2 * slope * this.camera.distance));
    const pane = panes.at(-1);
    const all = pane && (this.#names || this.#marker.visible) ? this.#projected(pane) : [];
    const chosen = all.filter(({ joint, name }) => joint === this.#hovered || name === this.#selected);
    const names = (this.#names ? all : chosen).filter(({ x, y }) => x >= 0 && y >= 0 && x <= width && y <= height);
    this.#overlay.names(names.map(({ name, x, y, joint }) => ({
      text: name, x, y, strong: joint === this.#hovered || name === this.#selected,
    })));
  }

  #tick(now: number): void {
    this.#request = 0;
    const seconds = this.#last ? Math.min((now - this.#last) / 1000, PAUSE) : 0;
    this.#last = now;
    const going = this.camera.tick(seconds);
    this.playback.advance(seconds);
    this.draw();
    this.#count(now);
    if (this.playback.playing || going || this.camera.busy) this.invalidate();
    else this.#last = 0;
  }

  #count(now: number): void {
    const pace = this.#pace;
    pace.pictures++;
    if (now - pace.since < 1000) return;
    if (now - pace.since < 1500) pace.fps = (1000 * pace.pictures) / (now - pace.since);
    pace.pictures = 0;
    pace.since = now;
  }

  #listen(): void {
    const stop = new AbortController();
    const { signal } = stop;
    const sized = new ResizeObserver(() => this.resize());
    sized.observe(this.#host);
    this.#stops.push(() => stop.abort(), () => sized.disconnect());
    this.#stops.push(this.playback.subscribe(() => this.invalidate()));
    this.canvas.addEventListener("webglcontextlost", (event) => this.#lose(event), { signal });
    this.canvas.addEventListener("webglcontextrestored", () => this.#regain(), { signal });
    this.canvas.addEventListener("pointermove", (event) => this.#hover(event), { signal });
    this.canvas.addEventListener("pointerleave", () => this.#hoverOn(null), { signal });
    this.canvas.addEventListener("dblclick", (event) => {
      const joint = this.#under(event);
      this.selected = joint === null ? null : (this.#lead()?.source.head.joints[joint] ?? null);
      this.#options.onPick?.(this.selected);
    }, { signal });
  }

  #lose(event: Event): void {
    event.preventDefault();
    this.#lost = true;
    this.#overlay.say("The graphics card was taken away; the picture comes back when it does.");
  }

  #regain(): void {
    this.#lost = false;
    this.#overlay.say("");
    this.invalidate();
  }

  #hover(event: PointerEvent): void {
    if (!this.camera.busy) this.#hoverOn(this.#under(event));
  }

  #hoverOn(joint: number | null): void {
    if (joint === this.#hovered) return;
    this.#hovered = joint;
    this.canvas.style.cursor = joint === null ? "" : "pointer";
    this.#options.onHover?.(joint === null ? null : (this.#lead()?.source.head.joints[joint] ?? null));
    this.invalidate();
  }

  /** The joint next to the pointer, where one is near. */
  #under(event: MouseEvent): number | null {
    const box = this.canvas.getBoundingClientRect();
    const [px, py] = [event.clientX - box.left, event.clientY - box.top];
    const pane = this.#panes().find(({ cut }) => px / box.width <= cut[1]);
    if (!pane) return null;
    this.#settle(pane.lead);
    this.#aspect(pane.view[1] - pane.view[0]);
    this.camera.apply();
    let best: number | null = null;
    let least = REACH;
    for (const { joint, x, y } of this.#projected(pane)) {
      const away = Math.hypot(x - px, y - py);
      if (away < least) [best, least] = [joint, away];
    }
    return best;
  }
}

function rendererName(renderer: WebGLRenderer): string {
  const gl = renderer.getContext();
  const more = gl.getExtension("WEBGL_debug_renderer_info");
  return String(gl.getParameter(more ? more.UNMASKED_RENDERER_WEBGL : gl.RENDERER));
}

/** Let tests look inside: the last viewer that was made. */
function hook(viewer: Viewer): void {
  (window as unknown as { __viewer: Viewer }).__viewer = viewer;
}
