// What keys and slow dragging do to a value in a range: the same for sliders, pads and keys of curves.

export interface Range {
  low: number;
  high: number;
  step: number;
}

export const SLOW = 0.2; // Shift with arrows, Shift or Alt while dragging
const MANY = 10; // PageUp, PageDown

export function within(value: number, low: number, high: number): number {
  return Math.min(Math.max(value, low), high);
}

/** The nearest value on a step counted from zero, so that round numbers are met whatever the range. */
export function snap(value: number, { low, high, step }: Range): number {
  const near = Math.round(value / step) * step;
  return within(Number(near.toPrecision(12)), low, high);
}

/** The value after a key, or null where the key means nothing here. */
export function stepped(key: string, shift: boolean, value: number, range: Range): number | null {
  const by = range.step * (shift ? SLOW : 1);
  const moved = (steps: number) =>
    within(Number((value + steps * by).toPrecision(12)), range.low, range.high);
  switch (key) {
    case "ArrowRight":
    case "ArrowUp":
      return moved(1);
    case "ArrowLeft":
    case "ArrowDown":
      return moved(-1);
    case "PageUp":
      return moved(MANY);
    case "PageDown":
      return moved(-MANY);
    case "Home":
      return range.low;
    case "End":
      return range.high;
    default:
      return null;
  }
}

/** A drag that can be slowed at any moment: it adds up ways, not places. */
export class Drag {
  #x: number;
  #y: number;
  #lastX: number;
  #lastY: number;

  /** Begin at a place, in units of the thing dragged; the pointer is at `clientX`, `clientY`. */
  constructor(place: readonly [number, number], event: { clientX: number; clientY: number }) {
    [this.#x, this.#y] = place;
    this.#lastX = event.clientX;
    this.#lastY = event.clientY;
  }

  /** The place now; `perX`, `perY`: units a pixel. Held in no range, so that the hand finds its way back. */
  to(
    event: { clientX: number; clientY: number; altKey: boolean; shiftKey: boolean },
    perX: number,
    perY: number,
  ): [number, number] {
    const slow = event.altKey || event.shiftKey ? SLOW : 1;
    this.#x += (event.clientX - this.#lastX) * perX * slow;
    this.#y += (event.clientY - this.#lastY) * perY * slow;
    this.#lastX = event.clientX;
    this.#lastY = event.clientY;
    return [this.#x, this.#y];
  }
}
