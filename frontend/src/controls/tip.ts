// A hint beside what the pointer is on or the keyboard has reached. It adds nothing to the name and the
// description of the control, so screen readers are not told of it.
import type { Attachment } from "svelte/attachments";

const WAIT = 450; // ms until it shows under a pointer; at once for the keyboard
const AWAY = 6; // px

/** Show `text`, and the key that does the same, while the element is pointed at or focused by keyboard. */
export function tip(text: string, key = ""): Attachment<HTMLElement> {
  return (element) => {
    if (!text) return;
    let box: HTMLElement | null = null;
    let timer = 0;
    const hide = () => {
      clearTimeout(timer);
      box?.remove();
      box = null;
    };
    const show = () => {
      hide();
      box = make(element, text, key);
      place(box, element);
    };
    const enter = () => {
      clearTimeout(timer);
      timer = window.setTimeout(show, WAIT);
    };
    const focus = (event: FocusEvent) => {
      if ((event.target as Element).matches(":focus-visible:not(input)")) show();
    };
    const escape = (event: KeyboardEvent) => event.key === "Escape" && hide();
    const on: [string, EventListener][] = [
      ["pointerenter", enter],
      ["pointerleave", hide],
      ["pointerdown", hide],
      ["focusin", focus as EventListener],
      ["focusout", hide],
      ["keydown", escape as EventListener],
    ];
    for (const [name, listener] of on) element.addEventListener(name, listener);
    return () => {
      hide();
      for (const [name, listener] of on) element.removeEventListener(name, listener);
    };
  };
}

function make(near: HTMLElement, text: string, key: string): HTMLElement {
  const box = document.createElement("div");
  box.className = "tip";
  box.popover = "manual";
  box.setAttribute("aria-hidden", "true");
  box.textContent = text;
  if (key) {
    const kbd = document.createElement("kbd");
    kbd.textContent = key;
    box.append(kbd);
  }
  // Inside the themed part of the page, so that it takes the colours from there.
  (near.closest("[data-theme]:not(html)") ?? document.body).append(box);
  box.showPopover();
  return box;
}

function place(box: HTMLElement, element: HTMLElement): void {
  const at = element.getBoundingClientRect();
  const { width, height } = box.getBoundingClientRect();
  const above = at.bottom + AWAY + height > window.innerHeight;
  const left = Math.min(Math.max(at.left + at.width / 2 - width / 2, 4), window.innerWidth - width - 4);
  box.style.left = `${left}px`;
  box.style.top = `${above ? at.top - AWAY - height : at.bottom + AWAY}px`;
}
