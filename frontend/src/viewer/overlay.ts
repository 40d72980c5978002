// What stands on the picture as text: which figure is which, the scale, names of joints, and the handle of the wipe.
// Styled by properties, not by style texts, so that a page may forbid those.
import { clamp } from "../playback";
import type { Theme } from "./stage";

interface Name {
  text: string;
  x: number;
  y: number;
  strong: boolean;
}

type Style = Partial<Record<"position" | "left" | "right" | "top" | "bottom" | "width" | "height" | "font" | "color"
  | "background" | "padding" | "borderRadius" | "pointerEvents" | "transform" | "whiteSpace" | "border" | "cursor"
  | "inset" | "overflow" | "display" | "textAlign" | "touchAction" | "opacity"
  | "textShadow", string>>;

const FONT = "12px/1.4 system-ui, sans-serif";
const BARS = [0.1, 0.25, 0.5, 1, 2, 5, 10]; // metres

export class Overlay {
  #root: HTMLElement;
  #sides: [HTMLElement, HTMLElement];
  #bar: HTMLElement;
  #handle: HTMLElement;
  #message: HTMLElement;
  #names: HTMLElement[] = [];
  #halo = "";
  #colour = "";

  constructor(host: HTMLElement, onWipe: (share: number) => void) {
    this.#root = made(host, { position: "absolute", inset: "0", overflow: "hidden", pointerEvents: "none", font: FONT });
    this.#sides = [made(this.#root, LABEL), made(this.#root, LABEL)];
    this.#bar = made(this.#root, {
      position: "absolute", right: "12px", bottom: "10px", textAlign: "center", height: "20px",
      border: "solid currentColor",
    });
    this.#bar.style.borderWidth = "0 1px 2px 1px";
    this.#bar.style.opacity = "0.65";
    this.#message = made(this.#root, { ...LABEL, left: "50%", top: "50%", transform: "translate(-50%, -50%)" });
    this.#message.role = "status";
    this.#handle = this.#wipe(onWipe);
    this.say("");
  }

  set theme(theme: Theme) {
    this.#colour = theme === "dark" ? "#d7dde4" : "#2b3238";
    this.#root.style.color = this.#colour;
    const paper = theme === "dark" ? "rgb(20 23 27 / 72%)" : "rgb(255 255 255 / 78%)";
    for (const element of [...this.#sides, this.#message]) element.style.background = paper;
    this.#halo = halo(theme === "dark" ? "#14171b" : "#ffffff");
    for (const element of this.#names) element.style.textShadow = this.#halo;
  }

  /** Name the left and the right of the picture; nothing where there is one figure. */
  name(left: string, right: string, at: number): void {
    this.#sides[0].textContent = left;
    this.#sides[1].textContent = right;
    this.#sides.forEach((side) => show(side, Boolean(side.textContent)));
    this.#sides[0].style.left = "10px";
    this.#sides[1].style.left = `calc(${100 * at}% + 10px)`;
  }

  /** Show the handle of the wipe at a share of the width, or none. */
  wipe(share: number | null): void {
    show(this.#handle, share !== null);
    if (share === null) return;
    this.#handle.style.left = `calc(${100 * share}% - 9px)`;
    this.#handle.ariaValueNow = String(Math.round(100 * share));
  }

  /** Show how long a metre is, or what of it is handy, where a metre is `pixels` long. */
  scale(pixels: number): void {
    const metres = BARS.find((length) => length * pixels >= 54) ?? BARS[BARS.length - 1];
    this.#bar.textContent = `${metres} m`;
    this.#bar.style.width = `${metres * pixels}px`;
    show(this.#bar, metres * pixels < 400);
  }

  /** Put names at places of the picture, those asked to be strong first; what would cover another is left out. */
  names(all: readonly Name[]): void {
    const names = apart([...all].sort((a, b) => Number(b.strong) - Number(a.strong)));
    while (this.#names.length < names.length) this.#names.push(made(this.#root, { ...NAME, textShadow: this.#halo }));
    this.#names.forEach((element, i) => {
      show(element, i < names.length);
      if (i >= names.length) return;
      const { text, x, y, strong } = names[i];
      element.textContent = text;
      element.style.transform = `translate(${x + 9}px, ${y - 9}px)`;
      element.style.fontWeight = strong ? "600" : "400";
    });
  }

  say(message: string): void {
    this.#message.textContent = message;
    show(this.#message, Boolean(message));
  }

  dispose(): void {
    this.#root.remove();
  }

  #wipe(onWipe: (share: number) => void): HTMLElement {
    const handle = made(this.#root, {
      position: "absolute", top: "0", bottom: "0", width: "18px", cursor: "ew-resize", pointerEvents: "auto",
      touchAction: "none", background: "linear-gradient(90deg, transparent 8px, currentColor 8px 10px, transparent 10px)",
      opacity: "0.7",
    });
    handle.role = "slider";
    handle.tabIndex = 0;
    handle.ariaLabel = "Share of the original";
    handle.ariaValueMin = "0";
    handle.ariaValueMax = "100";
    const share = (): number => Number(handle.ariaValueNow ?? 50) / 100;
    handle.addEventListener("pointerdown", (event) => handle.setPointerCapture(event.pointerId));
    handle.addEventListener("pointermove", (event) => {
      if (!handle.hasPointerCapture(event.pointerId)) return;
      const box = this.#root.getBoundingClientRect();
      onWipe(clamp((event.clientX - box.left) / box.width, 0.02, 0.98));
    });
    handle.addEventListener("keydown", (event) => {
      const steps: Record<string, number> = { ArrowLeft: -0.02, ArrowDown: -0.02, ArrowRight: 0.02, ArrowUp: 0.02 };
      const step = steps[event.key];
      if (step === undefined) return;
      event.preventDefault();
      event.stopPropagation();
      onWipe(clamp(share() + step, 0.02, 0.98));
    });
    return handle;
  }
}

/** Leave out names that would cover one before them. */
export function apart<One extends Pick<Name, "text" | "x" | "y">>(names: readonly One[]): One[] {
  const kept: One[] = [];
  for (const one of names) {
    const covers = kept.some(({ text, x, y }) =>
      Math.abs(y - one.y) < LINE && one.x < x + LETTER * text.length && x < one.x + LETTER * one.text.length);
    if (!covers) kept.push(one);
  }
  return kept;
}

/** Shadows all around, so that letters are read over the figure as over the floor. */
function halo(colour: string): string {
  const around = [[-1, -1], [0, -1.5], [1, -1], [1.5, 0], [1, 1], [0, 1.5], [-1, 1], [-1.5, 0]];
  return [...around.map(([x, y]) => `${x}px ${y}px 1px ${colour}`), `0 0 4px ${colour}`].join(", ");
}

const LETTER = 7.2; // pixels, a little more than the mean
const LINE = 17; // pixels, as high as a line of FONT
const LABEL: Style = {
  position: "absolute", top: "10px", padding: "2px 8px", borderRadius: "4px", whiteSpace: "nowrap",
};
const NAME: Style = { position: "absolute", left: "0", top: "0", whiteSpace: "nowrap" };

function made(parent: HTMLElement, style: Style): HTMLElement {
  const element = document.createElement("div");
  Object.assign(element.style, style);
  parent.append(element);
  return element;
}

function show(element: HTMLElement, shown: boolean): void {
  element.style.display = shown ? "" : "none";
}
