// The solid parts of a figure in one pose: the same as src/mien/render/mannequin.py and figure.py make, which a test
// compares part by part. Measures are in leg lengths; what comes out is in the clip's own axes and unit.
import type { Frames, Shape } from "../messages";
import { positionOf, rotationOf, type World } from "../motion/pose";
import {
  add, conjugate, cross, distance, dot, length, mix, multiply, rotate, scale, subtract, sum, unit, type Vector,
} from "../motion/vectors";
import { clamp } from "../playback";

/** The hull of two spheres. `part` is the part of the body it shows, by its name in mien. */
export interface Cone {
  start: Vector;
  end: Vector;
  radii: readonly [number, number];
  colour: number;
  part: string;
}

export interface Ellipsoid {
  centre: Vector;
  /** Unit, at right angles to each other, right-handed. */
  axes: readonly [Vector, Vector, Vector];
  half: readonly [number, number, number];
  colour: number;
  part: string;
}

export interface Solids {
  cones: Cone[];
  ellipsoids: Ellipsoid[];
}

type Pair = readonly [number, number];
type Half = readonly [number, number, number];
type Side = "left" | "right";

const SIDES: readonly Side[] = ["left", "right"];
// Half widths at the start and end of each limb bone.
const THIGH: Pair = [0.098, 0.062];
const SHIN: Pair = [0.064, 0.04];
const UPPER_ARM: Pair = [0.058, 0.045];
const FOREARM: Pair = [0.046, 0.032];
const SKULL: Half = [0.094, 0.132, 0.114]; // half axes: left, up, forward
const HAND: Half = [0.022, 0.095, 0.05]; // across the palm, along, wide
const SOLE = 0.036; // half thickness of the foot
const BASE = 0;
const DARK = 1;
const HAIR = 2;
const SIDE = { left: 3, right: 4 };
const JOINT = { left: 5, right: 6 };

export const LEG_METRES = 0.87; // a leg where the clip's unit is not known
const STICK = 0.035;

/** Colours of the parts, from 0 to 255, as sRGB. */
export const PALETTE: readonly Vector[] = [
  [222, 203, 172], [58, 46, 40], [110, 88, 72], [66, 140, 206], [232, 126, 62], [40, 98, 156], [178, 84, 34],
];
export const STICK_PALETTE: readonly Vector[] = [[196, 120, 78], [70, 84, 110]];

/** The shades of one colour, for a figure without a left and a right colour. */
export function plainPalette(colour: Vector): readonly Vector[] {
  return [1, 0.35, 0.62, 1, 1, 0.75, 0.75].map((shade) => scale(shade, colour));
}

/** Return the solids of a pose: a mannequin, or sticks where the motion has no body. */
export function solidsOf(head: Frames, world: World): Solids {
  return head.shape ? mannequin(head, head.shape, world) : sticks(head, world);
}

function mannequin(head: Frames, shape: Shape, world: World): Solids {
  const build = new Builder(head, shape, world);
  for (const side of SIDES) {
    build.part = `${side}_leg`;
    leg(build, side);
    foot(build, side);
    build.part = `${side}_arm`;
    arm(build, side);
    hand(build, side);
  }
  build.part = "torso";
  trunk(build);
  build.part = "head";
  face(build);
  return build;
}

/** Collects solids; knows where each role is and how it is turned from the neutral stance. */
class Builder implements Solids {
  readonly cones: Cone[] = [];
  readonly ellipsoids: Ellipsoid[] = [];
  readonly unit: number;
  readonly up: Vector;
  readonly forward: Vector;
  readonly left: Vector;
  part = "";
  #turns: Vector[] = [];

  constructor(head: Frames, readonly shape: Shape, readonly world: World) {
    this.unit = shape.leg_length;
    this.up = head.up;
    this.forward = head.forward;
    this.left = head.left;
  }

  has(role: string): boolean {
    return role in this.shape.roles;
  }

  role(name: string): number {
    return this.shape.roles[name];
  }

  /** Where a joint is in the neutral stance. */
  stance(joint: number): Vector {
    return this.shape.stance_positions[joint];
  }

  position(joint: number): Vector {
    return positionOf(this.world, joint);
  }

  at(role: string): Vector {
    return this.position(this.role(role));
  }

  /** A vector of the neutral stance, given in leg lengths. */
  vector(left: number, up: number, forward: number): Vector {
    return sum([this.unit * left, this.left], [this.unit * up, this.up], [this.unit * forward, this.forward]);
  }

  /** Turn a vector of the neutral stance with a joint. */
  turned(joint: number, vector: Vector): Vector {
    this.#turns[joint] ??= multiply(rotationOf(this.world, joint), conjugate(this.shape.stance_rotations[joint]));
    return rotate(this.#turns[joint], vector);
  }

  cone(start: Vector, end: Vector, radii: Pair, colour: number): void {
    const { part } = this;
    this.cones.push({ start, end, radii: [radii[0] * this.unit, radii[1] * this.unit], colour, part });
  }

  ball(centre: Vector, radius: number, colour: number): void {
    this.cone(centre, centre, [radius, radius], colour);
  }

  ellipsoid(centre: Vector, axes: readonly [Vector, Vector, Vector], half: Half, colour: number): void {
    const [a, b, c] = half;
    const { part, unit: u } = this;
    this.ellipsoids.push({ centre, axes, half: [a * u, b * u, c * u], colour, part });
  }
}

function leg(build: Builder, side: Side): void {
  const [hip, knee, ankle] = ["hip", "knee", "ankle"].map((role) => build.at(`${side}_${role}`));
  build.cone(hip, knee, THIGH, SIDE[side]);
  build.cone(knee, ankle, SHIN, SIDE[side]);
  build.ball(knee, 1.08 * SHIN[0], JOINT[side]);
}

/** Heel to the two sides of the ball, ball to toes: flat, and it shows where the toes point. */
function foot(build: Builder, side: Side): void {
  const ankle = build.role(`${side}_ankle`);
  const toe = build.has(`${side}_toe`) ? build.role(`${side}_toe`) : ankle;
  const depth = build.shape.sole_depth[SIDES.indexOf(side)];
  const long = build.shape.sole_length[SIDES.indexOf(side)];
  const along = footDirection(build, ankle, toe);
  const across = cross(build.up, along);
  const start = build.position(ankle);
  const u = build.unit;
  const low = scale(SOLE - depth, build.up);
  const at = (...terms: readonly (readonly [number, Vector])[]): Vector =>
    add(start, build.turned(ankle, scale(u, sum([1, low], ...terms))));
  const heel = at([-0.055, along]);
  build.cone(start, at([0.35 * long, along]), [0.042, SOLE], SIDE[side]);
  for (const sign of [-1, 1]) {
    const aside = scale(0.024 * sign, across);
    const ball = at([long, along], [1, aside]);
    const reach = scale(u, sum([0.2 - long, along], [-0.012, build.up], [-0.3, aside]));
    build.cone(heel, ball, [SOLE, SOLE], SIDE[side]);
    build.cone(ball, add(ball, build.turned(toe, reach)), [SOLE, 0.024], JOINT[side]);
  }
}

/** Where the toes point in the neutral stance, level. */
function footDirection(build: Builder, ankle: number, toe: number): Vector {
  const bone = scale(1 / build.unit, subtract(build.stance(toe), build.stance(ankle)));
  const level = subtract(bone, scale(dot(bone, build.up), build.up));
  return length(level) > 0.05 ? unit(level) : build.forward;
}

function arm(build: Builder, side: Side): void {
  const shoulder = build.at(`${side}_shoulder`);
  const elbow = build.at(`${side}_elbow`);
  build.cone(shoulder, elbow, UPPER_ARM, SIDE[side]);
  build.cone(elbow, wristOf(build, side), FOREARM, SIDE[side]);
  build.ball(elbow, 1.08 * FOREARM[0], JOINT[side]);
  build.ball(shoulder, 1.12 * UPPER_ARM[0], SIDE[side]);
}

/** Where the wrist is; a skeleton that ends at the elbow gets a forearm as long as the arm. */
function wristOf(build: Builder, side: Side): Vector {
  if (build.has(`${side}_wrist`)) return build.at(`${side}_wrist`);
  const shoulder = build.role(`${side}_shoulder`);
  const elbow = build.role(`${side}_elbow`);
  const upperArm = subtract(build.stance(elbow), build.stance(shoulder));
  return add(build.position(elbow), build.turned(elbow, upperArm));
}

function hand(build: Builder, side: Side): void {
  const elbow = build.role(`${side}_elbow`);
  const joint = build.has(`${side}_wrist`) ? build.role(`${side}_wrist`) : elbow;
  const before = joint !== elbow ? elbow : build.role(`${side}_shoulder`);
  const along = unit(subtract(build.stance(joint), build.stance(before)));
  const wide = unit(subtract(build.forward, scale(dot(build.forward, along), along)));
  const wrist = wristOf(build, side);
  const u = build.unit;
  const turned = (v: Vector): Vector => build.turned(joint, v);
  const axes: [Vector, Vector, Vector] = [turned(cross(along, wide)), turned(along), turned(wide)];
  build.ellipsoid(add(wrist, scale(0.08 * u, axes[1])), axes, HAND, SIDE[side]);
  const root = sum([1, wrist], [0.03 * u, axes[1]], [0.025 * u, axes[2]]);
  build.cone(root, sum([1, root], [0.05 * u, axes[1]], [0.045 * u, axes[2]]), [0.018, 0.013], JOINT[side]);
}

/** Pelvis, belly and ribs along the bend of the spine, turned from the hips' to the shoulders' line. */
function trunk(build: Builder): void {
  const hips = SIDES.map((side) => build.at(`${side}_hip`));
  const shoulders = SIDES.map((side) => build.at(`${side}_shoulder`));
  const top = mix(shoulders[0], shoulders[1], 0.5);
  const spine = build.shape.spine.slice(1).map((joint) => build.position(joint));
  const line = [mix(hips[0], hips[1], 0.5), ...spine, top];
  const wide = [unit(subtract(hips[0], hips[1])), unit(subtract(shoulders[0], shoulders[1]))];
  const long = trunkLength(build);
  const ribs = clamp(0.43 * width(build, "shoulder"), 0.13, 0.22);
  const pelvis = clamp(0.5 * width(build, "hip") + 0.075, 0.13, 0.2);
  const rounds: [number, Half][] = [
    [0.06, [pelvis, 0.12, 0.112]],
    [0.38, [0.44 * (ribs + pelvis), 0.3 * long, 0.104]],
    [0.7, [ribs, 0.35 * long, 0.122]],
  ];
  for (const [share, half] of rounds) {
    const [centre, along] = sample(line, share);
    const across = unit(mix(wide[0], wide[1], share));
    const left = unit(subtract(across, scale(dot(across, along), along)));
    build.ellipsoid(centre, [left, along, cross(left, along)], half, BASE);
  }
  for (const shoulder of shoulders) build.cone(top, shoulder, [0.07, 0.056], BASE);
}

function trunkLength(build: Builder): number {
  const middle = (role: string): Vector =>
    mix(build.stance(build.role(`left_${role}`)), build.stance(build.role(`right_${role}`)), 0.5);
  return distance(middle("shoulder"), middle("hip")) / build.unit;
}

function width(build: Builder, role: string): number {
  const [left, right] = SIDES.map((side) => build.stance(build.role(`${side}_${role}`)));
  return distance(left, right) / build.unit;
}

/** The point at a share of the way along a line of points, and a smooth direction there. */
function sample(line: readonly Vector[], share: number): [Vector, Vector] {
  const reach = [0];
  for (let i = 1; i < line.length; i++) reach.push(reach[i - 1] + distance(line[i - 1], line[i]));
  const point = (at: number): Vector => {
    const goal = clamp(at, 0, 1) * reach[reach.length - 1];
    let bone = 0;
    while (bone < line.length - 2 && reach[bone + 1] < goal) bone++;
    return mix(line[bone], line[bone + 1], (goal - reach[bone]) / Math.max(reach[bone + 1] - reach[bone], 1e-12));
  };
  return [point(share), unit(subtract(point(share + 0.25), point(share - 0.25)))];
}

function face(build: Builder): void {
  const top = mix(build.at("left_shoulder"), build.at("right_shoulder"), 0.5);
  const [joint, place] = headJoint(build, top);
  const turned = (v: Vector): Vector => build.turned(joint, v);
  const axes: [Vector, Vector, Vector] = [turned(build.left), turned(build.up), turned(build.forward)];
  const lift = skullLift(build, joint);
  const u = build.unit;
  const point = (left: number, up: number, forward: number): Vector =>
    sum([1, place], [u * left, axes[0]], [u * (up + lift), axes[1]], [u * forward, axes[2]]);
  build.cone(top, point(0, -0.06, -0.01), [0.062, 0.052], BASE);
  build.ellipsoid(point(0, 0, 0), axes, SKULL, BASE);
  build.ellipsoid(point(0, -0.07, 0.034), axes, [0.06, 0.058, 0.07], BASE); // jaw
  build.ellipsoid(point(0, 0.024, -0.022), axes, [0.098, 0.121, 0.105], HAIR);
  build.ellipsoid(point(0, 0.018, 0.04), axes, [0.089, 0.034, 0.088], DARK); // eye band
  build.cone(point(0, -0.022, 0.1), point(0, -0.042, 0.15), [0.024, 0.013], HAIR); // nose
  build.ball(point(0.096, -0.008, -0.005), 0.024, JOINT.left);
  build.ball(point(-0.096, -0.008, -0.005), 0.024, JOINT.right);
}

/** The joint that carries the head, and where the base of the skull is. */
function headJoint(build: Builder, top: Vector): [number, Vector] {
  if (build.has("head")) return [build.role("head"), build.at("head")];
  const { spine } = build.shape;
  const other = spine.length ? spine[spine.length - 1] : build.role("hips");
  const joint = build.has("neck") ? build.role("neck") : other;
  return [joint, add(top, build.turned(joint, build.vector(0, 0.13, 0)))];
}

/** How far the middle of the skull is above the head joint. */
function skullLift(build: Builder, joint: number): number {
  if (!build.has("head")) return 0.1;
  const feet = Math.min(...SIDES.map((side) => dot(build.stance(build.role(`${side}_ankle`)), build.up)));
  const above = (build.shape.height - dot(build.stance(joint), build.up) + feet) / build.unit - 0.09;
  return clamp(above - SKULL[1], 0.05, 0.13);
}

/** A stick from every joint drawn to its parent and its end sites, with a knob on every joint. */
function sticks(head: Frames, world: World): Solids {
  const size = LEG_METRES / head.metres;
  const drawn = new Set(head.drawn);
  const cones: Cone[] = [];
  const stick = (start: Vector, end: Vector): void => {
    cones.push({ start, end, radii: [0.6 * STICK * size, 0.6 * STICK * size], colour: 0, part: "" });
  };
  for (const joint of head.drawn) {
    const parent = head.parents[joint];
    if (drawn.has(parent)) stick(positionOf(world, parent), positionOf(world, joint));
  }
  head.tips.forEach((joint, i) => {
    const at = positionOf(world, joint);
    stick(at, add(at, rotate(rotationOf(world, joint), head.tip_offsets[i])));
  });
  for (const joint of head.drawn) {
    const at = positionOf(world, joint);
    cones.push({ start: at, end: at, radii: [STICK * size, STICK * size], colour: 1, part: "" });
  }
  return { cones, ellipsoids: [] };
}
