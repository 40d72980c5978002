"""What is open in the studio, and the edits that were made last: one thing is worked out at a time."""

from collections import OrderedDict
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path
from threading import Lock

from ..emotion.resolve import done
from ..errors import BodyError, FormatError, MienError
from ..formats import load
from ..kinematics.body import Body
from ..kinematics.roles import known_roles
from ..motion import Motion
from ..recipe import Recipe
from ..render.figure import Figure
from ..typing import Progress, untold
from .messages import ClipInfo, EditRequest, Project, Stack
from .naming import fits, own_roles
from .stack import recipe_of
from .work import Works
from .workspace import Workspace

KEPT = 6  # edits that are remembered, so that checks, curves and exports of one stack work it out once


class SupersededError(MienError):
    """A newer request of the same page has come."""


@dataclass(frozen=True, eq=False)
class Clip:
    """A clip that is open."""

    id: str
    name: str
    motion: Motion

    @cached_property
    def figure(self) -> Figure:
        """The clip as it is drawn."""
        return Figure.of(self.motion)

    @cached_property
    def problem(self) -> str:
        """Why it can only be looked at; empty where it can be edited."""
        try:
            Body.of(self.motion)
        except BodyError as error:
            return str(error)
        return ""

    def info(self) -> ClipInfo:
        """Return what the page shows of it in a list."""
        motion = self.motion
        joints = len(motion.skeleton)
        size = len(motion), joints, motion.fps, motion.duration
        return ClipInfo(self.id, self.name, *size, self.problem, dict(motion.skeleton.roles))


class Session:
    """The clips of a workspace, read when they are asked for, and what was made of them."""

    def __init__(self, workspace: Workspace) -> None:
        self.workspace = workspace
        self.works = Works()
        self.given: list[str] = []  # ids of the clips that were named when the studio was started
        self._lock = Lock()  # of what is worked out
        self._files = Lock()  # of what is open: the page is answered while an edit is worked out
        self._clips: dict[str, Clip] = {}
        self._edits: OrderedDict[tuple[str, str, bool], Motion] = OrderedDict()
        self._turns: dict[str, int] = {}

    def open(self, name: str, data: bytes) -> ClipInfo:
        """Open a clip from the bytes of its file; one that cannot be read leaves nothing behind.

        Where no body is found, and a person named the joints of an open clip of the same skeleton, they are
        named alike. Raises ``FormatError`` with what is wrong with it.
        """
        with self._files:
            known = set(self.workspace.names())
            identity = self.workspace.keep(name, data)
        try:
            if self.clip(identity).problem:
                self._keep_roles(identity, self._roles_of_others(identity))
            return self.clip(identity).info()
        except MienError as error:
            if identity not in known:
                self.close(identity)
            text = str(error).replace(self.workspace.path(identity).name, self.workspace_name(name))
            raise FormatError(text) from None

    @staticmethod
    def workspace_name(name: str) -> str:
        """Return the name that a clip is kept under."""
        from .workspace import plain_name

        return plain_name(name)

    def close(self, identity: str) -> None:
        """Close a clip."""
        with self._files:
            self.workspace.forget(identity)
        self._clips.pop(identity, None)

    def infos(self) -> list[ClipInfo]:
        """Return the clips that are open; one whose file was damaged meanwhile is left out."""
        found = []
        for identity in self.workspace.names():
            try:
                found.append(self.clip(identity).info())
            except MienError:
                continue
        return found

    def clip(self, identity: str) -> Clip:
        """Return an open clip; raises ``FormatError`` where there is none of that id."""
        known = self._clips.get(identity)
        if known is None:
            path = self.workspace.path(identity)
            name = self.workspace.names().get(identity)
            if name is None:
                raise FormatError("that clip is not open any more; open its file again")
            motion = load(path, roles=self.workspace.roles(identity)).with_(name=Path(name).stem)
            known = self._clips[identity] = Clip(identity, name, motion)
        return known

    def name_joints(self, identity: str, roles: Mapping[str, str]) -> ClipInfo:
        """Say which joint of a clip plays which role, from now on; raises ``BodyError`` where that cannot be.

        Without any roles the body is as it is found.
        """
        self._keep_roles(identity, own_roles(self.clip(identity).motion, roles))
        return self.clip(identity).info()

    def take_roles(self, project: Project) -> None:
        """Keep the roles that a project file says for its clips, open or not."""
        for clip in project.clips:
            if clip.roles:
                self._keep_roles(clip.id, known_roles(clip.roles, clip.name))

    def _keep_roles(self, identity: str, roles: Mapping[str, str]) -> None:
        with self._files:
            self.workspace.keep_roles(identity, roles)
        self._clips.pop(identity, None)
        for key in [key for key in list(self._edits) if key[0] == identity]:
            self._edits.pop(key, None)

    def _roles_of_others(self, identity: str) -> dict[str, str]:
        """Return the roles that a person named in this clip, or else in an open one of its skeleton."""
        motion, own = self.clip(identity).motion, self.workspace.roles(identity)
        others = (self.workspace.roles(other) for other in self.workspace.names())
        return next((roles for roles in (own, *others) if roles and fits(motion, roles)), own)

    def recipe(self, identity: str, stack: Stack) -> Recipe:
        """Return the recipe of a stack for a clip."""
        return recipe_of(stack, self.clip(identity).motion)

    def edited(
        self, identity: str, stack: Stack, *, live: bool = False, progress: Progress = untold
    ) -> Motion:
        """Return what a stack makes of a clip; ``live`` without making it safe."""
        key = (identity, repr(stack), live)
        if key not in self._edits:
            recipe = self.recipe(identity, stack)
            recipe = replace(recipe, safe=recipe.safe and not live)
            self._edits[key] = done(self.clip(identity).motion, recipe, progress=progress)
        self._edits.move_to_end(key)
        while len(self._edits) > KEPT:
            self._edits.popitem(last=False)
        return self._edits[key]

    @contextmanager
    def turn(self, request: EditRequest, kind: str) -> Iterator[Progress]:
        """Wait for the turn of a request; raises ``SupersededError`` where a newer one of its kind has come.

        ``kind`` keeps apart what does not replace each other, such as an edit and its checks. Yields who is
        to be told how the work goes on, and ends it by the same error where a newer request comes meanwhile.
        """
        channel = f"{request.client}/{kind}"
        if request.client:
            self._turns[channel] = max(request.turn, self._turns.get(channel, request.turn))
        with self.works.begun(request.client, kind) as tell:

            def go_on(what: str, share: float | None) -> None:
                if request.client and request.turn < self._turns[channel]:
                    raise SupersededError("a newer request has come")
                tell(what, share)

            with self._lock:
                go_on("beginning", None)
                yield go_on

    @contextmanager
    def alone(self) -> Iterator[None]:
        """Wait until nothing else is worked out."""
        with self._lock:
            yield
