// Which stretch of time is to be seen, and where in it a moment stands.

export interface View {
  readonly start: number;
  readonly end: number;
}

const CLOSEST = 8; // frames that are seen when nearest
const MARGIN = 0.015; // of the width, so that first and last frame can be grasped

/** All of a clip, with a little room at both ends. */
export function all(duration: number): View {
  const room = Math.max(duration, 0.01) * MARGIN;
  return { start: -room, end: Math.max(duration, 0.01) + room };
}

export function toPixel(time: number, view: View, width: number): number {
  return ((time - view.start) / (view.end - view.start)) * width;
}

export function toTime(pixel: number, view: View, width: number): number {
  return view.start + (pixel / Math.max(width, 1)) * (view.end - view.start);
}

/** Zoom by `factor` (below 1: nearer) so that the moment `at` stays where it is. */
export function zoom(view: View, factor: number, at: number, duration: number, frameTime: number): View {
  const whole = all(duration);
  const least = Math.min(CLOSEST * frameTime, whole.end - whole.start);
  const length = Math.min(Math.max((view.end - view.start) * factor, least), whole.end - whole.start);
  const share = (at - view.start) / (view.end - view.start);
  return held({ start: at - share * length, end: at + (1 - share) * length }, duration);
}

/** Move by seconds, not beyond the clip. */
export function pan(view: View, by: number, duration: number): View {
  return held({ start: view.start + by, end: view.end + by }, duration);
}

/** Turn the page so that a moment is seen; the same view where it is already. */
export function follow(view: View, time: number, duration: number): View {
  if (time >= view.start && time <= view.end) return view;
  const length = view.end - view.start;
  return held({ start: time - 0.05 * length, end: time + 0.95 * length }, duration);
}

function held(view: View, duration: number): View {
  const whole = all(duration);
  const length = Math.min(view.end - view.start, whole.end - whole.start);
  if (length > whole.end - whole.start - 1e-9) return whole;
  const start = Math.min(Math.max(view.start, whole.start), whole.end - length);
  return { start, end: start + length };
}

export interface Tick {
  time: number;
  major: boolean;
}

const STEPS = [0.001, 0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 30, 60, 120, 300, 600];

/** Ticks of a ruler: the step between those with words, and all of them, five or so to a word. */
export function ticks(
  view: View, width: number, duration: number, apart = 64,
): { step: number; ticks: Tick[] } {
  const rough = ((view.end - view.start) / Math.max(width, 1)) * apart;
  const step = STEPS.find((one) => one >= rough) ?? STEPS.at(-1)!;
  const lead = Number(String(step).replace(/[0.]/g, "")[0]);
  const parts = lead === 2 ? 4 : lead === 3 || lead === 6 ? 6 : 5;
  const fine = step / parts;
  const found: Tick[] = [];
  const last = Math.floor(Math.min(view.end, duration) / fine + 1e-9);
  for (let i = Math.max(Math.ceil(view.start / fine), 0); i <= last; i++)
    found.push({ time: i * fine, major: i % parts === 0 });
  return { step, ticks: found };
}
