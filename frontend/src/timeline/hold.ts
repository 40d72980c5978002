// Something held and dragged: the ways it goes, in pixels, slow with Alt or Shift; the rest is the caller's.
import type { Attachment } from "svelte/attachments";
import { Drag } from "../controls/steps";

export interface Held {
  /** Pixels from where it was taken. */
  move: (x: number, y: number) => void;
  end: () => void;
}

/** `take` is asked at each press; null: not to be held here, and the press goes on to what is behind. */
export function hold(take: (event: PointerEvent) => Held | null): Attachment<HTMLElement | SVGElement> {
  return (element) => {
    let held: Held | null = null;
    let moved = false; // a mere press is not a change
    let drag: Drag;
    const down = (event: PointerEvent) => {
      if (event.button !== 0 || !(held = take(event))) return;
      event.preventDefault();
      event.stopPropagation();
      element.focus({ preventScroll: true });
      drag = new Drag([0, 0], event);
      moved = false;
      element.setPointerCapture(event.pointerId);
    };
    const move = (event: PointerEvent) => {
      if (!held) return;
      moved = true;
      held.move(...drag.to(event, 1, 1));
    };
    const up = () => {
      if (moved) held?.end();
      held = null;
    };
    const on = Object.entries({ pointerdown: down, pointermove: move, pointerup: up, pointercancel: up });
    for (const [name, listener] of on) element.addEventListener(name, listener as EventListener);
    return () => {
      for (const [name, listener] of on) element.removeEventListener(name, listener as EventListener);
    };
  };
}
