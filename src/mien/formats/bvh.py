"""BVH: read and write, without loss and without surprise.

Reading keeps the file's header and numbers; writing gives them back where nothing was changed. Damage
is refused with file and line, or with ``salvage`` cut away.
"""

import math
import re
from dataclasses import replace
from pathlib import Path

import numpy as np

from ..errors import FormatError
from ..motion import Motion, Skeleton
from ..typing import Array
from .bvh_channels import BvhSource, to_motion, to_values
from .bvh_digits import write_rows
from .bvh_header import (
    POSITIONS,
    BvhLayout,
    decode,
    depth_first,
    number,
    read_hierarchy,
    write_hierarchy,
)
from .bvh_numbers import read_rows

_MOTION = re.compile(rb"(?:\A|[\r\n}])[ \t]*(MOTION)(?=\s|\Z)", re.IGNORECASE)
_COUNT = re.compile(rb"\s*Frames[\s:]*([^\s:]+)", re.IGNORECASE)
_TIME = re.compile(rb"\s*Frame[ \t]*Time[\s:]*([^\s:]+)[ \t]*(\r\n|\n|\r|\Z)", re.IGNORECASE)
_LINE = re.compile(rb"\r\n|\n|\r")


def parse(data: bytes, where: str, *, fps: float | None = None, salvage: bool = False) -> Motion:
    """Make a motion of the bytes of a BVH file; ``where`` names the file in errors."""
    layout, declared = _read_header(data, where, fps=fps, salvage=salvage)
    values = _read_values(data, where, layout, declared, salvage=salvage)
    rotations, translations = to_motion(values, layout.skeleton, layout.channels)
    return Motion(
        skeleton=replace(layout.skeleton, layout=layout),
        rotations=rotations,
        translations=translations,
        frame_time=1.0 / fps if fps else layout.frame_time,
        source=BvhSource(layout.channels, values, rotations, translations),
        name=Path(where).stem,
    )


def render(motion: Motion) -> bytes:
    """Return the bytes of the BVH file that holds ``motion``."""
    motion = _nested(motion)
    layout = _layout(motion)
    values = to_values(motion, layout.channels, decimals=min(max(layout.decimals, 6), 9))
    return _stamp(layout, len(motion), motion.frame_time) + write_rows(
        values, layout.newline, decimals=min(layout.decimals, 9)
    )


def _read_header(data: bytes, where: str, *, fps: float | None, salvage: bool) -> tuple[BvhLayout, int]:
    found = _MOTION.search(data)
    if found is None:
        raise FormatError(f"{where}: {_no_motion(data)}")
    text, encoding = decode(data[: found.start(1)])
    skeleton, channels, whole = read_hierarchy(text, where, salvage=salvage)
    if not any(channels):
        raise FormatError(f"{where}: no joint has channels, so there is no motion in the file")
    count = _COUNT.match(data, found.end())
    time = count and _TIME.match(data, count.end())
    if not count or not time:
        at = count.end() if count else found.end()
        at += len(data[at:]) - len(data[at:].lstrip())
        wanted = "'Frame Time: 0.01'" if count else "'Frames: 10'"
        raise FormatError(f"{where} line {_line(data, at)}: expected {wanted} here")
    layout = BvhLayout(
        skeleton=skeleton,
        channels=channels,
        header=data[: time.end()],
        count=count.span(1),
        time=time.span(1),
        frame_time=_frame_time(time[1], f"{where} line {_line(data, time.start(1))}", fps=fps),
        newline=time[2] or b"\n",
        encoding=encoding,
        decimals=_decimals(data, time.end()),
        whole=whole,
    )
    return layout, _frames(count[1], f"{where} line {_line(data, count.start(1))}")


def _decimals(data: bytes, start: int) -> int:
    """Return how many decimals the numbers in the first kilobyte of rows have at most."""
    return max(map(len, re.findall(rb"\.(\d*)", data[start : start + 1024])), default=0)


def _no_motion(data: bytes) -> str:
    if not data.strip():
        return "the file is empty"
    if data[:2] in (b"\xff\xfe", b"\xfe\xff"):
        return "this is UTF-16 text; save it as UTF-8"
    if b"\0" in data[:4096]:
        return "this is not a text file, so not BVH"
    if data.removeprefix(b"\xef\xbb\xbf").lstrip()[:9].upper() != b"HIERARCHY":
        return "not a BVH file: it does not start with HIERARCHY"
    return "there is no MOTION section; the file looks cut off in the hierarchy"


def _line(data: bytes, at: int) -> int:
    """Return the number, from 1, of the line that holds byte ``at``."""
    return 1 + len(_LINE.findall(data, 0, at))


def _frames(text: bytes, where: str) -> int:
    if not re.fullmatch(rb"\+?\d{1,18}", text) or int(text) == 0:
        raise FormatError(
            f"{where}: the number of frames must be a whole number above 0, found {_show(text)}"
        )
    return int(text)


def _frame_time(text: bytes, where: str, *, fps: float | None) -> float:
    seconds = number(text.decode("latin-1"))
    if 1e-6 <= seconds <= 1e4:
        return seconds
    if fps:
        return math.nan
    raise FormatError(
        f"{where}: the frame time must be seconds above 0, found {_show(text)} (use --fps to override it)"
    )


def _show(text: bytes) -> str:
    return repr(text[:30].decode("latin-1"))


def _read_values(data: bytes, where: str, layout: BvhLayout, declared: int, *, salvage: bool) -> Array:
    values, problem = read_rows(data, len(layout.header), layout.width)
    frames = len(values)
    if problem and (not salvage or not frames):
        line = _line(data, len(layout.header)) + problem.line
        state = (
            f"the file looks cut off after frame {frames}"
            if problem.ends
            else f"frame {frames + 1} is damaged"
        )
        keep = f"use --salvage to keep the first {frames} frames" if frames else "no frame is whole"
        raise FormatError(f"{where} line {line}: {problem.message}; {state} ({keep})")
    if not frames:
        raise FormatError(
            f"{where}: {declared} frames are declared, but there are no numbers after the header"
        )
    if frames != declared and not salvage:
        line = _line(data, layout.count[0])
        raise FormatError(
            f"{where} line {line}: {declared} frames are declared, but {frames} follow "
            f"(use --salvage to take the {frames})"
        )
    return values


def _nested(motion: Motion) -> Motion:
    """Return the motion with its joints in the order in which a file nests them."""
    skeleton, order = motion.skeleton, np.array(depth_first(motion.skeleton.parents))
    if (order == np.arange(len(order))).all():
        return motion
    place = np.argsort(order)  # where each joint goes
    parents = skeleton.parents[order]
    moved = replace(
        skeleton,
        names=tuple(skeleton.names[j] for j in order),
        parents=np.where(parents < 0, -1, place[parents]),
        offsets=skeleton.offsets[order],
        end_parents=place[skeleton.end_parents],
        layout=None,
    )
    rotations, translations = motion.rotations[:, order], motion.translations[:, order]
    return motion.with_(skeleton=moved, rotations=rotations, translations=translations, source=None)


def _layout(motion: Motion) -> BvhLayout:
    """Return the layout to write with: the file's own while the skeleton is the one it describes."""
    skeleton, layout = motion.skeleton, motion.skeleton.layout
    if not isinstance(layout, BvhLayout) or layout.skeleton.names != skeleton.names:
        return new_layout(skeleton, _default_channels(motion))
    if not layout.whole or not _same(skeleton, layout.skeleton):
        return new_layout(skeleton, layout.channels, newline=layout.newline, encoding=layout.encoding)
    return layout


def _same(a: Skeleton, b: Skeleton) -> bool:
    return all(
        np.array_equal(getattr(a, field), getattr(b, field))
        for field in ("parents", "offsets", "end_parents", "end_offsets")
    )


def _default_channels(motion: Motion) -> tuple[tuple[str, ...], ...]:
    """Return three rotations for every joint, and positions for roots and for joints that move."""
    turns = ("Zrotation", "Xrotation", "Yrotation")
    moves = (motion.translations != motion.skeleton.offsets).any(axis=(0, 2)) | (motion.skeleton.parents < 0)
    return tuple(POSITIONS + turns if moved else turns for moved in moves)


def new_layout(
    skeleton: Skeleton,
    channels: tuple[tuple[str, ...], ...],
    *,
    newline: bytes = b"\n",
    encoding: str = "utf-8",
) -> BvhLayout:
    """Return the layout of a file yet to be written, with these ``channels`` for each joint."""
    lines = [*write_hierarchy(skeleton, channels), "MOTION", "Frames: "]
    before = _encode(newline.decode().join(lines), encoding)
    between = b"0" + newline + b"Frame Time: "
    time = len(before) + len(between)
    return BvhLayout(
        skeleton=skeleton,
        channels=channels,
        header=before + between + b"0" + newline,
        count=(len(before), len(before) + 1),
        time=(time, time + 1),
        frame_time=math.nan,
        newline=newline,
    )


def _encode(text: str, encoding: str) -> bytes:
    try:
        return text.encode(encoding)
    except UnicodeEncodeError:
        return text.encode()


def _stamp(layout: BvhLayout, frames: int, frame_time: float) -> bytes:
    """Return the header with the number of frames and, where it changed, the frame time put in."""
    header, (a, b), (c, d) = layout.header, layout.count, layout.time
    time = header[c:d] if frame_time == layout.frame_time else repr(frame_time).encode()
    return b"".join([header[:a], str(frames).encode(), header[b:c], time, header[d:]])
