import { expect, it } from "vitest";
import { apart, clipOf } from "./fixtures";
import { newPose } from "./pose";
import { squareOf } from "./square";

/** An answer with nine copies of the walk, each moved along by its letter's number. */
function answer(): ArrayBuffer {
  const { head, rotations, translations } = clipOf("walk");
  const arrays: { name: string; data: Float32Array }[] = [];
  [..."ABCDEFGHI"].forEach((letter, i) => {
    arrays.push({ name: `rotations_${letter}`, data: rotations });
    arrays.push({ name: `translations_${letter}`, data: translations.map((value) => value + i) });
  });
  let start = 0;
  const places = arrays.map(({ name, data }) => {
    const place = { name, type: "float32", start, shape: [data.length] };
    start += data.byteLength;
    return place;
  });
  const text = JSON.stringify({ ...head, arrays: places });
  const padded = new TextEncoder().encode(text.padEnd(4 * Math.ceil(text.length / 4)));
  const out = new Uint8Array(8 + padded.length + start);
  out.set(new TextEncoder().encode("MIEN"));
  new DataView(out.buffer).setUint32(4, padded.length, true);
  out.set(padded, 8);
  arrays.forEach(({ data }, i) => out.set(new Uint8Array(data.buffer, data.byteOffset, data.byteLength), 8 + padded.length + places[i].start));
  return out.buffer;
}

it("has short paths on the left, and constant speed above", () => {
  const clip = clipOf("walk");
  const at = squareOf(clip, answer());
  const moved = (across: number, up: number): number => {
    const joint = 3 * clip.head.moving[0];
    return at(across, up).pose(0, newPose(clip.head.joints.length)).translations[joint] - clip.translations[0];
  };
  const corners = [moved(0, 2), moved(2, 2), moved(1, 1), moved(0, 0), moved(2, 0)];
  expect(apart(corners, [0, 2, 4, 6, 8])).toBeLessThan(1e-4); // A, C, E, G, I
  expect(moved(0.5, 1.5)).toBeCloseTo((0 + 1 + 3 + 4) / 4, 4); // A, B, D, E
});
