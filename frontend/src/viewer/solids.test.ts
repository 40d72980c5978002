import { describe, expect, it } from "vitest";
import { apart, clipOf, NAMES, truthOf } from "../motion/fixtures";
import { fk, newPose, newWorld, poseAt } from "../motion/pose";
import { solidsOf } from "./solids";

const TOLERANCE = 1e-4; // leg lengths

describe.each(NAMES)("%s", (name) => {
  const { head, ...arrays } = clipOf(name);
  const clip = { head, ...arrays };
  const truth = truthOf(name);
  const size = head.shape?.leg_length ?? 0.87 / head.metres;
  const poses = [...truth["frames"]].map((frame) => {
    const pose = poseAt(clip, frame, newPose(head.joints.length));
    return solidsOf(head, fk(pose, head.parents, newWorld(head.joints.length)));
  });

  it("has Python's cones", () => {
    expect(apart(poses.flatMap((p) => p.cones.flatMap((c) => c.start)), truth["starts"]) / size).toBeLessThan(TOLERANCE);
    expect(apart(poses.flatMap((p) => p.cones.flatMap((c) => c.end)), truth["ends"]) / size).toBeLessThan(TOLERANCE);
    const [start, end] = [0, 1].map((i) => poses[0].cones.map((cone) => cone.radii[i]));
    expect(apart(start, truth["start_radii"]) / size).toBeLessThan(TOLERANCE);
    expect(apart(end, truth["end_radii"]) / size).toBeLessThan(TOLERANCE);
  });

  it("has Python's ellipsoids", () => {
    const centres = poses.flatMap((p) => p.ellipsoids.flatMap((e) => e.centre));
    expect(apart(centres, truth["centres"]) / size).toBeLessThan(TOLERANCE);
    // Python's rows are components and its columns the half axes.
    const axes = poses.flatMap((p) =>
      p.ellipsoids.flatMap((e) => [0, 1, 2].flatMap((row) => e.axes.map((axis, k) => e.half[k] * axis[row]))),
    );
    expect(apart(axes, truth["axes"]) / size).toBeLessThan(TOLERANCE);
  });

  it("has Python's colours, and the same parts in every pose", () => {
    const colours = [...poses[0].cones, ...poses[0].ellipsoids].map((solid) => solid.colour);
    expect(colours).toEqual([...truth["colours"]]);
    for (const pose of poses) {
      expect(pose.cones.map((c) => c.part)).toEqual(poses[0].cones.map((c) => c.part));
      expect(pose.ellipsoids.map((e) => e.half)).toEqual(poses[0].ellipsoids.map((e) => e.half));
    }
  });
});
