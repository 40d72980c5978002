"""The nine of a square as a blend space for engines: a description as plain data, and Godot's own file.

An engine plays the nine clips in step and mixes their poses; it needs to know where each of them stands.
``describe`` says that in JSON for whoever writes an importer. ``godot`` is a resource of Godot 4 that an
``AnimationTree`` takes as it is; it names animations, which must be in the player under these names.
"""

from collections.abc import Mapping
from typing import Any

from .grid import NINE, Grid

FORMAT, VERSION = "mien blend space", 1


def file_stem(clip: str, letter: str) -> str:
    """Return what one of the nine of a clip is called: ``walk_A_short-even``."""
    name = next(corner.name for corner in NINE if corner.letter == letter)
    return f"{clip}_{letter}_{name}"


def describe(square: Grid, files: Mapping[str, str], *, source: Mapping[str, Any]) -> dict[str, Any]:
    """Return axes, samples and how to interpolate, as plain data.

    ``files`` letter -> file name of that one of the nine; ``source`` is kept as it is.
    """
    motion = square.motion
    return {
        "format": FORMAT,
        "version": VERSION,
        "source": dict(source),
        "made_with": dict(square.options),
        "clips": {
            "frames": len(motion),
            "frames_per_second": motion.fps,
            "seconds": motion.duration,
            "loop_frames": square.square.round_length or None,
            "in_step": True,
        },
        "axes": [_axis("path", "short paths", "long paths"), _axis("timing", *_ENDS_OF_TIMING)],
        "samples": [
            {
                "letter": corner.letter,
                "file": files[corner.letter],
                "at": [corner.path, corner.timing],
                "title": corner.title,
            }
            for corner in NINE
        ],
        "interpolation": {
            "kind": "bilinear",
            "weights": "i = min(floor(path), 1), j = min(floor(timing), 1), a = path - i, b = timing - j: "
            "(1-a)(1-b) for (i, j), a(1-b) for (i+1, j), (1-a)b for (i, j+1), ab for (i+1, j+1)",
            "rotations": "weighted mean of quaternions of one sign, scaled to length 1 (or of the first two "
            "columns of the matrices, made orthogonal again)",
            "translations": "weighted mean",
            "time": "the same frame of all four",
        },
    }


_ENDS_OF_TIMING = ("added acceleration", "constant speed")


def _axis(name: str, low: str, high: str) -> dict[str, Any]:
    return {
        "name": name,
        "min": 0,
        "neutral": 1,
        "max": 2,
        "meaning": {"0": low, "1": "as in the original", "2": high},
    }


def godot(names: Mapping[str, str]) -> str:
    """Return the text of an ``AnimationNodeBlendSpace2D`` (.tres); ``names`` letter -> animation.

    ``sync`` keeps all nine running, so that they stay in step. Godot mixes the three corners of a triangle
    where the thesis mixes four of a square; at the nine both are the same.
    """
    parts = [f'[gd_resource type="AnimationNodeBlendSpace2D" load_steps={len(NINE) + 1} format=3]']
    for corner in NINE:
        name = names[corner.letter].replace("\\", "\\\\").replace('"', '\\"')
        parts.append(
            f'[sub_resource type="AnimationNodeAnimation" id="{corner.letter}"]\nanimation = &"{name}"'
        )
    lines = ["[resource]"]
    for number, corner in enumerate(NINE):
        lines.append(f'blend_point_{number}/node = SubResource("{corner.letter}")')
        lines.append(f"blend_point_{number}/pos = Vector2({corner.path}, {corner.timing})")
    lines += ["min_space = Vector2(0, 0)", "max_space = Vector2(2, 2)"]
    lines += ['x_label = "path"', 'y_label = "timing"', "sync = true"]
    return "\n\n".join([*parts, "\n".join(lines)]) + "\n"
