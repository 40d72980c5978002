// How the page shows things: part of a project, but no part of what is done to a clip.

export type Mode = "edited" | "overlay" | "side" | "wipe";

export interface View {
  mode: Mode;
  /** On the spot or not; null: where original and edit would part from each other. */
  treadmill: boolean | null;
  follow: boolean;
  trails: boolean;
  footprints: boolean;
  names: boolean;
  grid: boolean;
  neutral: boolean;
  phase: boolean;
  curves: string[];
}

export const MODES: readonly { mode: Mode; label: string; hint: string }[] = [
  { mode: "edited", label: "Edited", hint: "the edited motion alone" },
  { mode: "overlay", label: "Ghost", hint: "with the original as a ghost" },
  { mode: "side", label: "Side by side", hint: "original left, edited right" },
  { mode: "wipe", label: "Wipe", hint: "original left of a line, edited right of it" },
];

export type Toggle =
  "treadmill" | "follow" | "trails" | "footprints" | "names" | "grid" | "neutral" | "phase";

export const TOGGLES: readonly { toggle: Toggle; label: string; hint: string }[] = [
  {
    toggle: "treadmill",
    label: "In place",
    hint: "walk on the spot, so that different speeds stay in view; by itself where the two would part",
  },
  { toggle: "follow", label: "Follow", hint: "the camera goes with the figure" },
  { toggle: "trails", label: "Trails", hint: "where hands, feet and head went" },
  { toggle: "footprints", label: "Feet", hint: "where feet stand; red where one slides" },
  { toggle: "names", label: "Names", hint: "names of joints" },
  { toggle: "grid", label: "Grid", hint: "a grid of metres on the floor" },
  { toggle: "neutral", label: "One colour", hint: "left and right without colours of their own" },
  {
    toggle: "phase",
    label: "In step",
    hint: "where the edit takes longer, meet the original at the same step",
  },
];

const PART = 0.3; // metres from which two figures are no longer seen as one over the other
const MEET = 0.15; // metres below which they are again

/** Whether two figures part, by how far they get from each other; between the limits it stays as it was. */
export function parts(drift: number, before: boolean): boolean {
  return drift > (before ? MEET : PART);
}

/** What is on: as chosen, or else, for walking on the spot, as the comparison needs it. */
export function isOn(view: View, toggle: Toggle, parting: boolean): boolean {
  const over = view.mode === "overlay" || view.mode === "wipe";
  return view[toggle] ?? (parting && over && view.follow);
}

export function freshView(): View {
  return {
    mode: "overlay",
    treadmill: null,
    follow: true,
    trails: false,
    footprints: false,
    names: false,
    grid: true,
    neutral: false,
    phase: false,
    curves: ["hips height", "hand speed"],
  };
}

/** What of a stored view makes sense; the rest is as in a fresh one. */
export function readView(stored: Readonly<Record<string, unknown>>): View {
  const view = freshView();
  const modes: readonly unknown[] = MODES.map(({ mode }) => mode);
  if (modes.includes(stored["mode"])) view.mode = stored["mode"] as Mode;
  for (const { toggle } of TOGGLES) {
    const value = stored[toggle];
    if (typeof value === "boolean") view[toggle] = value;
  }
  const { curves } = stored;
  if (Array.isArray(curves)) view.curves = curves.filter((name) => typeof name === "string");
  return view;
}
