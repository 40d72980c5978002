// One motion in the room: its figure, and what it leaves behind, the trails and the prints of its feet.
import {
  BufferAttribute, BufferGeometry, CircleGeometry, Color, Group, InstancedMesh, Line, LineBasicMaterial, Matrix4,
  Mesh, MeshBasicMaterial, SRGBColorSpace, Vector3,
} from "three";
import type { Frames } from "../messages";
import type { PoseSource } from "../motion/blend";
import { fk, newPose, newWorld, positionOf, type Pose, type World } from "../motion/pose";
import { distance, type Vector } from "../motion/vectors";
import { Mannequin, type FigureOptions } from "./mannequin";
import { PALETTE } from "./solids";
import { groundAt, inRoom, SLIDES, travelOf, TRAILS, wayOf, type Travel, type Way } from "./travel";

export interface Trails {
  hands: boolean;
  feet: boolean;
  head: boolean;
}

const WINDOW = 1.5; // seconds of a trail before and after the present
const PRINT = 0.085; // metres: radius of a footprint's disc
const SLIDING = new Color("#d3122e");
const OF: Record<(typeof TRAILS)[number], keyof Trails> = {
  left_wrist: "hands", right_wrist: "hands", left_toe: "feet", right_toe: "feet", head: "head",
};

export class Actor extends Group {
  source: PoseSource;
  /** Seconds of the motion that are shown. */
  seconds = 0;
  #figure: Mannequin;
  #options: FigureOptions;
  #pose: Pose;
  #world: World;
  #travel: Travel | null = null;
  #way: Way | null = null;
  #marks = new Group();
  #lines = new Map<string, Line<BufferGeometry, LineBasicMaterial>>();
  #spots: Spots | null;

  constructor(source: PoseSource, options: FigureOptions) {
    super();
    this.source = source;
    this.#options = options;
    this.#pose = newPose(source.head.joints.length);
    this.#world = newWorld(source.head.joints.length);
    this.#figure = this.#made();
    this.#spots = options.quality === "low" ? new Spots() : null;
    this.add(this.#figure, this.#marks, ...(this.#spots ? [this.#spots] : []));
    this.#stand();
  }

  /** Show another motion; the figure stays where the body is the same. */
  play(source: PoseSource): void {
    const same = sameFigure(this.source.head, source.head);
    this.source = source;
    this.#forget();
    if (same) {
      this.#figure.head = source.head;
    } else {
      this.#figure.removeFromParent();
      this.#figure.dispose();
      this.#pose = newPose(source.head.joints.length);
      this.#world = newWorld(source.head.joints.length);
      this.#figure = this.#made();
      this.add(this.#figure);
    }
    this.#stand();
  }

  /** How the motion goes through the room; worked out when first asked for. */
  get travel(): Travel {
    return (this.#travel ??= travelOf(this.source));
  }

  set ghost(on: boolean) {
    this.#figure.ghost = on;
    if (this.#spots) this.#spots.visible = !on;
  }

  set palette(palette: readonly Vector[] | undefined) {
    const { palette: _, ...rest } = this.#options;
    this.#options = palette ? { ...rest, palette } : rest;
    if (palette ?? this.source.head.shape) this.#figure.colour(palette ?? PALETTE);
  }

  mark(parts: readonly string[]): boolean {
    return this.#figure.mark(parts);
  }

  /** Take the pose of a time, which is kept inside the motion. */
  seek(seconds: number): void {
    this.seconds = Math.min(Math.max(seconds, 0), this.source.duration);
    this.source.pose(this.seconds, this.#pose);
    fk(this.#pose, this.source.head.parents, this.#world);
    this.#figure.move(this.#world);
    this.#spots?.move(this);
    const { step, count, first: action } = this.#travel ?? { step: 1, count: 0, first: 0 };
    for (const line of this.#lines.values()) {
      const first = Math.max(action, Math.ceil((this.seconds - WINDOW) / step));
      const end = Math.min(count, Math.floor((this.seconds + WINDOW) / step) + 1);
      line.geometry.setDrawRange(first, Math.max(end - first, 0));
    }
  }

  /** Where a joint is in the room, with what the whole is shifted by. */
  joint(index: number): Vector3 {
    return new Vector3(...inRoom(this.source.head, positionOf(this.#world, index))).add(this.position);
  }

  /** The point of the floor below the figure: x and z. */
  get ground(): readonly [number, number] {
    return this.groundAt(this.seconds);
  }

  groundAt(seconds: number): readonly [number, number] {
    return groundAt((this.#way ??= wayOf(this.source)), seconds);
  }

  /** Show some trails, and the prints of the feet, or not. */
  leave(trails: Trails, footprints: boolean): void {
    this.#forgetMarks();
    for (const role of TRAILS) {
      const points = trails[OF[role]] ? this.travel.trails[role] : undefined;
      if (points) this.#lines.set(role, this.#line(role, points));
    }
    if (footprints && this.travel.footprints.length) this.#marks.add(this.#prints());
  }

  dispose(): void {
    this.#forget();
    this.#figure.dispose();
    this.#spots?.dispose();
    this.removeFromParent();
  }

  #made(): Mannequin {
    const { source } = this;
    const world = fk(source.pose(0, this.#pose), source.head.parents, this.#world);
    return new Mannequin(source.head, world, this.#options);
  }

  #stand(): void {
    const { head } = this.source;
    const at = (v: Vector): Vector3 => new Vector3(...v).multiplyScalar(head.metres);
    const [left, up, forward] = [at(head.left), at(head.up), at(head.forward)];
    const into = new Matrix4().makeBasis(left, up, forward).transpose();
    into.setPosition(0, -head.floor * head.metres, 0);
    this.#figure.matrixAutoUpdate = false;
    this.#figure.matrix.copy(into);
    this.#figure.matrixWorldNeedsUpdate = true;
  }

  #line(role: string, points: Float32Array): Line<BufferGeometry, LineBasicMaterial> {
    const geometry = new BufferGeometry().setAttribute("position", new BufferAttribute(points, 3));
    const line = new Line(geometry, new LineBasicMaterial({ color: colourOf(role), transparent: true, opacity: 0.9 }));
    line.frustumCulled = false;
    this.#marks.add(line);
    return line;
  }

  #prints(): InstancedMesh {
    const { footprints } = this.travel;
    const material = new MeshBasicMaterial({ transparent: true, opacity: 0.5, depthWrite: false });
    const discs = new InstancedMesh(new CircleGeometry(PRINT, 32).rotateX(-Math.PI / 2), material, footprints.length);
    footprints.forEach(({ side, x, z, slide }, i) => {
      discs.setMatrixAt(i, new Matrix4().makeTranslation(x, 0.004, z));
      discs.setColorAt(i, slide > SLIDES ? SLIDING : colourOf(side));
    });
    discs.frustumCulled = false;
    return discs;
  }

  #forget(): void {
    this.#travel = null;
    this.#way = null;
    this.#forgetMarks();
  }

  #forgetMarks(): void {
    for (const child of [...this.#marks.children] as (Line | InstancedMesh)[]) {
      child.geometry.dispose();
      (child.material as LineBasicMaterial).dispose();
      if (child instanceof InstancedMesh) child.dispose();
      child.removeFromParent();
    }
    this.#lines.clear();
  }
}

function colourOf(role: string): Color {
  const [red, green, blue] = role.startsWith("left") ? PALETTE[3] : role.startsWith("right") ? PALETTE[4] : PALETTE[2];
  return new Color().setRGB(red / 255, green / 255, blue / 255, SRGBColorSpace);
}

/** Whether two motions can be shown by the same solids. */
function sameFigure(one: Frames, other: Frames): boolean {
  if (one === other) return true;
  const [a, b] = [one.shape, other.shape];
  if (!a || !b || one.joints.length !== other.joints.length) return false;
  const near = 1e-3 * a.leg_length;
  return (
    one.joints.every((name, i) => name === other.joints[i]) &&
    Math.abs(a.leg_length - b.leg_length) < near &&
    a.stance_positions.every((place, i) => distance(place, b.stance_positions[i]) < near)
  );
}

/** Soft dark spots below hips and feet, where there is no real shadow. */
class Spots extends Group {
  #geometry = soft();
  #material = new MeshBasicMaterial({ color: 0, transparent: true, vertexColors: true, depthWrite: false });

  constructor() {
    super();
    for (let i = 0; i < 3; i++) this.add(new Mesh(this.#geometry, this.#material));
  }

  move(actor: Actor): void {
    const { shape, drawn } = actor.source.head;
    const joints = shape ? ["hips", "left_ankle", "right_ankle"].map((role) => shape.roles[role]) : [drawn[0]];
    this.children.forEach((spot, i) => {
      spot.visible = i < joints.length;
      if (!spot.visible) return;
      const place = actor.joint(joints[i]).sub(actor.position);
      const size = (i === 0 ? 0.34 : 0.14) * (1 + 0.4 * Math.max(place.y, 0));
      spot.position.set(place.x, 0.003 + 0.0005 * i, place.z);
      spot.scale.setScalar(size);
    });
  }

  dispose(): void {
    this.#geometry.dispose();
    this.#material.dispose();
  }
}

/** A disc that is dark in the middle and nothing at its edge. */
function soft(): BufferGeometry {
  const geometry = new CircleGeometry(1, 28).rotateX(-Math.PI / 2);
  const count = geometry.getAttribute("position").count;
  const colours = new Float32Array(4 * count);
  colours[3] = 0.42;
  return geometry.setAttribute("color", new BufferAttribute(colours, 4));
}
