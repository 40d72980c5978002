"""What the page and the server say to each other, as plain data.

The page's TypeScript types are made from it: ``scripts/messages.py`` writes ``frontend/src/messages.ts``, and
a test sees that both agree. Lengths are in the clip's own unit, times in seconds, quaternions ``xyzw``.
Arrays do not travel as JSON: ``Frames`` is the head of a binary answer, which says where each of them starts
(``render.wire``).
"""

from dataclasses import dataclass, field
from typing import Any, Literal

from ..render.wire import Frames as Frames
from ..render.wire import PlaceInArrays as PlaceInArrays
from ..render.wire import Shape as Shape

# Of a parameter; pairs of numbers are a keyed curve.
Value = bool | int | float | str | list[str] | list[list[float]] | None
Strength = int | float | list[list[float]]  # a number, or (seconds, value)
LayerKind = Literal["emotion", "edit", "place"]
ValueKind = Literal["number", "whole", "flag", "choice", "text", "list"]
ExportKind = Literal["bvh", "recipe", "map", "png", "gif", "mp4", "html", "project"]
RoleGroup = Literal["trunk", "left", "right"]


@dataclass(frozen=True)
class Layer:
    """One layer of the stack.

    An ``emotion`` is a preset called ``name``, an ``edit`` has its ``parameters``, a ``place`` is a point of
    the disc: ``name`` is the method, ``parameters`` are ``valence`` and ``arousal``. ``on`` False leaves it
    out; where any layer is ``solo`` only those are done.
    """

    id: str
    kind: LayerKind
    name: str
    parameters: dict[str, Value] = field(default_factory=dict)
    strength: Strength = 1.0
    parts: list[str] = field(default_factory=list)
    span: list[float] | None = None
    ease: float = 0.25
    on: bool = True
    solo: bool = False


@dataclass(frozen=True)
class Stack:
    """All layers from first to last, how strong the whole is, and what is done at the end."""

    layers: list[Layer] = field(default_factory=list)
    strength: Strength = 1.0
    foot_plant: bool = True
    safe: bool = True


@dataclass(frozen=True)
class EditRequest:
    """Do a stack to a clip. ``live`` is a slider on its way: quick, not made safe.

    ``client`` and ``turn`` let newer requests of one page overtake older ones, which are answered with 409.
    """

    clip: str
    stack: Stack
    live: bool = False
    client: str = ""
    turn: int = 0


@dataclass(frozen=True)
class ExportRequest:
    """Give what a stack makes of a clip as a file. ``options`` are those of the kind, such as ``width``."""

    clip: str
    stack: Stack
    kind: ExportKind
    options: dict[str, Value] = field(default_factory=dict)
    client: str = ""


@dataclass(frozen=True)
class WorkInfo:
    """What is being worked out for a page.

    ``kind`` is that of the request (``edit``, ``export``), ``what`` is done now, ``share`` of all is behind
    (None: not known), ``seconds`` since it was asked for.
    """

    kind: str
    what: str
    share: float | None
    seconds: float


@dataclass(frozen=True)
class ClipInfo:
    """A clip that is open.

    ``id`` is the SHA-256 of its file; ``problem`` says why it can only be looked at. ``roles`` is which joint
    plays which role where a person said so ("" for a role that none plays), empty where it was found.
    """

    id: str
    name: str
    frames: int
    joints: int
    fps: float
    duration: float
    problem: str = ""
    roles: dict[str, str] = field(default_factory=dict)


@dataclass(frozen=True)
class RoleInfo:
    """A role of the body, the joint that plays it now ("" for none), and whether no body is without it."""

    role: str
    group: RoleGroup
    needed: bool
    joint: str


@dataclass(frozen=True)
class JointsInfo:
    """What roles are to be chosen from: the joints of a clip, parents first, and how deep each hangs."""

    roles: list[RoleInfo]
    joints: list[str]
    depths: list[int]


@dataclass(frozen=True)
class RolesRequest:
    """Say which joint plays which role, "" for none; without any, the body is as it is found."""

    roles: dict[str, str]


@dataclass(frozen=True)
class ParameterInfo:
    """One parameter of an edit, for a slider, a switch or a menu."""

    name: str
    kind: ValueKind
    doc: str
    default: Value
    low: float | None
    high: float | None
    neutral: float | None
    unit: str
    choices: list[str]
    optional: bool


@dataclass(frozen=True)
class EditInfo:
    """One edit: its kind (pose, rhythm, time, repair), what it does, and its parameters."""

    name: str
    kind: str
    summary: str
    parameters: list[ParameterInfo]


@dataclass(frozen=True)
class PresetInfo:
    """One emotion preset: what it does and how well that is known."""

    name: str
    description: str
    evidence: str


@dataclass(frozen=True)
class Word:
    """An emotion word and its place on the disc."""

    name: str
    valence: float
    arousal: float


@dataclass(frozen=True)
class Hello:
    """What the page needs to begin.

    ``learned`` are the labels that motions are read as, where they stand; a reading is a mean of them.
    ``parts`` are names for parts of the body, and what of. ``given`` are the ids of the clips named when the
    studio was started.
    """

    version: str
    samples: list[str]
    presets: list[PresetInfo]
    edits: list[EditInfo]
    words: list[Word]
    learned: list[Word]
    parts: dict[str, list[str]]
    roles: list[str]
    clips: list[ClipInfo]
    given: list[str]
    largest_upload: int


@dataclass(frozen=True)
class Place:
    """A point of the disc, and the word nearest to it."""

    valence: float
    arousal: float
    word: str


@dataclass(frozen=True)
class Why:
    """One reason for a reading."""

    what: str
    how_much: str
    pull: float


@dataclass(frozen=True)
class ReadingInfo:
    """What a motion expresses: its place, the likeliest labels with their probabilities, the reasons.

    ``against`` is ``neutral`` or, where that is a guess, ``usual``; ``placed`` is the share of the labels
    that have a place on the disc.
    """

    place: Place
    labels: list[tuple[str, float]]
    why: list[Why]
    against: str
    placed: float


@dataclass(frozen=True)
class Readings:
    """The clip by itself, what was asked for, and what the edit reached."""

    read: ReadingInfo
    asked: Place | None
    reached: ReadingInfo | None


@dataclass(frozen=True)
class MarkInfo:
    """A stretch of time in which a check fails, and the worst moment in it."""

    start: float
    end: float
    worst: float
    parts: list[str]


@dataclass(frozen=True)
class CheckInfo:
    """One check of the edited motion: its value, the source's, and what is allowed. None: not to be had."""

    name: str
    label: str
    unit: str
    digits: int
    value: float | None
    source: float | None
    allowed: float | None
    passed: bool
    marks: list[MarkInfo]


@dataclass(frozen=True)
class Checks:
    """All checks; ``times`` of the edited motion that failing spans refer to."""

    passed: bool
    checks: list[CheckInfo]


@dataclass(frozen=True)
class Curve:
    """One curve over time, before and after; ``times`` differ where an edit changes how long it takes."""

    name: str
    unit: str
    before_times: list[float]
    before: list[float]
    after_times: list[float]
    after: list[float]


@dataclass(frozen=True)
class CurvesRequest:
    """Ask for curves by name: ``hips height``, ``hand speed``, ``valence``, ``arousal`` or ``joint:NAME``."""

    clip: str
    stack: Stack
    names: list[str]


@dataclass(frozen=True)
class CopiedRequest:
    """Ask for an edit in words; ``name`` is the file that it is to write, without its ending."""

    clip: str
    stack: Stack
    name: str = ""


@dataclass(frozen=True)
class Copied:
    """The same edit for the command line and for Python."""

    command: str
    python: str


@dataclass(frozen=True)
class ProjectClip:
    """A clip of a project: by the hash of its file, with the roles of its joints as in ``ClipInfo``."""

    id: str
    name: str
    stack: Stack
    roles: dict[str, str] = field(default_factory=dict)


@dataclass(frozen=True)
class Project:
    """What a project file holds: clips by hash with their stacks, which one is shown, and the view."""

    clips: list[ProjectClip]
    current: str
    view: dict[str, Any] = field(default_factory=dict)
    mien_project: int = 1


@dataclass(frozen=True)
class Failure:
    """What went wrong, in one sentence."""

    error: str
