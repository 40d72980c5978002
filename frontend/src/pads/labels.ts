// Words beside points: each close to its own, none over another; for whom there is no room is left out.

export interface Spot {
  x: number;
  y: number;
  text: string;
}

export interface Label extends Spot {
  /** Where the words stand: their box, and which end of it is next to the point. */
  box: Box;
  anchor: "start" | "middle" | "end";
}

export interface Layout {
  /** How high the letters are. */
  size: number;
  labels: Label[];
}

export interface Box {
  left: number;
  top: number;
  right: number;
  bottom: number;
}

const LETTER = 0.65; // width of a letter, in heights: a little more than most fonts need
const NARROW = 0.4; // width of one of "fijlrt" and of a space
const LINE = 1.1; // height of a line, in heights of its letters
const GAP = 4; // px from a point to its words
const YIELD = 7; // px that words go aside for a mark on their point
const DOT = 2.5; // px that words keep clear of other points

/**
 * Place words within `frame`, clear of the boxes `taken`. Those that come first matter most. The largest of the
 * `sizes` is taken at which there is room for all, or else the one at which most have it.
 */
export function layout(
  spots: readonly Spot[], sizes: readonly number[], frame: Box, taken: readonly Box[] = [],
): Layout {
  let best: Layout = { size: sizes[0], labels: [] };
  for (const size of sizes) {
    const labels = placed(spots, size, frame, taken);
    if (labels.length > best.labels.length) best = { size, labels };
  }
  return best;
}

/** Let words that a mark would cover go a little aside, and only where that is free; the others stay as they are. */
export function aside(labels: readonly Label[], marks: readonly Box[], frame: Box): Label[] {
  return labels.map((label) => {
    const { anchor, box } = label;
    const covering = marks.filter((mark) => overlap(mark, box));
    if (!covering.length || anchor === "middle") return label;
    const by = anchor === "start"
      ? Math.max(...covering.map(({ right }) => right - box.left))
      : Math.min(...covering.map(({ left }) => left - box.right));
    const moved = { ...box, left: box.left + by, right: box.right + by };
    const free = within(moved, frame) && !labels.some((other) => other !== label && overlap(other.box, moved));
    return free && Math.abs(by) <= YIELD ? { ...label, box: moved } : label;
  });
}

function placed(spots: readonly Spot[], size: number, frame: Box, taken: readonly Box[]): Label[] {
  const dots = spots.map(({ x, y }) => around(x, y, DOT));
  const rooms = spots.map((spot, own) =>
    candidates(spot, size).filter(({ box }) =>
      within(box, frame) && !taken.some((other) => overlap(box, other))
        && !dots.some((dot, i) => i !== own && overlap(box, dot))));
  const found = new Map<number, Label>();
  for (const own of spots.keys()) settle(own, rooms, found);
  return spots.flatMap((_, i) => found.get(i) ?? []);
}

/** Give a word its best free place, or else one where a single other word can go out of its way. */
function settle(own: number, rooms: readonly Label[][], found: Map<number, Label>): void {
  const inTheWay = (label: Label, besides: number) =>
    [...found].filter(([i, other]) => i !== besides && overlap(label.box, other.box)).map(([i]) => i);
  const free = rooms[own].find((label) => !inTheWay(label, own).length);
  if (free) return void found.set(own, free);
  for (const label of rooms[own]) {
    const [other, ...more] = inTheWay(label, own);
    if (more.length) continue;
    const instead = rooms[other].find((one) => !overlap(one.box, label.box) && !inTheWay(one, other).length);
    if (!instead) continue;
    found.set(other, instead).set(own, label);
    return;
  }
}

/** The places around a point, the clearest first: beside it, then slanted, then above and below. */
function candidates(spot: Spot, size: number): Label[] {
  const { x, y } = spot;
  const [width, high] = [size * letters(spot.text), size * LINE];
  const at = (left: number, middle: number): Label => {
    const box = { left, right: left + width, top: middle - high / 2, bottom: middle + high / 2 };
    return { ...spot, box, anchor: left > x ? "start" : box.right < x ? "end" : "middle" };
  };
  const slants = [0, -0.3, 0.3, -0.6, 0.6, -0.9, 0.9].map((slant) => y + slant * high);
  const shifts = [0.5, 0.3, 0.7, 0.1, 0.9].map((share) => x - share * width);
  return [
    ...slants.flatMap((middle) => [at(x + GAP, middle), at(x - GAP - width, middle)]),
    ...shifts.flatMap((left) => [at(left, y - GAP - high / 2), at(left, y + GAP + high / 2)]),
  ];
}

/** About how long words are, in heights of their letters. */
function letters(text: string): number {
  return [...text].reduce((sum, letter) => sum + ("fijlrt ".includes(letter) ? NARROW : LETTER), 0);
}

function around(x: number, y: number, radius: number): Box {
  return { left: x - radius, right: x + radius, top: y - radius, bottom: y + radius };
}

function within(box: Box, frame: Box): boolean {
  return box.left >= frame.left && box.right <= frame.right && box.top >= frame.top && box.bottom <= frame.bottom;
}

export function overlap(one: Box, two: Box): number {
  const wide = Math.min(one.right, two.right) - Math.max(one.left, two.left);
  const high = Math.min(one.bottom, two.bottom) - Math.max(one.top, two.top);
  return wide > 0 && high > 0 ? wide * high : 0;
}
