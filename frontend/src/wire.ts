// Binary answers of the server: "MIEN", the length of the head, the head in JSON, then its arrays
// (src/mien/render/wire.py writes them).
import type { Frames } from "./messages";

/** A motion as the page holds it: its head, and its arrays by name. */
export interface Clip {
  head: Frames;
  /** (T, J, 4) from child to parent, xyzw. */
  rotations: Float32Array;
  /** (T, M, 3) of the moving joints, from the parent. */
  translations: Float32Array;
  /** (J, 3) of all joints, from the parent. */
  offsets: Float32Array;
  /** (T, 2) left and right foot: 1 while it stands. */
  contacts: Uint8Array;
}

const MAGIC = 0x4e45494d; // "MIEN", little-endian

/** Return the head and the arrays of a binary answer; throws where it is none. */
export function unpack<Head extends { arrays: Frames["arrays"] }>(
  data: ArrayBuffer,
): { head: Head; arrays: Record<string, Float32Array | Uint8Array> } {
  const view = new DataView(data);
  if (data.byteLength < 8 || view.getUint32(0, true) !== MAGIC) throw new Error("this is no answer of mien");
  const length = view.getUint32(4, true);
  const head = JSON.parse(new TextDecoder().decode(new Uint8Array(data, 8, length))) as Head;
  const arrays: Record<string, Float32Array | Uint8Array> = {};
  for (const { name, type, start, shape } of head.arrays) {
    const count = shape.reduce((product, size) => product * size, 1);
    const at = 8 + length + start;
    arrays[name] = type === "uint8" ? new Uint8Array(data, at, count) : new Float32Array(data, at, count);
  }
  return { head, arrays };
}

/** Return the motion in a binary answer. */
export function decode(data: ArrayBuffer): Clip {
  const { head, arrays } = unpack<Frames>(data);
  return {
    head,
    rotations: arrays["rotations"] as Float32Array,
    translations: arrays["translations"] as Float32Array,
    offsets: arrays["offsets"] as Float32Array,
    contacts: arrays["contacts"] as Uint8Array,
  };
}
