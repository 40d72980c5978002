import { describe, expect, it } from "vitest";
import { blended, clipSource, latticeWeights } from "./blend";
import { apart, clipOf } from "./fixtures";
import { newPose, normalise } from "./pose";

const walk = clipSource(clipOf("walk"));
const joints = walk.head.joints.length;

/** The walk, a time later and with the opposite sign of every quaternion. */
const later = {
  ...walk,
  pose: (seconds: number, out: ReturnType<typeof newPose>) => {
    walk.pose(seconds + 0.125, out);
    out.rotations.forEach((value, i) => (out.rotations[i] = -value));
    return out;
  },
};

describe("blended", () => {
  it("gives each motion back at its corner", () => {
    const mixed = blended([{ source: walk, weight: 1 }, { source: later, weight: 0 }]);
    expect(apart(mixed.pose(0.3, newPose(joints)).rotations, walk.pose(0.3, newPose(joints)).rotations)).toBe(0);
  });

  it("meets half-way, whatever the sign of a quaternion", () => {
    const mixed = blended([{ source: walk, weight: 2 }, { source: later, weight: 2 }]);
    const there = mixed.pose(0.25, newPose(joints));
    const expected = walk.pose(0.3125, newPose(joints));
    expect(apart(there.translations, expected.translations)).toBeLessThan(1e-9);
    for (let i = 0; i < 4 * joints; i += 4) {
      const sign = Math.sign(there.rotations[i + 3] * expected.rotations[i + 3]);
      for (let k = 0; k < 4; k++) {
        expect(there.rotations[i + k]).toBeCloseTo(sign * expected.rotations[i + k], 4);
      }
    }
  });

  it("goes beyond a motion with a weight above 1", () => {
    const beyond = blended([{ source: walk, weight: -0.5 }, { source: later, weight: 1.5 }]).pose(0.25, newPose(joints));
    const here = walk.pose(0.25, newPose(joints)).translations;
    const there = walk.pose(0.375, newPose(joints)).translations;
    const expected = there.map((value, i) => 1.5 * value - 0.5 * here[i]);
    expect(apart(beyond.translations, expected)).toBeLessThan(1e-9);
  });

  it("takes the mean duration, and meets motions at the same share of it", () => {
    const slow = { ...walk, duration: 2 * walk.duration, pose: (t: number, out: ReturnType<typeof newPose>) =>
      walk.pose(t / 2, out) };
    const mixed = blended([{ source: walk, weight: 1 }, { source: slow, weight: 1 }]);
    expect(mixed.duration).toBeCloseTo(1.5 * walk.duration);
    const end = mixed.pose(mixed.duration, newPose(joints));
    expect(apart(end.translations, walk.pose(walk.duration, newPose(joints)).translations)).toBeLessThan(1e-9);
  });

  it("refuses weights without a sum, and other skeletons", () => {
    expect(() => blended([])).toThrow();
    expect(() => blended([{ source: walk, weight: 0 }])).toThrow();
    const other = clipSource(clipOf("jump"));
    expect(() => blended([{ source: walk, weight: 1 }, { source: other, weight: 1 }])).toThrow();
  });

  it("blends nine motions of thirty joints in less than a millisecond", () => {
    const other = clipSource(clipOf("wave")); // 31 joints
    const nine = blended(Array.from({ length: 9 }, () => ({ source: other, weight: 1 })));
    const out = newPose(other.head.joints.length);
    for (let i = 0; i < 200; i++) nine.pose(i / 200, out);
    const start = performance.now();
    for (let i = 0; i < 200; i++) nine.pose(i / 200, out);
    expect((performance.now() - start) / 200).toBeLessThan(1);
  });
});

describe("latticeWeights", () => {
  it("are bilinear with a sum of 1", () => {
    expect(latticeWeights(1, 1)).toEqual([0, 0, 0, 0, 1, 0, 0, 0, 0]);
    expect(latticeWeights(1.5, 0)).toEqual([0, 0.5, 0.5, 0, 0, 0, 0, 0, 0]);
    expect(latticeWeights(0.3, 1.8).reduce((a, b) => a + b)).toBeCloseTo(1);
  });
});

it("a quaternion that is nothing becomes no turn", () => {
  const q = new Float64Array(4);
  normalise(q, 0);
  expect([...q]).toEqual([0, 0, 0, 1]);
});
