"""Inverse kinematics: the clip solver beside mink (MuJoCo), from the same poses to the same targets.

Run: python benchmarks/ik.py [--frames 1000] [--runs 3] [--alone]

A synthetic walk is to pass through where joints are in another motion on the same skeleton, to a millimetre.
``ms``: median over the runs of the time a frame; ``ratio``: of that to ours; ``steps``: linear systems solved
for a frame; ``mean`` and ``max``: the error of the worst target of a frame, mm; ``over``: the share of frames
above 1 mm; ``move``: the furthest that a joint goes from one frame to the next, mm, and ``asked``: how far
one goes in the motion that the targets are from. Ours takes the whole clip at once, from the clip's own
poses. mink goes frame by frame, from the pose found before ("follows") or from the clip's pose as ours does.
One thread for both.

mink is not needed: without it our rows are printed alone. To have it: pip install "mink>=1.3,<2"
"""

import argparse
import os
import time
from dataclasses import dataclass
from types import SimpleNamespace

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import numpy as np
from scipy.ndimage import gaussian_filter1d

from mien import samples
from mien.kinematics import descent
from mien.kinematics.body import Body
from mien.kinematics.constraints import AtPosition, Point
from mien.kinematics.fk import fk, world
from mien.kinematics.solver import solve
from mien.rotations import quaternion

try:
    import mink
    import mujoco
except ImportError:
    mink = mujoco = None

ROLES = ("head", "chest", *(f"{side}_{j}" for side in ("left", "right") for j in ("wrist", "ankle", "knee")))
TOLERANCE = 0.001  # metres: clips are made in metres
# Of mink's dampings 0 and 0.01 to 1 (of the squared errors), and 1e-8 to 1e-2 (always), these were tried: as
# quick as any where targets are reached, and the only ones that come close where they are not.
OF_ERRORS, ALWAYS = 1.0, 1e-6
STEPS = 24  # mink is given as many as ours, and gives up where ours would
WANDER = 0.15  # radians: how far each joint is turned away, root mean square


@dataclass(frozen=True)
class Case:
    name: str
    skeleton: str = "standard22"
    sudden: bool = False  # targets of one frame have nothing to do with those of the next
    stretch: float = 1.0  # targets are moved away from the hips by this factor
    targets: int = len(ROLES)
    limits: bool = False


CASES = (
    Case("8 targets that move smoothly"),
    Case("8 targets, each frame another pose", sudden=True),
    Case("8 targets, 10 % out of reach", stretch=1.1),
    Case("8 targets, 50 % out of reach", stretch=1.5),
    Case("18 targets", targets=18),
    Case("43 joints, 8 targets", skeleton="poser43"),
    Case("8 targets, every joint limited", limits=True),
)


def problem(case, frames):
    """Return the clip, the joints with targets, the targets (T, K, 3), limits (J,), and how far joints go."""
    motion = samples.walk(seconds=(frames - 1) / 60.0, fps=60.0, skeleton=case.skeleton, unit="m").motion
    body, joints = Body.of(motion), len(motion.skeleton)
    noise = np.random.default_rng(1).normal(size=(frames, joints, 3))
    if not case.sudden:
        noise = gaussian_filter1d(noise, 10.0, axis=0, mode="wrap")
    turned = quaternion.multiply(motion.rotations, quaternion.exp(noise * WANDER / noise.std()))
    other = motion.with_(rotations=turned)
    chosen = [body.roles[r] for r in ROLES]
    chosen += [j for j in range(joints) if j not in chosen][joints - case.targets :]
    places = world(other)[1]
    hips = places[:, [body.roles["hips"]]]
    largest = [np.linalg.norm(quaternion.log(m.rotations), axis=-1).max(axis=0) for m in (motion, other)]
    return SimpleNamespace(
        motion=motion,
        body=body,
        chosen=chosen,
        targets=(hips + case.stretch * (places - hips))[:, chosen],
        widest=1.001 * np.max(largest, axis=0) if case.limits else None,
        own=furthest(places),
    )


def furthest(places):
    """Return how far any joint goes from one frame to the next."""
    return float(np.linalg.norm(np.diff(places, axis=0), axis=-1).max())


def measure(places, given):
    """Return what the table shows of a result: where the joints are (T, J, 3)."""
    left = np.linalg.norm(places[:, given.chosen] - given.targets, axis=-1).max(axis=1)
    over = 100.0 * (left > 1.001 * TOLERANCE).mean()
    return 1000 * left.mean(), 1000 * left.max(), over, 1000 * furthest(places)


def ours(given, runs):
    """Return ms a frame, steps a frame and the measures of the clip solver."""
    motion, size = given.motion, given.body.leg_length
    asked = [AtPosition(Point(j), given.targets[:, k]) for k, j in enumerate(given.chosen)]
    ease = dict.fromkeys(range(len(motion.skeleton)), 1.0)
    limit = None if given.widest is None else lambda local, _: within(local, given.widest)
    options = {"size": size, "ease": ease, "travel": 1.0, "tolerance": TOLERANCE / size, "limit": limit}
    took = []
    for _ in range(runs):
        start = time.perf_counter()
        found = solve(motion, asked, **options)
        took.append(time.perf_counter() - start)
    steps = counted(lambda: solve(motion, asked, **options))
    ms = 1000 * np.median(took) / len(motion)
    return ms, steps / len(motion), *measure(world(found.motion)[1], given)


def counted(job):
    """Return how many linear systems a job of ours solves."""
    systems, response = [], descent.response
    descent.response = lambda *rows: systems.append(rows[1].shape[-1]) or response(*rows)
    job()
    descent.response = response
    return sum(systems)


def within(local, widest):
    """Return local rotations (J, 4, F) turned back to angles that are allowed."""
    turn = quaternion.log(np.moveaxis(local, 1, -1))
    angle = np.linalg.norm(turn, axis=-1, keepdims=True)
    turn *= np.minimum(1.0, widest[:, None, None] / np.maximum(angle, 1e-12))
    return np.moveaxis(quaternion.exp(turn), -1, 1)


def mjcf(skeleton, widest):
    """Return the skeleton as a MuJoCo model: a free root, every other joint a ball."""

    def body(joint):
        limited = f'limited="true" range="0 {widest[joint]:.9g}"' if widest is not None else ""
        kind = f'<joint type="ball" {limited}/>' if skeleton.parents[joint] >= 0 else "<freejoint/>"
        pos = " ".join(f"{x:.9g}" for x in skeleton.offsets[joint])
        inside = "".join(body(child) for child in skeleton.children(joint))
        mass = '<inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>'
        return f'<body name="j{joint}" pos="{pos}">{kind}{mass}{inside}</body>'

    roots = "".join(body(int(j)) for j in np.flatnonzero(skeleton.parents < 0))
    return f'<mujoco><compiler angle="radian"/><worldbody>{roots}</worldbody></mujoco>'


def coordinates(model, motion, frame):
    """Return MuJoCo's coordinates of a frame; its quaternions are wxyz."""
    q = np.zeros(model.nq)
    for joint in range(len(motion.skeleton)):
        address = model.jnt_qposadr[model.body(f"j{joint}").jntadr[0]]
        if motion.skeleton.parents[joint] < 0:
            q[address : address + 3] = motion.translations[frame, joint]
            address += 3
        q[address : address + 4] = np.roll(motion.rotations[frame, joint], 1)
    return q


def theirs(given, runs, follows):
    """Return the same of mink."""
    model = mujoco.MjModel.from_xml_string(mjcf(given.motion.skeleton, given.widest))
    configuration = mink.Configuration(model)
    starts = [coordinates(model, given.motion, frame) for frame in range(len(given.motion))]
    configuration.update(starts[0])
    bodies = [model.body(f"j{j}").id for j in range(len(given.motion.skeleton))]
    check_same(configuration, given.motion, bodies)
    options = {"position_cost": 1.0, "orientation_cost": 0.0, "lm_damping": OF_ERRORS}
    tasks = {bodies[j]: mink.FrameTask(f"j{j}", "body", **options) for j in given.chosen}
    limits = [] if given.widest is None else [mink.ConfigurationLimit(model)]
    took = []
    for _ in range(runs):
        steps, places = 0, np.zeros((len(starts), len(bodies), 3))
        configuration.update(starts[0])
        start = time.perf_counter()
        for frame, targets in enumerate(given.targets):
            if not follows:
                configuration.update(starts[frame])
            steps += reached(configuration, tasks, targets, limits)
            places[frame] = configuration.data.xpos[bodies]
        took.append(time.perf_counter() - start)
    return 1000 * np.median(took) / len(starts), steps / len(starts), *measure(places, given)


def reached(configuration, tasks, targets, limits):
    """Step until the targets are met or nothing gets better; return the number of steps."""
    bodies, least, idle = list(tasks), np.inf, 0
    for steps in range(STEPS + 1):
        squares = ((configuration.data.xpos[bodies] - targets) ** 2).sum(axis=1)
        idle = 0 if squares.sum() < descent.BETTER * least else idle + 1
        least = min(least, squares.sum())
        if squares.max() <= TOLERANCE**2 or idle == descent.PATIENCE or steps == STEPS:
            break
        for (body, task), place in zip(tasks.items(), targets, strict=True):
            # The target's rotation is the body's own: though it has no cost, it would bend the way there.
            task.set_target(mink.SE3(np.concatenate([configuration.data.xquat[body], place])))
        objectives = list(tasks.values())
        velocity = mink.solve_ik(configuration, objectives, 1.0, "daqp", damping=ALWAYS, limits=limits)
        configuration.integrate_inplace(velocity, 1.0)
    return steps


def check_same(configuration, motion, bodies):
    """Stop if the two do not mean the same skeleton."""
    place = fk(motion.rotations[:1], motion.translations[:1], motion.skeleton.parents)[1][0]
    apart = np.abs(configuration.data.xpos[bodies] - place).max()
    if apart > 1e-9:
        raise SystemExit(f"the model for MuJoCo is not the clip's skeleton: {apart:g} m apart")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--frames", type=int, default=1000)
    parser.add_argument("--runs", type=int, default=3, help="the median is shown")
    parser.add_argument("--alone", action="store_true", help="without mink")
    options = parser.parse_args()
    if not mink and not options.alone:
        print('mink is not installed, so ours stands alone; to compare: pip install "mink>=1.3,<2"')
    heads = ("ms", "ratio", "steps", "mean", "max", "over %", "move", "asked")
    print(f"{'':<36}" + "".join(f"{head:>9}" for head in heads))
    for case in CASES:
        given = problem(case, options.frames)
        rows = {case.name: ours(given, options.runs)}
        if mink and not options.alone:
            rows["  mink, follows"] = theirs(given, options.runs, follows=True)
            rows["  mink, from the clip"] = theirs(given, options.runs, follows=False)
        for name, (ms, *rest) in rows.items():
            numbers = (ms / rows[case.name][0], *rest, 1000 * given.own)
            print(f"{name:<36}{ms:>9.3f}" + "".join(f"{number:>9.2f}" for number in numbers))


if __name__ == "__main__":
    main()
