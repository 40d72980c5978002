// Moving a layer's stretch of time, and the shape of how it comes and goes.

export type Grip = "start" | "end" | "body" | "ease";

export interface Timed {
  span: number[] | null;
  ease: number;
}

/** Move one grip to a moment (`body`: by seconds). Both ends at those of the clip: null, all of it. */
export function moved(now: Timed, grip: Grip, to: number, duration: number, least: number): Timed {
  let [start, end] = now.span ?? [0, duration];
  let ease = now.ease;
  if (grip === "start") start = clamp(to, 0, end - least);
  else if (grip === "end") end = clamp(to, start + least, duration);
  else if (grip === "ease") ease = clamp(to - start, 0, Math.max((end - start) / 2, 0));
  else {
    const by = clamp(to, -start, duration - end);
    start += by;
    end += by;
  }
  const whole = start <= 1e-9 && end >= duration - 1e-9;
  return { span: whole ? null : [round(start), round(end)], ease: round(ease) };
}

/** The outline of a bar with its slopes, in pixels: a layer without a span has none. */
export function outline(left: number, right: number, slope: number, top: number, bottom: number): string {
  const wide = Math.min(slope, (right - left) / 2);
  return `M${left} ${bottom}L${left + wide} ${top}L${right - wide} ${top}L${right} ${bottom}Z`;
}

/** The nearest frame, so that spans begin where something is to be seen. */
export function onFrame(time: number, frameTime: number): number {
  return Math.round(time / frameTime) * frameTime;
}

function clamp(value: number, low: number, high: number): number {
  return Math.min(Math.max(value, low), Math.max(high, low));
}

function round(seconds: number): number {
  return Number(seconds.toFixed(4));
}
