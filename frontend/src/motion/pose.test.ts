import { describe, expect, it } from "vitest";
import { apart, clipOf, NAMES, truthOf } from "./fixtures";
import { fk, newPose, newWorld, poseAt } from "./pose";

const TOLERANCE = 1e-4; // metres

describe.each(NAMES)("%s", (name) => {
  const clip = clipOf(name);
  const truth = truthOf(name);
  const joints = clip.head.joints.length;
  const pose = newPose(joints);
  const world = newWorld(joints);
  const at = (frame: number) => fk(poseAt(clip, frame, pose), clip.head.parents, world);

  it("puts the joints where Python puts them", () => {
    truth["frames"].forEach((frame, i) => {
      const { positions, rotations } = at(frame);
      const there = truth["positions"].subarray(3 * joints * i, 3 * joints * (i + 1));
      const turned = truth["rotations"].subarray(4 * joints * i, 4 * joints * (i + 1));
      expect(apart(positions, there) * clip.head.metres).toBeLessThan(TOLERANCE);
      expect(apart(rotations, turned)).toBeLessThan(1e-5);
    });
  });

  it("meets Python half-way between frames", () => {
    truth["frames"].forEach((frame, i) => {
      const there = truth["between"].subarray(3 * joints * i, 3 * joints * (i + 1));
      expect(apart(at(frame + 0.5).positions, there) * clip.head.metres).toBeLessThan(TOLERANCE);
    });
  });

  it("holds the first and the last frame", () => {
    const first = [...at(0).positions];
    expect(apart(at(-3).positions, first)).toBe(0);
    const last = [...at(clip.head.frames - 1).positions];
    expect(apart(at(1e6).positions, last)).toBe(0);
  });
});
