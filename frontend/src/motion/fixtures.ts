// Reads what scripts/frontend_fixtures.py wrote; for tests only.
import { decode, unpack, type Clip } from "../wire";
import { fromBase64 } from "./base64";

export const NAMES = ["walk", "wave", "jump", "turn", "tail"] as const;

const FILES = import.meta.glob<string>("./fixtures/*.bin", { query: "?url&inline", import: "default", eager: true });

/** A file of the fixtures. */
export function bytes(name: string): ArrayBuffer {
  const url = FILES[`./fixtures/${name}`];
  return fromBase64(url.slice(url.indexOf(",") + 1));
}

export const clipOf = (name: string): Clip => decode(bytes(`${name}.clip.bin`));

/** What Python found: `frames` looked at, and arrays with one row for each of them. */
export function truthOf(name: string): Record<string, Float32Array> {
  return unpack(bytes(`${name}.truth.bin`)).arrays as Record<string, Float32Array>;
}

/** The largest difference between two lists of numbers. */
export function apart(one: ArrayLike<number>, other: ArrayLike<number>): number {
  if (one.length !== other.length) return Infinity;
  let most = 0;
  for (let i = 0; i < one.length; i++) most = Math.max(most, Math.abs(one[i] - other[i]));
  return most;
}
