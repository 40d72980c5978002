"""The hierarchy of a BVH file: text to skeleton and layout, and back.

Files differ in ways no standard forbids: braces on any line, names with spaces, odd case, joints with
0 to 6 channels, missing end sites. The text itself is kept, so that saving gives it back.
"""

import math
import re
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..errors import FormatError, unknown
from ..motion import Skeleton
from ..typing import Integers

MAX_JOINTS = 5000
POSITIONS = ("Xposition", "Yposition", "Zposition")
ROTATIONS = ("Xrotation", "Yrotation", "Zrotation")
_CHANNELS = {name.lower(): name for name in POSITIONS + ROTATIONS}
LARGEST = 1e9  # lengths in millimetres and angles in degrees are far below; squares stay far from overflow
_NUMBER = re.compile(r"[+-]?(\d+(\.\d*)?|\.\d+)(e[+-]?\d+)?", re.ASCII | re.IGNORECASE)
_BREAK = re.compile("\r\n|\n|\r")


@dataclass(frozen=True)
class BvhLayout:
    """What a BVH file holds beside the skeleton and the motion.

    ``channels`` for each joint, spelt as in ``POSITIONS`` and ``ROTATIONS``. ``header`` the file's bytes
    up to the first row of numbers, with ``count`` and ``time`` the spans (start, end) of the frame count
    and the frame time in it; ``frame_time`` what that text says, in seconds (NaN: it says nothing of
    use). ``skeleton`` is the one that the header describes. ``decimals``: how many the numbers have.
    ``whole``: the header can be used again as it is.
    """

    skeleton: Skeleton
    channels: tuple[tuple[str, ...], ...]
    header: bytes
    count: tuple[int, int]
    time: tuple[int, int]
    frame_time: float
    newline: bytes = b"\n"
    encoding: str = "utf-8"
    decimals: int = 6
    whole: bool = True

    def __repr__(self) -> str:
        return f"BvhLayout({len(self.skeleton)} joints, {self.width} channels, {self.decimals} decimals)"

    @property
    def width(self) -> int:
        """How many numbers a frame has."""
        return sum(map(len, self.channels))


def decode(header: bytes) -> tuple[str, str]:
    """Return the text of a header and its encoding: UTF-8, else what Windows wrote before it."""
    for encoding in ("utf-8-sig" if header.startswith(b"\xef\xbb\xbf") else "utf-8", "cp1252"):
        try:
            return header.decode(encoding), encoding
        except UnicodeDecodeError:
            continue
    return header.decode("latin-1"), "latin-1"


def coordinate(text: str) -> float:
    """Return the number that ``text`` spells, else NaN, as for one too large to be a length or an angle."""
    value = number(text)
    return value if abs(value) <= LARGEST else math.nan


def number(text: str) -> float:
    """Return the finite decimal number that ``text`` spells, else NaN."""
    value = float(text) if len(text) < 400 and _NUMBER.fullmatch(text) else math.nan
    return value if math.isfinite(value) else math.nan


def read_hierarchy(
    text: str, where: str, *, salvage: bool = False
) -> tuple[Skeleton, tuple[tuple[str, ...], ...], bool]:
    """Return the skeleton, each joint's channels, and whether the text was whole.

    With ``salvage``, missing braces at the end are added and what follows a whole tree is ignored.
    """
    reader = _Reader(where)
    whole = True
    try:
        for line in _BREAK.split(text):
            reader.read_line(line.strip())
    except FormatError:
        whole = False
        if not (salvage and reader.joints and not reader.open and not reader.waiting):
            raise
    whole &= reader.finish(salvage=salvage)
    return reader.skeleton(), tuple(node.channels for node in reader.joints), whole


@dataclass
class _Node:
    """A joint, or an end site (``index`` -1), while its block is read."""

    name: str
    index: int
    parent: int
    line: int
    offset: tuple[float, ...] = ()
    channels: tuple[str, ...] = ()


class _Reader:
    """Reads the hierarchy statement by statement; a statement may share its line with others."""

    def __init__(self, where: str) -> None:
        self.where, self.line, self.started = where, 0, False
        self.joints: list[_Node] = []
        self.ends: list[_Node] = []
        self.open: list[_Node] = []
        self.waiting: _Node | None = None  # declared, its brace still to come

    def fault(self, message: str) -> FormatError:
        return FormatError(f"{self.where} line {self.line}: {message}")

    def read_line(self, rest: str) -> None:
        self.line += 1
        while rest:
            rest = self._statement(rest)

    def _statement(self, rest: str) -> str:
        """Take one statement off the line and return what is left of it."""
        if rest[0] == "{":
            return self._enter(rest)
        if self.waiting:
            raise self.fault(f"expected '{{' after {self.waiting.name!r}, found {rest[:30]!r}")
        if rest[0] == "}":
            return self._leave(rest)
        word, tail = (rest.split(None, 1) + [""])[:2]
        name = word.partition("{")[0]
        match name.upper():
            case "HIERARCHY" if not self.started:
                self.started = True
                return tail
            case "ROOT" | "JOINT" | "END" if self.started:
                return self._declare(name.upper(), rest[len(name) :])
            case "OFFSET" if self.open:
                return self._offset(tail)
            case "CHANNELS" if self.open and self.open[-1].index >= 0:
                return self._channels(tail)
        if not self.started:
            raise self.fault(f"not a BVH file: it starts with {rest[:30]!r} instead of HIERARCHY")
        raise self.fault(f"{rest[:30]!r} has no place here (ROOT, JOINT, End Site, OFFSET, CHANNELS, MOTION)")

    def _declare(self, kind: str, rest: str) -> str:
        name, brace, tail = rest.partition("{")
        name = name.strip()
        parent = self.open[-1].index if self.open else -1
        if kind == "ROOT" and self.open:
            raise self.fault(
                f"ROOT {name!r} inside joint {self.open[-1].name!r}; a '}}' is missing before it"
            )
        if kind != "ROOT" and parent < 0:
            raise self.fault(f"{kind} {name!r} hangs on no joint; a '}}' too many, or no ROOT, before it")
        if not name:
            raise self.fault(f"{kind} without a name")
        if len(self.joints) >= MAX_JOINTS:
            raise self.fault(f"more than {MAX_JOINTS} joints; this cannot be a skeleton")
        index = -1 if kind == "END" else len(self.joints)
        self.waiting = _Node(name, index, parent, self.line)
        (self.joints if index >= 0 else self.ends).append(self.waiting)
        return brace + tail

    def _enter(self, rest: str) -> str:
        if self.waiting is None:
            raise self.fault("a '{' that belongs to no ROOT, JOINT or End Site")
        self.open.append(self.waiting)
        self.waiting = None
        return rest[1:].lstrip()

    def _leave(self, rest: str) -> str:
        if not self.open:
            raise self.fault("a '}' without a '{'")
        node = self.open[-1]
        if not node.offset:
            raise self.fault(f"{node.name!r} (line {node.line}) has no OFFSET")
        self.open.pop()
        return rest[1:].lstrip()

    def _offset(self, rest: str) -> str:
        words = _words(rest)
        offset = tuple(number(word) for word in words[:3])
        if len(offset) < 3 or any(map(math.isnan, offset)):
            raise self.fault(f"OFFSET needs three numbers, found {rest[:60]!r}")
        self.open[-1].offset = offset
        return " ".join(words[3:])

    def _channels(self, rest: str) -> str:
        words = _words(rest)
        count = int(words[0]) if words and re.fullmatch(r"\d{1,9}", words[0]) else -1
        names = words[1 : count + 1]
        if not 0 <= count == len(names):
            raise self.fault(f"CHANNELS needs a count and as many names, found {rest[:60]!r}")
        wrong = [name for name in names if name.lower() not in _CHANNELS]
        if wrong:
            raise self.fault(unknown("channel", wrong[0], _CHANNELS.values()))
        channels = tuple(_CHANNELS[name.lower()] for name in names)
        if len(set(channels)) < len(channels):
            raise self.fault(f"joint {self.open[-1].name!r} has a channel twice: {' '.join(names)}")
        self.open[-1].channels = channels
        return " ".join(words[count + 1 :])

    def finish(self, *, salvage: bool) -> bool:
        """Say whether every block was closed.

        Raises ``FormatError`` where there are no joints or, without ``salvage``, blocks that were left open.
        """
        if not self.started or not self.joints:
            raise self.fault("not a BVH file: no HIERARCHY with a ROOT before MOTION")
        left = [*self.open, *([self.waiting] if self.waiting else [])]
        if left and not (salvage and all(node.offset for node in left)):
            raise self.fault(
                f"the block of {left[-1].name!r} (line {left[-1].line}) is never closed; "
                f"{len(left)} '}}' missing before MOTION (use --salvage to close them)"
            )
        return not left

    def skeleton(self) -> Skeleton:
        return Skeleton(
            names=tuple(node.name for node in self.joints),
            parents=np.array([node.parent for node in self.joints], np.int64),
            offsets=np.array([node.offset for node in self.joints], np.float64),
            end_parents=np.array([node.parent for node in self.ends], np.int64),
            end_offsets=np.array([node.offset for node in self.ends], np.float64).reshape(-1, 3),
        )


def _words(text: str) -> list[str]:
    return text.replace("{", " { ").replace("}", " } ").split()


def depth_first(parents: Integers) -> list[int]:
    """Return the joints in the order in which a file nests them: each with all below it."""
    children: dict[int, list[int]] = {}
    for joint, parent in enumerate(parents.tolist()):
        children.setdefault(parent, []).append(joint)
    order, stack = [], children[-1][::-1]
    while stack:
        order.append(stack.pop())
        stack += children.get(order[-1], [])[::-1]
    return order


def write_hierarchy(skeleton: Skeleton, channels: Sequence[Sequence[str]]) -> list[str]:
    """Return the lines of the hierarchy, from HIERARCHY to the last brace."""
    lines, open_joints = ["HIERARCHY"], [-1]
    ends: dict[int, list[str]] = {}
    for parent, offset in zip(skeleton.end_parents.tolist(), skeleton.end_offsets.tolist(), strict=True):
        ends.setdefault(parent, []).append(_triple(offset))
    for joint in depth_first(skeleton.parents):
        _close(lines, open_joints, int(skeleton.parents[joint]))
        indent = "\t" * (len(open_joints) - 1)
        lines += [
            f"{indent}{'JOINT' if len(open_joints) > 1 else 'ROOT'} {skeleton.names[joint]}",
            f"{indent}{{",
            f"{indent}\tOFFSET {_triple(skeleton.offsets[joint].tolist())}",
            f"{indent}\t{' '.join(['CHANNELS', str(len(channels[joint])), *channels[joint]])}",
        ]
        for end in ends.get(joint, []):
            lines += [f"{indent}\tEnd Site", f"{indent}\t{{", f"{indent}\t\tOFFSET {end}", f"{indent}\t}}"]
        open_joints.append(joint)
    _close(lines, open_joints, -1)
    return lines


def _close(lines: list[str], open_joints: list[int], parent: int) -> None:
    while open_joints[-1] != parent:
        open_joints.pop()
        lines.append("\t" * (len(open_joints) - 1) + "}")


def _triple(offset: list[float]) -> str:
    return " ".join(f"{x:.6f}" if round(x, 6) == x else repr(x) for x in offset)
