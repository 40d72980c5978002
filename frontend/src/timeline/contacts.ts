// Which stretches a foot stands, from one number a frame and foot.
import type { View } from "./view";

/** (T, 2) one after the other, left then right; a frame stands where its number is at least one half. */
export interface Contacts {
  values: ArrayLike<number>;
  frameTime: number;
}

export interface Run {
  start: number;
  end: number;
}

/** The stretches in which a foot (0 left, 1 right) stands; a frame lasts until the next one. */
export function runs(contacts: Contacts, foot: 0 | 1): Run[] {
  const { values, frameTime } = contacts;
  const frames = Math.floor(values.length / 2);
  const found: Run[] = [];
  let start = -1;
  for (let i = 0; i <= frames; i++) {
    const stands = i < frames && values[2 * i + foot] >= 0.5;
    if (stands && start < 0) start = i;
    if (stands || start < 0) continue;
    found.push({ start: start * frameTime, end: Math.min(i, frames - 1) * frameTime });
    start = -1;
  }
  return found;
}

/** The runs in view; those that would touch within a pixel are drawn as one. */
export function inView(found: Run[], view: View, width: number): Run[] {
  const pixel = (view.end - view.start) / Math.max(width, 1);
  const out: Run[] = [];
  for (const run of found) {
    if (run.end < view.start || run.start > view.end) continue;
    const last = out.at(-1);
    if (last && run.start - last.end < pixel) last.end = run.end;
    else out.push({ ...run });
  }
  return out;
}

/** The path of bars over runs, `top` to `bottom` pixels; none thinner than a pixel. */
export function bars(found: Run[], px: (time: number) => number, top: number, bottom: number): string {
  return found
    .map(({ start, end }) => {
      const left = px(start).toFixed(1);
      return `M${left} ${top}h${Math.max(px(end) - px(start), 1).toFixed(1)}V${bottom}H${left}Z`;
    })
    .join("");
}
