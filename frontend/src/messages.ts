// Made by `python scripts/messages.py` from src/mien/studio/messages.py; do not edit.

/** A motion for the page, the head of a binary answer. */
export interface Frames {
  clip: string;
  name: string;
  frames: number;
  frame_time: number;
  still: number;
  joints: string[];
  parents: number[];
  moving: number[];
  drawn: number[];
  tips: number[];
  tip_offsets: number[][];
  metres: number;
  up: number[];
  forward: number[];
  left: number[];
  floor: number;
  shape: Shape | null;
  arrays: PlaceInArrays[];
  steps: string[];
  notes: string[];
  seconds: number;
}

/** Where an array of a binary answer is: bytes from the start of the arrays, its type and its shape. */
export interface PlaceInArrays {
  name: string;
  type: "float32" | "uint8";
  start: number;
  shape: number[];
}

/** What a mannequin needs of a body: roles, the neutral stance in world axes, and measures. */
export interface Shape {
  roles: Record<string, number>;
  spine: number[];
  leg_length: number;
  height: number;
  stance_rotations: number[][];
  stance_positions: number[][];
  sole_depth: number[];
  sole_length: number[];
}

/** One layer of the stack. */
export interface Layer {
  id: string;
  kind: "emotion" | "edit" | "place";
  name: string;
  parameters: Record<string, boolean | number | string | string[] | number[][] | null>;
  strength: number | number[][];
  parts: string[];
  span: number[] | null;
  ease: number;
  on: boolean;
  solo: boolean;
}

/** All layers from first to last, how strong the whole is, and what is done at the end. */
export interface Stack {
  layers: Layer[];
  strength: number | number[][];
  foot_plant: boolean;
  safe: boolean;
}

/** Do a stack to a clip. ``live`` is a slider on its way: quick, not made safe. */
export interface EditRequest {
  clip: string;
  stack: Stack;
  live: boolean;
  client: string;
  turn: number;
}

/** Give what a stack makes of a clip as a file. ``options`` are those of the kind, such as ``width``. */
export interface ExportRequest {
  clip: string;
  stack: Stack;
  kind: "bvh" | "recipe" | "map" | "png" | "gif" | "mp4" | "html" | "project";
  options: Record<string, boolean | number | string | string[] | number[][] | null>;
  client: string;
}

/** What is being worked out for a page. */
export interface WorkInfo {
  kind: string;
  what: string;
  share: number | null;
  seconds: number;
}

/** A clip that is open. */
export interface ClipInfo {
  id: string;
  name: string;
  frames: number;
  joints: number;
  fps: number;
  duration: number;
  problem: string;
  roles: Record<string, string>;
}

/** A role of the body, the joint that plays it now ("" for none), and whether no body is without it. */
export interface RoleInfo {
  role: string;
  group: "trunk" | "left" | "right";
  needed: boolean;
  joint: string;
}

/** What roles are to be chosen from: the joints of a clip, parents first, and how deep each hangs. */
export interface JointsInfo {
  roles: RoleInfo[];
  joints: string[];
  depths: number[];
}

/** Say which joint plays which role, "" for none; without any, the body is as it is found. */
export interface RolesRequest {
  roles: Record<string, string>;
}

/** One parameter of an edit, for a slider, a switch or a menu. */
export interface ParameterInfo {
  name: string;
  kind: "number" | "whole" | "flag" | "choice" | "text" | "list";
  doc: string;
  default: boolean | number | string | string[] | number[][] | null;
  low: number | null;
  high: number | null;
  neutral: number | null;
  unit: string;
  choices: string[];
  optional: boolean;
}

/** One edit: its kind (pose, rhythm, time, repair), what it does, and its parameters. */
export interface EditInfo {
  name: string;
  kind: string;
  summary: string;
  parameters: ParameterInfo[];
}

/** One emotion preset: what it does and how well that is known. */
export interface PresetInfo {
  name: string;
  description: string;
  evidence: string;
}

/** An emotion word and its place on the disc. */
export interface Word {
  name: string;
  valence: number;
  arousal: number;
}

/** What the page needs to begin. */
export interface Hello {
  version: string;
  samples: string[];
  presets: PresetInfo[];
  edits: EditInfo[];
  words: Word[];
  learned: Word[];
  parts: Record<string, string[]>;
  roles: string[];
  clips: ClipInfo[];
  given: string[];
  largest_upload: number;
}

/** A point of the disc, and the word nearest to it. */
export interface Place {
  valence: number;
  arousal: number;
  word: string;
}

/** One reason for a reading. */
export interface Why {
  what: string;
  how_much: string;
  pull: number;
}

/** What a motion expresses: its place, the likeliest labels with their probabilities, the reasons. */
export interface ReadingInfo {
  place: Place;
  labels: [string, number][];
  why: Why[];
  against: string;
  placed: number;
}

/** The clip by itself, what was asked for, and what the edit reached. */
export interface Readings {
  read: ReadingInfo;
  asked: Place | null;
  reached: ReadingInfo | null;
}

/** A stretch of time in which a check fails, and the worst moment in it. */
export interface MarkInfo {
  start: number;
  end: number;
  worst: number;
  parts: string[];
}

/** One check of the edited motion: its value, the source's, and what is allowed. None: not to be had. */
export interface CheckInfo {
  name: string;
  label: string;
  unit: string;
  digits: number;
  value: number | null;
  source: number | null;
  allowed: number | null;
  passed: boolean;
  marks: MarkInfo[];
}

/** All checks; ``times`` of the edited motion that failing spans refer to. */
export interface Checks {
  passed: boolean;
  checks: CheckInfo[];
}

/** One curve over time, before and after; ``times`` differ where an edit changes how long it takes. */
export interface Curve {
  name: string;
  unit: string;
  before_times: number[];
  before: number[];
  after_times: number[];
  after: number[];
}

/** Ask for curves by name: ``hips height``, ``hand speed``, ``valence``, ``arousal`` or ``joint:NAME``. */
export interface CurvesRequest {
  clip: string;
  stack: Stack;
  names: string[];
}

/** Ask for an edit in words; ``name`` is the file that it is to write, without its ending. */
export interface CopiedRequest {
  clip: string;
  stack: Stack;
  name: string;
}

/** The same edit for the command line and for Python. */
export interface Copied {
  command: string;
  python: string;
}

/** A clip of a project: by the hash of its file, with the roles of its joints as in ``ClipInfo``. */
export interface ProjectClip {
  id: string;
  name: string;
  stack: Stack;
  roles: Record<string, string>;
}

/** What a project file holds: clips by hash with their stacks, which one is shown, and the view. */
export interface Project {
  clips: ProjectClip[];
  current: string;
  view: Record<string, unknown>;
  mien_project: number;
}

/** What went wrong, in one sentence. */
export interface Failure {
  error: string;
}
