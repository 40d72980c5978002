// Numbers as a person types and reads them.

/** How many decimals a step needs: 0.05 has 2. */
export function decimals(step: number): number {
  for (let digits = 0; digits < 6; digits++) {
    const scaled = step * 10 ** digits;
    if (Math.abs(scaled - Math.round(scaled)) < 1e-6 * Math.max(1, scaled)) return digits;
  }
  return 6;
}

/** With the decimals of the step; a value between two steps is not rounded away, but shown to 1 % of one. */
export function format(value: number, step: number): string {
  const digits = decimals(step);
  const plain = value.toFixed(digits);
  const exact = value.toFixed(digits + 2).replace(/\.?0+$/, "");
  const text = Math.abs(Number(plain) - Number(exact)) < 1e-9 ? plain : exact;
  return Number(text) === 0 ? (0).toFixed(digits) : text;
}

/** The same with a true minus sign, for text that is only read. */
export function shown(value: number, digits = 2): string {
  const text = value.toFixed(digits);
  return Number(text) === 0 ? (0).toFixed(digits) : text.replace("-", "−");
}

/** What was typed, or null: a decimal comma, a true minus sign and the unit behind it are understood. */
export function parse(text: string, unit = ""): number | null {
  let plain = text.trim();
  for (const suffix of [unit, shortUnit(unit)])
    if (suffix && plain.toLowerCase().endsWith(suffix.toLowerCase())) plain = plain.slice(0, -suffix.length);
  plain = plain.trim().replace("−", "-").replace(",", ".");
  return /^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i.test(plain) ? Number(plain) : null;
}

/** Why a typed value is not taken, or "" where it is. Nothing is moved into the range behind one's back. */
export function refusal(value: number | null, low: number | null, high: number | null, unit = ""): string {
  if (value === null || !Number.isFinite(value)) return "Not a number.";
  const outside = (low !== null && value < low) || (high !== null && value > high);
  if (!outside) return "";
  const of = unit ? ` ${unit}` : "";
  if (low === null) return `At most ${tidy(high!)}${of}.`;
  if (high === null) return `At least ${tidy(low)}${of}.`;
  return `From ${tidy(low)} to ${tidy(high)}${of}.`;
}

/** A number of a range in words: short, with a true minus sign. */
export function tidy(value: number): string {
  return String(Number(value.toPrecision(6))).replace("-", "−");
}

const SHORT: Record<string, string> = {
  degrees: "°",
  seconds: "s",
  "leg lengths": "leg",
  "frames a second": "fps",
  percent: "%",
  "m/s2": "m/s²",
  "x strength": "× strength",
};

/** A unit as short as a number field has room for. */
export function shortUnit(unit: string): string {
  return SHORT[unit] ?? unit;
}

/** A step for a range where none is told: 1, 2 or 5 of a power of ten, about a hundredth of the range. */
export function stepOf(low: number, high: number): number {
  const rough = (high - low) / 100;
  const power = 10 ** Math.floor(Math.log10(rough) + 1e-9);
  const lead = rough / power;
  const step = (lead >= 5 ? 5 : lead >= 2 ? 2 : 1) * power;
  return Number(step.toPrecision(1));
}
