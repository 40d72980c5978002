// Which control a parameter gets.
import type { ParameterInfo } from "../messages";

const WIDEST = 1000; // a range wider than this is better typed than dragged

/** Whether a value is a curve through keys and not one number. */
export function isCurve(value: ParameterInfo["default"]): value is number[][] {
  return Array.isArray(value) && value.length > 0 && Array.isArray(value[0]);
}

/** A slider needs both ends, and cannot say "none". */
export function hasSlider(info: ParameterInfo): boolean {
  const { low, high } = info;
  return !info.optional && low !== null && high !== null && high > low && high - low <= WIDEST;
}
