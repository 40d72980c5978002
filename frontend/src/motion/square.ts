// The square of nine: variants of one clip at the corners, the sides and the middle, and what lies between them.
import type { Frames } from "../messages";
import { unpack, type Clip } from "../wire";
import { blended, clipSource, latticeWeights, type PoseSource } from "./blend";

// Rows from added acceleration to constant speed, columns from short to long paths; E is the clip itself.
const LETTERS = ["G", "H", "I", "D", "E", "F", "A", "B", "C"];

/** The nine motions in the server's answer about `clip`, blended at any point from (0, 0) to (2, 2). */
export function squareOf(clip: Clip, answer: ArrayBuffer): (across: number, up: number) => PoseSource {
  const { head, arrays } = unpack<Frames>(answer);
  const nine = LETTERS.map((letter) =>
    clipSource({
      head,
      rotations: arrays[`rotations_${letter}`] as Float32Array,
      translations: arrays[`translations_${letter}`] as Float32Array,
      offsets: clip.offsets,
      contacts: clip.contacts,
    }),
  );
  return (across, up) => blended(latticeWeights(across, up).map((weight, i) => ({ source: nine[i], weight })));
}
