"""A yardstick, not a method of mien: the crudest transform that can be learned from acted pairs.

Of each joint the mean offset of its posture and the gain of its amplitude, and the tempo, each averaged over
the acted takes of a style; then the feet are planted and the edit is made safe. What a real method adds must
show as more than this.
"""

from collections import defaultdict
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from acted import Take

import mien
from mien.emotion.safe import safe
from mien.kinematics.fk import to_local, world
from mien.kinematics.heading import heading_rotation
from mien.kinematics.joint_angles import Joints
from mien.kinematics.poses import neutral_world
from mien.rotations import quaternion
from mien.typing import Array

GAINS = (0.3, 3.0)  # no joint moves less or more than that


@dataclass(frozen=True)
class Turning:
    """How the joints of a clip turn away from the stance: of each the mean (4,) and what is left (T, 3).

    In the body's axes: forward, left, up. ``speed`` is that of the joints over their amplitudes, in 1/s.
    """

    mean: Mapping[str, Array]
    rest: Mapping[str, Array]
    speed: float


def seen(motion: mien.Motion, body: mien.Body) -> tuple[Joints, Array, Array]:
    """Return the joints and how they are turned (T, R, 4), and the same of the hips (T, 4), in body axes."""
    joints = Joints.of(motion, body)
    rotations, positions = world(motion)
    turned = quaternion.multiply(
        quaternion.conjugate(rotations[:, joints.bases]), rotations[:, joints.joints]
    )
    hips = body.roles["hips"]
    stance = neutral_world(motion, body)[0][hips]
    upright = quaternion.multiply(rotations[:, hips], quaternion.conjugate(stance))
    free = quaternion.multiply(quaternion.conjugate(heading_rotation(positions, body)), upright)
    return joints, _in_axes(joints.seen(turned), _axes(body)), _in_axes(free, _axes(body))


def _axes(body: mien.Body) -> Array:
    return np.stack([body.forward, body.left, body.up])


def _in_axes(q: Array, axes: Array) -> Array:
    """Return rotations as seen along other axes (3, 3), given as rows."""
    return np.concatenate([q[..., :3] @ axes.T, q[..., 3:]], axis=-1)


def turning(motion: mien.Motion, body: mien.Body) -> Turning:
    """Return how a clip's joints turn away from the stance of a body, which may be another clip's."""
    joints, turned, hips = seen(motion, body)
    mean, rest, speeds = {}, {}, []
    for name, q in [("hips", hips), *((n, turned[:, r]) for r, n in enumerate(joints.names))]:
        middle = _mean(q)
        mean[name] = middle
        rest[name] = quaternion.log(quaternion.multiply(quaternion.conjugate(middle), q))
        size = np.sqrt(np.mean(rest[name] ** 2))
        speeds.append(np.sqrt(np.mean(np.diff(rest[name], axis=0) ** 2)) * motion.fps / max(size, 0.02))
    return Turning(mean, rest, float(np.mean(speeds)))


def _mean(q: Array) -> Array:
    values, vectors = np.linalg.eigh(q.T @ q)
    middle = vectors[:, np.argmax(values)]
    return middle if middle[3] >= 0 else -middle


@dataclass(frozen=True)
class Style:
    """Joint -> rotation vector (3,) in body axes that is added to its mean, and gain; and a tempo."""

    offsets: Mapping[str, Array]
    gains: Mapping[str, float]
    rate: float


def learn(
    pairs: Sequence[tuple[Take, Take]], *, keep_safe: bool = True
) -> Callable[[mien.Motion, str], mien.Motion]:
    """Return an edit (motion, style) -> motion that was learned from acted takes and their neutral ones."""
    found: dict[str, list[tuple[Turning, Turning]]] = defaultdict(list)
    for acted, neutral in pairs:
        calm = neutral.load()
        body = mien.Body.of(calm)
        found[acted.style].append((turning(acted.load(), body), turning(calm, body)))
    styles = {style: _averaged(some) for style, some in found.items()}

    def edit(motion: mien.Motion, style: str) -> mien.Motion:
        done = transform(motion, styles[style])
        return safe(done) if keep_safe else done

    return edit


def _averaged(found: Sequence[tuple[Turning, Turning]]) -> Style:
    offsets, gains = {}, {}
    for name in found[0][0].mean:
        turns = [quaternion.multiply(a.mean[name], quaternion.conjugate(n.mean[name])) for a, n in found]
        offsets[name] = np.mean([quaternion.log(q) for q in turns], axis=0)
        sizes = [[np.sqrt(np.mean(t.rest[name] ** 2)) + 0.02 for t in pair] for pair in found]
        gains[name] = float(np.clip(np.exp(np.mean([np.log(a / n) for a, n in sizes])), *GAINS))
    return Style(offsets, gains, float(np.exp(np.mean([np.log(a.speed / n.speed) for a, n in found]))))


def transform(motion: mien.Motion, style: Style) -> mien.Motion:
    """Return the motion in a style."""
    rate = float(np.clip(style.rate, 0.5, 2.0))
    bare = mien.apply(motion, [mien.Step("tempo", {"rate": rate})])
    moved = bare.with_(rotations=_rotations(bare, style))
    # Without a reference edits would be compared with nothing.
    return mien.apply(moved.with_(reference=bare, history=bare.history), [mien.Step("foot_plant")])


def _rotations(motion: mien.Motion, style: Style) -> Array:
    """Return the local rotations (T, J, 4) in a style."""
    body = mien.Body.of(motion)
    joints, _, _ = seen(motion, body)
    was, back = turning(motion, body), _axes(body).T

    def styled(name: str) -> Array:
        middle = quaternion.multiply(quaternion.exp(style.offsets.get(name, np.zeros(3))), was.mean[name])
        rest = quaternion.exp(style.gains.get(name, 1.0) * was.rest[name])
        return _in_axes(quaternion.multiply(middle, rest), back)

    local = joints.turned(np.stack([styled(name) for name in joints.names], axis=1))
    old, positions = world(motion)
    hips = body.roles["hips"]
    upright = quaternion.multiply(styled("hips"), neutral_world(motion, body)[0][hips])
    top = quaternion.multiply(heading_rotation(positions, body), upright)
    rows = {int(j): r for r, j in enumerate(joints.joints)}
    out = np.array(old)
    for j, parent in enumerate(motion.skeleton.parents):
        if j == hips:
            out[:, j] = top
        elif j in rows:
            out[:, j] = quaternion.multiply(out[:, joints.bases[rows[j]]], local[:, rows[j]])
        elif parent >= 0:
            out[:, j] = quaternion.multiply(out[:, parent], motion.rotations[:, j])
    return quaternion.continuous(to_local(out, positions, motion.skeleton.parents)[0])
