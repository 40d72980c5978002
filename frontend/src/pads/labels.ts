// Words beside points so that none covers another: for each the freest of a few places around its point.

export interface Spot {
  x: number;
  y: number;
  text: string;
}

export interface Label extends Spot {
  /** Where the words stand: the left end and the middle of their height. */
  left: number;
  middle: number;
  width: number;
  /** Far enough from its point that a line has to say which one it belongs to. */
  far: boolean;
}

export interface Box {
  left: number;
  top: number;
  right: number;
  bottom: number;
}

const LETTER = 0.56; // mean width of a letter, in heights: a little more than most fonts need
const WAYS = 16;

/** Place the words within `frame`, `size` pixels high; `taken` are boxes to keep clear of. */
export function layout(
  spots: readonly Spot[], size: number, frame: Box, taken: readonly Box[] = [],
): Label[] {
  const dots = spots.map(({ x, y }) => around(x, y, 3));
  const boxes = [...taken];
  const out = new Map<Spot, Label>();
  for (const spot of crowdedFirst(spots)) {
    const width = spot.text.length * size * LETTER;
    let best: { cost: number; box: Box; far: boolean } | null = null;
    for (let ring = 0; ring < 7; ring++)
      for (let way = 0; way < WAYS; way++) {
        const box = candidate(spot, width, size, ring, way);
        const outside = area(box) - overlap(box, frame);
        const covered = boxes.reduce((sum, other) => sum + overlap(box, other), 0);
        const points = dots.reduce((sum, dot) => sum + overlap(box, dot), 0);
        // Sides before corners before above and below, near before far, but above all: nothing covered.
        const slant = Math.abs(Math.sin((2 * Math.PI * way) / WAYS));
        const cost = 200 * (outside + covered) + 60 * points + 8 * ring + 3 * slant;
        if (!best || cost < best.cost) best = { cost, box, far: ring > 1 };
      }
    boxes.push(best!.box);
    const { box, far } = best!;
    out.set(spot, { ...spot, left: box.left, middle: (box.top + box.bottom) / 2, width, far });
  }
  return spots.map((spot) => out.get(spot)!);
}

function candidate({ x, y }: Spot, width: number, size: number, ring: number, way: number): Box {
  const angle = (2 * Math.PI * way) / WAYS;
  const away = 5 + ring * size * 0.6;
  const cx = x + Math.cos(angle) * (away + width / 2);
  const cy = y + Math.sin(angle) * (away + size / 2);
  return { left: cx - width / 2, right: cx + width / 2, top: cy - size * 0.58, bottom: cy + size * 0.58 };
}

/** Points among many others have the fewest places to choose from. */
function crowdedFirst(spots: readonly Spot[]): Spot[] {
  const crowd = (spot: Spot) =>
    spots.reduce((sum, other) => sum + 1 / (20 + Math.hypot(spot.x - other.x, spot.y - other.y)), 0);
  return [...spots].sort((a, b) => crowd(b) - crowd(a));
}

function around(x: number, y: number, radius: number): Box {
  return { left: x - radius, right: x + radius, top: y - radius, bottom: y + radius };
}

function area(box: Box): number {
  return (box.right - box.left) * (box.bottom - box.top);
}

export function overlap(one: Box, two: Box): number {
  const wide = Math.min(one.right, two.right) - Math.max(one.left, two.left);
  const high = Math.min(one.bottom, two.bottom) - Math.max(one.top, two.top);
  return wide > 0 && high > 0 ? wide * high : 0;
}
