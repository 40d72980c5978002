// What can be read and seen, by the numbers of WCAG 2: text at least 4.5:1, marks and edges at least 3:1.
import { describe, expect, it } from "vitest";
import css from "./theme.css?raw";

type Colour = readonly [red: number, green: number, blue: number, opacity: number];

function colours(selector: string): Record<string, Colour> {
  const body = css.slice(css.indexOf("{", css.indexOf(selector)), css.indexOf("}", css.indexOf(selector)));
  const found = [...body.matchAll(/--([\w-]+): #([0-9a-f]{6})([0-9a-f]{2})?;/g)];
  const part = (hex: string, i: number) => parseInt(hex.slice(2 * i, 2 * i + 2), 16) / 255;
  return Object.fromEntries(
    found.map(([, name, hex, alpha]) => [
      name, [part(hex, 0), part(hex, 1), part(hex, 2), alpha ? part(alpha, 0) : 1],
    ]),
  );
}

function over(top: Colour, below: Colour): Colour {
  const mixed = (i: 0 | 1 | 2) => top[i] * top[3] + below[i] * (1 - top[3]);
  return [mixed(0), mixed(1), mixed(2), 1];
}

function contrast(one: Colour, two: Colour): number {
  const light = (colour: Colour) => {
    const [r, g, b] = colour.map((c) => (c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4));
    return 0.2126 * r + 0.7152 * g + 0.0722 * b + 0.05;
  };
  return Math.max(light(one), light(two)) / Math.min(light(one), light(two));
}

const GROUNDS = ["ground", "panel", "raised", "field"];
const TEXTS = ["text", "muted"]; // on every ground
const ON_PANEL = ["bad", "good", "warn", "left", "right", "after", "asked", "reached", "accent"];
const MARKS = [
  "edge", "accent", "focus", "read", "asked", "reached", "before", "after", "left", "right", "bad",
];
const TINTS = ["unpleasant-intense", "pleasant-intense", "pleasant-calm", "unpleasant-calm"];

describe.each([["dark", '[data-theme="dark"]'], ["light", '[data-theme="light"]']])("%s", (_, selector) => {
  const at = colours(selector);
  const least = (one: string, two: string, ratio: number) =>
    expect(contrast(at[one], at[two]), `${one} on ${two}`).toBeGreaterThanOrEqual(ratio);

  it("text is read on every ground", () => {
    for (const ground of GROUNDS) for (const text of TEXTS) least(text, ground, 4.5);
    for (const text of ON_PANEL) least(text, "panel", 4.5);
    least("on-accent", "accent", 4.5);
    least("text", "accent-soft", 4.5);
  });
  it("marks and edges are seen", () => {
    for (const ground of ["ground", "panel", "field"]) for (const mark of MARKS) least(mark, ground, 3);
  });
  it("words and markers are seen on the quadrants of the disc", () => {
    for (const tint of TINTS) {
      const quadrant = over(at[`tint-${tint}`], at.panel);
      for (const mark of ["read", "asked", "reached"])
        expect(contrast(at[mark], quadrant), `${mark} on ${tint}`).toBeGreaterThanOrEqual(3);
      for (const text of ["text", "asked"])
        expect(contrast(at[text], quadrant), `${text} on ${tint}`).toBeGreaterThanOrEqual(4.5);
    }
  });
});
