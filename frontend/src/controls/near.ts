// What is about to be used can be got ready: told when a pointer rests on something, or the focus comes to it.
import type { Attachment } from "svelte/attachments";

const REST = 120; // ms: a pointer that only passes is not about to use it

/** Call `ready` when a pointer has come to rest on the element, presses it, or the focus comes into it. */
export function near(ready: () => void): Attachment<HTMLElement> {
  return (element) => {
    let timer = 0;
    const leave = () => clearTimeout(timer);
    const enter = () => {
      leave();
      timer = window.setTimeout(ready, REST);
    };
    const now = () => {
      leave();
      ready();
    };
    const on: [string, () => void][] = [
      ["pointerenter", enter],
      ["pointerleave", leave],
      ["pointerdown", now],
      ["focusin", now],
    ];
    for (const [name, listener] of on) element.addEventListener(name, listener);
    return () => {
      leave();
      for (const [name, listener] of on) element.removeEventListener(name, listener);
    };
  };
}
