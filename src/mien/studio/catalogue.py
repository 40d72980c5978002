"""What the page is told at the start: edits with their parameters, presets, words, parts, samples."""

from collections.abc import Mapping
from importlib.metadata import version
from typing import Any

from ..edits.registry import EDITS, Edit, Parameter
from ..emotion.circumplex import Point, words
from ..emotion.model import shipped_model
from ..emotion.presets import PRESETS, preset
from ..kinematics.parts import PARTS
from ..kinematics.roles import ROLES
from ..samples import SAMPLES
from .messages import ClipInfo, EditInfo, Hello, ParameterInfo, PresetInfo, ValueKind, Word

# Samples worth a look; the others are fixtures of tests.
SHOWN = ("walk", "wave", "dance", "knock", "jump", "punch", "tired_walk", "turn")
KINDS: dict[type, ValueKind] = {float: "number", int: "whole", bool: "flag", str: "text", tuple: "list"}


def hello(clips: list[ClipInfo], given: list[str], *, largest_upload: int) -> Hello:
    """Return what the page needs to begin."""
    return Hello(
        version=version("mien"),
        samples=[name for name in SHOWN if name in SAMPLES],
        presets=[_preset(name) for name in PRESETS],
        edits=[_edit(edit) for edit in EDITS.values()],
        words=_places(words()),
        learned=_places(shipped_model().places),
        parts={name: list(members) for name, members in PARTS.items()},
        roles=list(ROLES),
        clips=clips,
        given=given,
        largest_upload=largest_upload,
    )


def _places(points: Mapping[str, Point]) -> list[Word]:
    return [Word(name, *map(float, point)) for name, point in points.items()]


def _preset(name: str) -> PresetInfo:
    found = preset(name)
    return PresetInfo(name, found.description, found.evidence)


def _edit(edit: Edit) -> EditInfo:
    return EditInfo(edit.name, edit.kind, edit.summary, [_parameter(p) for p in edit.parameters.values()])


def _parameter(parameter: Parameter) -> ParameterInfo:
    about, kind = parameter.about, KINDS.get(parameter.kind, "text")
    return ParameterInfo(
        name=parameter.name,
        kind="choice" if parameter.choices and kind == "text" else kind,
        doc=about.doc,
        default=_plain(parameter.default),
        low=about.low,
        high=about.high,
        neutral=about.neutral,
        unit=about.unit,
        choices=list(parameter.choices),
        optional=parameter.optional,
    )


def _plain(value: Any) -> Any:
    return [_plain(item) for item in value] if isinstance(value, tuple) else value
