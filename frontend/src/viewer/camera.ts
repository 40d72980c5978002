// The camera: turns about a point, slides, comes nearer to the cursor, and goes with what it follows.
import { MathUtils, PerspectiveCamera, Plane, Raycaster, Vector2, Vector3 } from "three";
import { clamp } from "../playback";

export type View = "front" | "side" | "top" | "back" | "perspective";

/** Turned from the front to the body's right, and raised; degrees, as mien's pictures have it. */
const VIEWS: Record<View, readonly [number, number]> = {
  front: [0, 3], side: [90, 3], top: [0, 89.9], back: [180, 3], perspective: [40, 12],
};
const FIELD = 28; // degrees from top to bottom
const NEAREST = 0.4; // metres
const FURTHEST = 60;
const MOVE = 0.28; // seconds to go to a named view
const TURN = 0.0055; // radians a pixel

interface Place {
  yaw: number;
  pitch: number;
  distance: number;
  pan: Vector3;
}

/** Looks at `anchor + pan`. What moves the anchor is followed; what is dragged changes the rest. */
export class OrbitCamera {
  readonly camera = new PerspectiveCamera(FIELD, 1, 0.05, 200);
  readonly anchor = new Vector3();
  /** Where the front of the figure is: an angle about up from Z to X. */
  facing = 0;
  smooth = true;
  #place: Place = { yaw: 0, pitch: 0.2, distance: 5, pan: new Vector3(0, 0.9, 0) };
  #move: { from: Place; to: Place; share: number } | null = null;
  #element: HTMLElement;
  #changed: () => void;
  #pointers = new Map<number, { x: number; y: number }>();
  #how: "turn" | "slide" | "zoom" = "turn";
  #listening = new AbortController();

  constructor(element: HTMLElement, changed: () => void) {
    this.#element = element;
    this.#changed = changed;
    element.style.touchAction = "none";
    const signal = this.#listening.signal;
    element.addEventListener("pointerdown", (event) => this.#down(event), { signal });
    element.addEventListener("pointermove", (event) => this.#drag(event), { signal });
    for (const end of ["pointerup", "pointercancel", "lostpointercapture"] as const) {
      element.addEventListener(end, (event) => void this.#pointers.delete(event.pointerId), { signal });
    }
    element.addEventListener("wheel", (event) => this.#wheel(event), { signal, passive: false });
    element.addEventListener("contextmenu", (event) => event.preventDefault(), { signal });
  }

  /** Whether a drag is going on. */
  get busy(): boolean {
    return this.#pointers.size > 0;
  }

  get distance(): number {
    return this.#place.distance;
  }

  /** The point looked at. */
  get target(): Vector3 {
    return this.anchor.clone().add(this.#place.pan);
  }

  /** Look from a named side. */
  view(name: View): void {
    const [turn, rise] = VIEWS[name];
    this.#goTo({ yaw: this.facing - MathUtils.degToRad(turn), pitch: MathUtils.degToRad(rise) });
  }

  /** Come as near as lets a box of this size, standing on the floor around the anchor, be seen whole. */
  frame(height: number, width: number, middle: Vector3, { jump = false } = {}): void {
    const slope = Math.tan(MathUtils.degToRad(FIELD / 2));
    const distance = Math.max(height / 2 / slope, width / 2 / (slope * this.camera.aspect)) * 1.2 + Math.min(width, 1.6) / 4;
    this.#goTo({ distance: clamp(distance, NEAREST, FURTHEST), pan: middle.clone().sub(this.anchor) }, jump);
  }

  /** What to keep of the camera, for a project or a link. */
  get state(): number[] {
    const { yaw, pitch, distance, pan } = this.#place;
    return [yaw, pitch, distance, ...pan.toArray()];
  }

  set state([yaw, pitch, distance, x, y, z]: readonly number[]) {
    this.#move = null;
    this.#place = { yaw, pitch, distance, pan: new Vector3(x, y, z) };
    this.#changed();
  }

  /** Let seconds pass; returns whether the camera is on its way. */
  tick(seconds: number): boolean {
    if (!this.#move) return false;
    const { from, to } = this.#move;
    this.#move.share = Math.min(this.#move.share + seconds / MOVE, 1);
    const share = MathUtils.smoothstep(this.#move.share, 0, 1);
    const mixed = (key: "yaw" | "pitch" | "distance"): number => MathUtils.lerp(from[key], to[key], share);
    this.#place = {
      yaw: mixed("yaw"), pitch: mixed("pitch"), distance: mixed("distance"), pan: from.pan.clone().lerp(to.pan, share),
    };
    if (this.#move.share >= 1) this.#move = null;
    return this.#move !== null;
  }

  /** Put the three.js camera where this one is. */
  apply(): PerspectiveCamera {
    const { yaw, pitch, distance } = this.#place;
    const target = this.target;
    const level = Math.cos(pitch);
    const away = new Vector3(Math.sin(yaw) * level, Math.sin(pitch), Math.cos(yaw) * level);
    this.camera.position.copy(target).addScaledVector(away, distance);
    this.camera.position.y = Math.max(this.camera.position.y, 0.02);
    this.camera.lookAt(target);
    this.camera.near = Math.max(0.02, distance / 100);
    this.camera.far = distance + 160;
    this.camera.updateProjectionMatrix();
    this.camera.updateMatrixWorld();
    return this.camera;
  }

  /** Turn by angles, slide by shares of the height of the view, come nearer by a factor: for keys. */
  nudge({ yaw = 0, pitch = 0, across = 0, up = 0, zoom = 1 }): void {
    this.#move = null;
    this.#turn(yaw, pitch);
    this.#slide(across, up);
    this.#place.distance = clamp(this.#place.distance * zoom, NEAREST, FURTHEST);
    this.#changed();
  }

  dispose(): void {
    this.#listening.abort();
  }

  #goTo(change: Partial<Place>, jump = false): void {
    const base = this.#move?.to ?? this.#place;
    const to = { ...base, ...change };
    const from = this.#place;
    // The short way round.
    to.yaw = from.yaw + (((to.yaw - from.yaw) % (2 * Math.PI)) + 3 * Math.PI) % (2 * Math.PI) - Math.PI;
    if (this.smooth && !jump) this.#move = { from, to, share: 0 };
    else {
      this.#move = null;
      this.#place = to;
    }
    this.#changed();
  }

  #turn(yaw: number, pitch: number): void {
    this.#place.yaw += yaw;
    this.#place.pitch = clamp(this.#place.pitch + pitch, -0.2, Math.PI / 2 - 0.002);
  }

  /** Slide by shares of the height of the view at the point looked at. */
  #slide(across: number, up: number): void {
    const tall = 2 * Math.tan(MathUtils.degToRad(FIELD / 2)) * this.#place.distance;
    const { elements: m } = this.camera.matrixWorld;
    this.#place.pan = this.#place.pan.clone()
      .addScaledVector(new Vector3(m[0], m[1], m[2]), across * tall)
      .addScaledVector(new Vector3(m[4], m[5], m[6]), up * tall);
  }

  #down(event: PointerEvent): void {
    this.#element.setPointerCapture(event.pointerId);
    this.#pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
    this.#move = null;
    const { button, shiftKey, altKey, ctrlKey } = event;
    if (altKey && button === 2) this.#how = "zoom"; // Alt as in Maya: left turns, middle slides, right zooms
    else if (button === 1 || button === 2 || shiftKey) this.#how = "slide";
    else this.#how = ctrlKey ? "zoom" : "turn";
  }

  #drag(event: PointerEvent): void {
    const before = this.#pointers.get(event.pointerId);
    if (!before) return;
    const now = { x: event.clientX, y: event.clientY };
    const height = this.#element.clientHeight || 1;
    const [across, down] = [now.x - before.x, now.y - before.y];
    if (this.#pointers.size === 2) this.#pinch(event.pointerId, before, now, height);
    else if (this.#how === "turn") this.#turn(-TURN * across, TURN * down);
    else if (this.#how === "slide") this.#slide(-across / height, down / height);
    else this.#place.distance = clamp(this.#place.distance * Math.exp((down - across) * 0.005), NEAREST, FURTHEST);
    this.#pointers.set(event.pointerId, now);
    this.#changed();
  }

  /** Two fingers: apart is nearer, together slides. */
  #pinch(id: number, before: { x: number; y: number }, now: { x: number; y: number }, height: number): void {
    const other = [...this.#pointers].find(([key]) => key !== id)?.[1];
    if (!other) return;
    const wide = (p: { x: number; y: number }): number => Math.hypot(p.x - other.x, p.y - other.y);
    const closer = wide(before) / Math.max(wide(now), 1);
    this.#place.distance = clamp(this.#place.distance * closer, NEAREST, FURTHEST);
    this.#slide(-(now.x - before.x) / 2 / height, (now.y - before.y) / 2 / height);
  }

  /** Come nearer so that what is under the cursor stays there. */
  #wheel(event: WheelEvent): void {
    event.preventDefault();
    this.#move = null;
    const pixels = event.deltaY * (event.deltaMode === 1 ? 16 : 1);
    const before = this.#place.distance;
    const after = clamp(before * Math.exp(clamp(pixels, -240, 240) * 0.0014), NEAREST, FURTHEST);
    const box = this.#element.getBoundingClientRect();
    const cursor = new Vector2(
      (2 * (event.clientX - box.left)) / box.width - 1, 1 - (2 * (event.clientY - box.top)) / box.height,
    );
    const ray = new Raycaster();
    ray.setFromCamera(cursor, this.apply());
    const target = this.target;
    const towards = this.camera.getWorldDirection(new Vector3());
    const under = ray.ray.intersectPlane(new Plane().setFromNormalAndCoplanarPoint(towards, target), new Vector3());
    if (under) this.#place.pan = this.#place.pan.clone().addScaledVector(under.sub(target), 1 - after / before);
    this.#place.distance = after;
    this.#changed();
  }
}
