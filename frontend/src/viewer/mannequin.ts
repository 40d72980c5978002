// A figure on the screen: all its solids as one mesh, made once. Each pose only moves the frames the solids hang on.
import {
  BufferAttribute, BufferGeometry, Bone, Color, DetachedBindMode, Group, Matrix4, MeshBasicMaterial,
  MeshLambertMaterial, MeshStandardMaterial, Skeleton, SkinnedMesh, SRGBColorSpace, type Material,
} from "three";
import type { Frames, Shape } from "../messages";
import type { World } from "../motion/pose";
import { cross, distance, subtract, unit, type Vector } from "../motion/vectors";
import { PALETTE, solidsOf, STICK_PALETTE, type Cone, type Ellipsoid, type Solids } from "./solids";

const GHOST = { colour: "#8b929a", opacity: 0.28 };
const MARKED = new Color().setRGB(0.86, 0.12, 0.1, SRGBColorSpace);
const TINT = 0.72; // how much of a marked part is red
const ROUND = { high: { around: 24, arc: 6 }, low: { around: 14, arc: 4 } };
const DARKER = 5; // the first colour of joints and toes
const PROUD = 1.025; // how much larger these are drawn, where they would coincide with what they continue

export interface FigureOptions {
  quality?: "high" | "low";
  palette?: readonly Vector[];
}

/** One figure: give it world transforms of its joints with `move`. It lives in the clip's own axes and unit. */
export class Mannequin extends Group {
  head: Frames;
  #rig: Rig;
  #body: SkinnedMesh<BufferGeometry, Material>;
  #depth: SkinnedMesh<BufferGeometry, Material>;
  #solid: Material;
  #ghost: Material;
  #shapes: Shapes;
  #palette: readonly Vector[];
  #marked = "";

  /** `world` is any pose of it: where no body is found, it tells how long the sticks are. */
  constructor(head: Frames, world: World, { quality = "high", palette }: FigureOptions = {}) {
    super();
    this.head = head;
    const solids = solidsOf(head, head.shape ? stance(head.shape) : world);
    this.#shapes = new Shapes(solids, ROUND[quality]);
    this.#palette = palette ?? (head.shape ? PALETTE : STICK_PALETTE);
    this.#rig = new Rig(this.#shapes.frames);
    this.#solid = quality === "high" ? new MeshStandardMaterial({ vertexColors: true, roughness: 0.62 })
      : new MeshLambertMaterial({ vertexColors: true });
    // Behind what it coincides with, and seen once: depth is laid down first, so that no part shines through another.
    const behind = { polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 2 };
    this.#ghost = new MeshLambertMaterial({ color: GHOST.colour, opacity: GHOST.opacity, transparent: true, ...behind });
    this.#body = this.#mesh(this.#solid);
    this.#depth = this.#mesh(new MeshBasicMaterial({ colorWrite: false, transparent: true, ...behind }));
    this.#depth.renderOrder = 1;
    this.add(this.#depth, this.#body);
    this.colour();
    this.ghost = false;
    this.#place(solids);
  }

  #mesh(material: Material): SkinnedMesh<BufferGeometry, Material> {
    const mesh = new SkinnedMesh(this.#shapes.geometry, material);
    mesh.bindMode = DetachedBindMode;
    mesh.bind(this.#rig, new Matrix4());
    mesh.frustumCulled = false;
    return mesh;
  }

  /** Grey and seen through, without a shadow. */
  set ghost(on: boolean) {
    this.#body.material = on ? this.#ghost : this.#solid;
    this.#body.renderOrder = on ? 2 : 0;
    this.#body.castShadow = !on;
    this.#depth.visible = on;
  }

  /** Take a pose. */
  move(world: World): void {
    this.#place(solidsOf(this.head, world));
  }

  /** Tint these parts of the body red; returns whether that changed anything. */
  mark(parts: readonly string[]): boolean {
    const marked = [...new Set(parts.flatMap((part) => partsIn(part)))].sort().join(" ");
    if (marked === this.#marked) return false;
    this.#marked = marked;
    this.colour();
    return true;
  }

  /** Use another palette. */
  colour(palette: readonly Vector[] = this.#palette): void {
    this.#palette = palette;
    const marked = new Set(this.#marked ? this.#marked.split(" ") : []);
    const everything = marked.has("all");
    this.#shapes.colour((colour, part) => {
      const [red, green, blue] = palette[colour] ?? palette[0];
      const mixed = new Color().setRGB(red / 255, green / 255, blue / 255, SRGBColorSpace);
      return everything || marked.has(part) ? mixed.lerp(MARKED, TINT) : mixed;
    });
  }

  #place({ cones, ellipsoids }: Solids): void {
    let at = 0;
    for (const cone of cones) {
      const axes = frameAlong(cone.start, cone.end);
      this.#rig.put(at++, axes, cone.start);
      this.#rig.put(at++, axes, cone.end);
    }
    for (const { axes, centre } of ellipsoids) this.#rig.put(at++, axes, centre);
    this.#rig.changed();
  }

  dispose(): void {
    this.#shapes.geometry.dispose();
    this.#rig.dispose();
    for (const material of [this.#solid, this.#ghost, this.#depth.material]) material.dispose();
  }
}

/** Names of parts as the body has them: a limb for a group of limbs or a role; "all" for no part. */
function partsIn(part: string): readonly string[] {
  const sides = ["left", "right"];
  if (part === "arms" || part === "legs") return sides.map((side) => `${side}_${part.slice(0, -1)}`);
  if (part === "upper") return ["head", "torso", "left_arm", "right_arm"];
  if (sides.includes(part)) return [`${part}_arm`, `${part}_leg`];
  const [, side, role] = /^(left|right)_(\w+)$/.exec(part) ?? [];
  if (side && /^(arm|collar|shoulder|elbow|wrist|hand)$/.test(role)) return [`${side}_arm`];
  if (side) return [`${side}_leg`];
  if (part === "neck") return ["head"];
  return [["hips", "spine", "chest"].includes(part) ? "torso" : part || "all"];
}

/** World transforms of the neutral stance. */
function stance(shape: Shape): World {
  const { stance_rotations: turned, stance_positions: standing } = shape;
  return { rotations: Float64Array.from(turned.flat()), positions: Float64Array.from(standing.flat()) };
}

/** Axes with the second from `start` to `end`; upright where both are the same. */
function frameAlong(start: Vector, end: Vector): readonly [Vector, Vector, Vector] {
  const bone = subtract(end, start);
  const y: Vector = distance(start, end) < 1e-9 ? [0, 1, 0] : unit(bone);
  const other: Vector = Math.abs(y[0]) < 0.7 ? [1, 0, 0] : [0, 0, 1];
  const z = unit(cross(other, y));
  return [cross(y, z), y, z];
}

/** Frames that vertices hang on, written directly: two for every cone, one for every ellipsoid. */
class Rig extends Skeleton {
  constructor(frames: number) {
    super(Array.from({ length: frames }, () => new Bone()));
  }

  put(index: number, axes: readonly [Vector, Vector, Vector], place: Vector): void {
    const m = this.boneMatrices as Float32Array;
    const at = 16 * index;
    for (let column = 0; column < 3; column++) {
      for (let row = 0; row < 3; row++) m[at + 4 * column + row] = axes[column][row];
    }
    for (let row = 0; row < 3; row++) m[at + 12 + row] = place[row];
    m[at + 15] = 1;
  }

  changed(): void {
    if (this.boneTexture) this.boneTexture.needsUpdate = true;
  }

  /** The matrices are written by `put`; there are no bones to read. */
  override update(): void {}
}

interface Stretch {
  start: number;
  count: number;
  colour: number;
  part: string;
}

/** The geometry of solids: what hangs on which frame, and which stretch of vertices is which solid. */
class Shapes {
  readonly geometry = new BufferGeometry();
  readonly frames: number;
  #stretches: Stretch[] = [];
  #positions: number[] = [];
  #normals: number[] = [];
  #frame: number[] = [];
  #triangles: number[] = [];

  constructor({ cones, ellipsoids }: Solids, { around, arc }: { around: number; arc: number }) {
    cones.forEach((cone, i) => this.#solid(cone, () => this.#cone(cone, 2 * i, around, arc)));
    ellipsoids.forEach((ellipsoid, i) =>
      this.#solid(ellipsoid, () => this.#ellipsoid(ellipsoid, 2 * cones.length + i, around + 6, 2 * arc + 4)),
    );
    this.frames = 2 * cones.length + ellipsoids.length;
    const count = this.#frame.length;
    const indices = new Uint16Array(4 * count);
    const weights = new Float32Array(4 * count);
    this.#frame.forEach((frame, i) => {
      indices[4 * i] = frame;
      weights[4 * i] = 1;
    });
    const { geometry } = this;
    geometry.setAttribute("position", new BufferAttribute(new Float32Array(this.#positions), 3));
    geometry.setAttribute("normal", new BufferAttribute(new Float32Array(this.#normals), 3));
    geometry.setAttribute("color", new BufferAttribute(new Float32Array(3 * count), 3));
    geometry.setAttribute("skinIndex", new BufferAttribute(indices, 4));
    geometry.setAttribute("skinWeight", new BufferAttribute(weights, 4));
    geometry.setIndex(this.#triangles);
  }

  /** Colour every solid. */
  colour(pick: (colour: number, part: string) => Color): void {
    const colours = this.geometry.getAttribute("color") as BufferAttribute;
    for (const { start, count, colour, part } of this.#stretches) {
      const { r, g, b } = pick(colour, part);
      for (let i = start; i < start + count; i++) colours.setXYZ(i, r, g, b);
    }
    colours.needsUpdate = true;
  }

  #solid({ colour, part }: { colour: number; part: string }, make: () => void): void {
    const start = this.#frame.length;
    make();
    this.#stretches.push({ start, count: this.#frame.length - start, colour, part });
  }

  /** Two caps that meet their tangent cone; each hangs on its own end, so that the bone may change its length. */
  #cone({ start, end, radii, colour }: Cone, frame: number, around: number, arc: number): void {
    const [ra, rb] = radii.map((radius) => (colour >= DARKER ? PROUD * radius : radius));
    const long = distance(start, end);
    const ball = long <= Math.abs(ra - rb) + 1e-9;
    const lean = ball ? 0 : Math.asin((ra - rb) / long);
    const rings: Ring[] = [];
    const cap = (from: number, to: number, radius: number, on: number): void => {
      for (let i = 0; i <= arc; i++) {
        const angle = from + ((to - from) * i) / arc;
        rings.push({ radius: radius * Math.cos(angle), height: radius * Math.sin(angle), angle, frame: on });
      }
    };
    if (ball) cap(-Math.PI / 2, Math.PI / 2, Math.max(ra, rb), ra >= rb ? frame : frame + 1);
    else {
      cap(-Math.PI / 2, lean, ra, frame);
      cap(lean, Math.PI / 2, rb, frame + 1);
    }
    this.#lathe(rings, around, (x, y, z) => [x, y, z]);
  }

  #ellipsoid({ half }: Ellipsoid, frame: number, around: number, rows: number): void {
    const rings = Array.from({ length: rows + 1 }, (_, i) => {
      const angle = -Math.PI / 2 + (Math.PI * i) / rows;
      return { radius: Math.cos(angle), height: Math.sin(angle), angle, frame };
    });
    const first = this.#positions.length;
    this.#lathe(rings, around, (x, y, z) => unit([x / half[0], y / half[1], z / half[2]]));
    for (let i = first; i < this.#positions.length; i++) this.#positions[i] *= half[(i - first) % 3];
  }

  #lathe(rings: readonly Ring[], around: number, normal: (x: number, y: number, z: number) => Vector): void {
    const first = this.#frame.length;
    for (const { radius, height, angle, frame } of rings) {
      for (let i = 0; i <= around; i++) {
        const turn = (2 * Math.PI * i) / around;
        const [s, c] = [Math.sin(turn), Math.cos(turn)];
        this.#positions.push(radius * s, height, radius * c);
        this.#normals.push(...normal(Math.cos(angle) * s, Math.sin(angle), Math.cos(angle) * c));
        this.#frame.push(frame);
      }
    }
    for (let row = 0; row + 1 < rings.length; row++) {
      for (let i = 0; i < around; i++) {
        const a = first + row * (around + 1) + i;
        const b = a + around + 1;
        this.#triangles.push(a, a + 1, b, b, a + 1, b + 1);
      }
    }
  }
}

interface Ring {
  radius: number;
  height: number;
  angle: number;
  frame: number;
}
