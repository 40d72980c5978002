"""Inverse kinematics: the clip solver beside mink (MuJoCo), from the same poses to the same targets.

Run: python benchmarks/ik.py [--frames 1000] [--runs 5] [--beside 300]

A synthetic walk is to pass through where joints are in another motion on the same skeleton, to a millimetre.
``ms`` is the median time a frame of some runs; ``steps`` the mean number of linear systems solved for a
frame; ``mean`` and ``max`` the error of the worst target of a frame, mm; ``over`` the share of frames above
1 mm; ``move`` the furthest that any joint goes from one frame to the next, mm (in the last column: in the
motion that the targets are from, or that they are stretched from).

mink goes frame by frame, each from the solution before, and is given the first ``--beside`` frames. It is not
needed: without it our columns are printed alone. To have it: pip install "mink>=1,<2".
"""

import argparse
import time
from dataclasses import dataclass
from types import SimpleNamespace

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
GIVEN_UP = 30  # steps of mink on one frame
# Of mink's damping these were tried, 1e-6 to 1e-2: the quickest that loses no frame of the first case.
DAMPING = 1e-3
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
    """Return the clip, joints with targets, the targets (T, K, 3), limits (J,), and the motion they are from."""
    motion = samples.walk(seconds=(frames - 1) / 60.0, fps=60.0, skeleton=case.skeleton, unit="m").motion
    body, joints = Body.of(motion), len(motion.skeleton)
    noise = np.random.default_rng(1).normal(size=(frames, joints, 3))
    if not case.sudden:
        noise = gaussian_filter1d(noise, 10.0, axis=0, mode="wrap")
    turned = quaternion.multiply(motion.rotations, quaternion.exp(noise * WANDER / noise.std()))
    other = motion.with_(rotations=turned)
    chosen = [body.roles[r] for r in ROLES]
    chosen += [j for j in range(joints) if j not in chosen][-(case.targets - len(chosen)) :][
        : case.targets - 8
    ]
    places = world(other)[1]
    hips = places[:, [body.roles["hips"]]]
    largest = [np.linalg.norm(quaternion.log(m.rotations), axis=-1).max(axis=0) for m in (motion, other)]
    return SimpleNamespace(
        motion=motion,
        body=body,
        chosen=chosen,
        targets=(hips + case.stretch * (places - hips))[:, chosen],
        widest=1.02 * np.max(largest, axis=0) if case.limits else None,
        own=furthest(places),
    )


def furthest(places):
    """Return how far any joint goes from one frame to the next."""
    return float(np.linalg.norm(np.diff(places, axis=0), axis=-1).max())


def measure(places, given):
    """Return what the table shows of a result: where the joints are (T, J, 3)."""
    left = np.linalg.norm(places[:, given.chosen] - given.targets[: len(places)], axis=-1).max(axis=1)
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


def theirs(given, frames):
    """Return the same of mink, from the first pose on through the first ``frames``."""
    model = mujoco.MjModel.from_xml_string(mjcf(given.motion.skeleton, given.widest))
    configuration = mink.Configuration(model)
    configuration.update(coordinates(model, given.motion, 0))
    bodies = [model.body(f"j{j}").id for j in range(len(given.motion.skeleton))]
    chosen = [bodies[j] for j in given.chosen]
    check_same(configuration, given.motion, bodies)
    tasks = [mink.FrameTask(f"j{j}", "body", position_cost=1.0, orientation_cost=0.0) for j in given.chosen]
    limits = [] if given.widest is None else [mink.ConfigurationLimit(model)]
    took, steps, places = [], 0, np.zeros((frames, len(bodies), 3))
    for frame in range(frames):
        start = time.perf_counter()
        for taken in range(GIVEN_UP + 1):
            away = configuration.data.xpos[chosen] - given.targets[frame]
            if taken == GIVEN_UP or np.sqrt((away**2).sum(axis=1)).max() <= TOLERANCE:
                break
            for task, body, place in zip(tasks, chosen, given.targets[frame], strict=True):
                # The target's rotation is the body's own: else its error, though of no cost, bends the way.
                task.set_target(mink.SE3(np.concatenate([configuration.data.xquat[body], place])))
            velocity = mink.solve_ik(configuration, tasks, 1.0, "daqp", damping=DAMPING, limits=limits)
            configuration.integrate_inplace(velocity, 1.0)
            steps += 1
        took.append(time.perf_counter() - start)
        places[frame] = configuration.data.xpos[bodies]
    return 1000 * np.median(took), steps / frames, *measure(places, given)


def check_same(configuration, motion, bodies):
    """Stop if the two do not mean the same skeleton."""
    place = fk(motion.rotations[:1], motion.translations[:1], motion.skeleton.parents)[1][0]
    apart = np.abs(configuration.data.xpos[bodies] - place).max()
    if apart > 1e-9:
        raise SystemExit(f"the model for MuJoCo is not the clip's skeleton: {apart:g} m apart")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--frames", type=int, default=1000)
    parser.add_argument("--runs", type=int, default=5, help="of ours; the median is shown")
    parser.add_argument("--beside", type=int, default=300, help="frames for mink, 0: none")
    options = parser.parse_args()
    beside = min(options.beside, options.frames) if mink else 0
    if not mink:
        print('mink is not installed, so ours stands alone; to compare: pip install "mink>=1,<2"')
    heads = ("ms", "steps", "mean", "max", "over %", "move")
    print(f"{'':<36}" + "".join(f"{h:>9}" for h in heads) + f"{'ratio':>9}{'targets':>9}")
    for case in CASES:
        given = problem(case, options.frames)
        rows = {"ours": ours(given, options.runs)}
        if beside:
            rows["mink"] = theirs(given, beside)
        for who, row in rows.items():
            cells = "".join(f"{v:>9.3f}" if i == 0 else f"{v:>9.2f}" for i, v in enumerate(row))
            rest = f"{rows[who][0] / rows['ours'][0]:>9.1f}{1000 * given.own:>9.1f}"
            print(f"{case.name if who == 'ours' else '  ' + who:<36}{cells}{rest}")


if __name__ == "__main__":
    main()
