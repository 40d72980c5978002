// The nine motions of the square, as sources that the page blends between.
import type { Frames } from "../messages";
import type { Clip } from "../wire";

/** Rows of timing 0 to 2 (added acceleration first), columns of path 0 to 2. */
export type Nine = readonly (readonly Clip[])[];

/** Letters of the thesis's figure: it has constant speed at the top. */
const LETTERS = ["GHI", "DEF", "ABC"] as const;

/** The nine of an answer; what is not told of each is as in the original. */
export function nineOf(
  original: Clip,
  head: Frames,
  arrays: Record<string, Float32Array | Uint8Array>,
): Nine {
  return LETTERS.map((row) =>
    [...row].map((letter) => ({
      head: { ...original.head, moving: head.moving },
      rotations: arrays[`rotations_${letter}`] as Float32Array,
      translations: arrays[`translations_${letter}`] as Float32Array,
      offsets: original.offsets,
      contacts: original.contacts,
    })),
  );
}
