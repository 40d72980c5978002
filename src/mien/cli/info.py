"""``mien info``: what is in a clip."""

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import typer

from ..errors import BodyError, MienError
from . import arguments as a
from .report import complain, progress, show_json

if TYPE_CHECKING:
    from ..kinematics.body import Body
    from ..motion import Motion

UNITS = {1.0: "m", 0.3048: "foot", 0.1: "dm", 0.0254: "inch", 0.01: "cm", 0.001: "mm"}


def info(
    clips: a.Clips,
    as_json: a.Json = False,
    fps: a.Fps = None,
    salvage: a.Salvage = False,
    map_file: a.MapFile = None,
) -> None:
    """Say what is in clips: joints, frames, rate, unit, axes, the body that was found, and what looks odd."""
    from .inputs import expand

    found = [clip.path for clip in expand(clips)]
    facts, failed = [], 0
    for path in progress(found, total=len(found), doing="reading"):
        try:
            facts.append(describe(path, a.opened(path, fps, salvage, map_file)))
        except MienError as error:
            failed += 1
            facts.append({"file": str(path), "error": str(error)})
    if as_json:
        show_json(facts)
    for fact in facts:
        if "error" in fact:
            complain(fact["error"])
        elif not as_json:
            typer.echo(_text(fact))
    if failed:
        raise typer.Exit(2 if failed == len(found) else 1)


def describe(path: Path, motion: "Motion") -> dict[str, Any]:
    """Return what is known of a motion as plain data."""
    from ..analysis.inspect import notes
    from ..kinematics.body import Body

    facts: dict[str, Any] = {
        "file": str(path),
        "joints": len(motion.skeleton),
        "frames": len(motion),
        "fps": motion.fps,
        "seconds": motion.duration,
    }
    try:
        facts["body"] = _body(motion, Body.of(motion))
    except BodyError as error:
        facts["no_body"] = str(error)
    facts["notes"] = list(notes(motion))
    facts["joint_names"] = list(motion.skeleton.names)
    return facts


def _body(motion: "Motion", body: "Body") -> dict[str, Any]:
    names = motion.skeleton.names
    return {
        "roles": {role: names[joint] for role, joint in body.roles.items()},
        "spine": [names[joint] for joint in body.spine],
        "neck": [names[joint] for joint in body.neck],
        "up": axis(body.up.tolist()),
        "forward": [round(x, 3) for x in body.forward.tolist()],
        "unit": unit(body.metres_per_unit),
        "metres_per_unit": body.metres_per_unit,
        "height_m": body.height * body.metres_per_unit,
        "leg_m": body.leg_length * body.metres_per_unit,
        "floor": body.floor,
    }


def axis(vector: list[float]) -> str:
    """Return the name of the axis nearest to a unit vector, such as ``+y``."""
    largest = max(range(3), key=lambda i: abs(vector[i]))
    return ("+" if vector[largest] > 0 else "-") + "xyz"[largest]


def unit(metres: float) -> str:
    """Return the name of a unit of length, or its size in metres."""
    near = min(UNITS, key=lambda known: abs(known - metres))
    return UNITS[near] if abs(near - metres) < 1e-9 else f"{metres:.4g} m"


def _text(fact: Mapping[str, Any]) -> str:
    """Return the facts as lines for a person."""
    rate = f"{fact['fps']:.2f}".rstrip("0").rstrip(".")
    size = f"{_count(fact['joints'], 'joint')}, {_count(fact['frames'], 'frame')}"
    lines = [fact["file"], f"  {size} at {rate} fps: {fact['seconds']:.2f} s"]
    body = fact.get("body")
    if body:
        lines += [
            f"  {body['height_m']:.2f} m tall (estimated), legs {body['leg_m']:.2f} m, unit {body['unit']}, "
            f"up {body['up']}, floor at {body['floor']:.2f}",
            f"  spine: {' > '.join(body['spine']) or 'none'}; neck: {' > '.join(body['neck']) or 'none'}",
            *_roles(body["roles"]),
        ]
    else:
        lines += [f"  no body found: {fact['no_body']}"]
    return "\n".join([*lines, *(f"  note: {note}" for note in fact["notes"])])


def _count(number: int, thing: str) -> str:
    return f"{number} {thing}{'' if number == 1 else 's'}"


def _roles(roles: Mapping[str, str]) -> list[str]:
    """Return the roles of trunk, left and right, one line each."""
    groups: dict[str, list[str]] = {"middle": [], "left": [], "right": []}
    for role, joint in roles.items():
        side, _, rest = role.partition("_")
        group = side if rest else "middle"
        groups[group].append(f"{rest or role} {joint}")
    return [f"  {group}: {', '.join(found)}" for group, found in groups.items() if found]
