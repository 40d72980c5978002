"""The roles of a body, the user's map of them, and what follows from them: limbs and body parts."""

import tomllib
from collections.abc import Mapping
from itertools import pairwise
from pathlib import Path
from typing import Any

from ..errors import BodyError, unknown
from ..motion import Skeleton
from .topology import SIDES as SIDES
from .topology import TRUNK as TRUNK
from .tree import Tree

ARM, LEG = ("collar", "shoulder", "elbow", "wrist"), ("hip", "knee", "ankle", "toe")
ROLES = (*TRUNK, *(f"{s}_{r}" for s in SIDES for r in ARM + LEG))
OPTIONAL = {*TRUNK[1:], *(f"{s}_{r}" for s in SIDES for r in ("collar", "wrist", "toe"))}


def read_map(path: str | Path) -> dict[str, str]:
    """Return role -> joint name from a map file: TOML with one table, ``[roles]``.

    ``hips = "pelvis"`` says that the joint named pelvis is the hips, ``chest = ""`` that there is no chest.
    Raises ``BodyError`` if the file cannot be read, is not TOML, or names a role that does not exist.
    """
    try:
        content = tomllib.loads(Path(path).read_text(encoding="utf-8"))
    except FileNotFoundError:
        raise BodyError(f"{path}: there is no such file") from None
    except OSError as error:
        raise BodyError(f"{path}: cannot be read: {error.strerror or error}") from None
    except ValueError as error:
        raise BodyError(f"{path}: is not valid TOML: {error}") from None
    table = content.get("roles")
    if set(content) != {"roles"} or not isinstance(table, dict):
        raise BodyError(f'{path}: a map file has one table of roles, e.g.\n[roles]\nhips = "pelvis"')
    return known_roles(table, str(path))


def format_map(roles: Mapping[str, str]) -> str:
    """Return the text of a map file, which ``read_map`` reads back to the same roles."""
    import tomli_w

    return tomli_w.dumps({"roles": {role: roles[role] for role in ROLES if role in roles}})


def known_roles(table: Any, where: str) -> dict[str, str]:
    """Return a table of role -> joint name; ``BodyError``, naming ``where``, if it is none."""
    if not isinstance(table, Mapping):
        raise BodyError(f"{where} must be a table of roles, got {table!r:.80}")
    for role, name in table.items():
        if role not in ROLES:
            raise BodyError(f"{where}: {unknown('role', role, ROLES)}")
        if not isinstance(name, str):
            raise BodyError(f"{where}: {role} must be a joint name in quotes, got {name!r}")
    return dict(table)


def chosen(skeleton: Skeleton, names: Mapping[str, str]) -> dict[str, int]:
    """Return role -> joint for a user's role -> name; without those that are said to be missing ("").

    Raises ``BodyError`` with the nearest names.
    """
    out = {}
    for role, name in names.items():
        if role not in ROLES:
            raise BodyError(unknown("role", role, ROLES))
        if not name:
            continue
        if name not in skeleton.names:
            raise BodyError(f"{role}: {unknown('joint', name, skeleton.names)}")
        out[role] = skeleton.names.index(name)
    return out


def require(skeleton: Skeleton, roles: Mapping[str, int]) -> None:
    """Raise ``BodyError`` with the lines to add to a map file if a needed role is missing."""
    missing = [role for role in ROLES if role not in roles and role not in OPTIONAL]
    if not missing:
        return
    lines = "\n".join(f'{role} = "..."' for role in missing)
    raise BodyError(
        f"not found in this skeleton of {len(skeleton)} joints: {', '.join(missing)}. "
        f"Its joints are: {', '.join(skeleton.names)}. If it is a whole humanoid, write these lines "
        f"with its joint names into a file and give it with --map FILE:\n[roles]\n{lines}"
    )


def check(tree: Tree, roles: Mapping[str, int]) -> None:
    """Raise ``BodyError`` if roles share a joint or a limb does not hang together (a wrong map)."""
    taken: dict[int, str] = {}
    for role, joint in roles.items():
        if joint in taken:
            raise BodyError(f"{taken[joint]} and {role} are both the joint {tree.names[joint]!r}")
        taken[joint] = role
    for above, below in _LINES:
        if above in roles and below in roles and not tree.between(roles[above], roles[below]):
            raise BodyError(
                f"{below} ({tree.names[roles[below]]!r}) does not hang below {above} "
                f"({tree.names[roles[above]]!r}); one of them is another joint"
            )
    for role in ("hip", "shoulder"):
        for one, other in (SIDES, SIDES[::-1]):
            a, b = f"{one}_{role}", f"{other}_{role}"
            if tree.between(roles[a], roles[b]):
                raise BodyError(
                    f"{b} ({tree.names[roles[b]]!r}) hangs below {a} ({tree.names[roles[a]]!r}): they are "
                    "the two sides of one body, so one of them is another joint"
                )


_LINES = (
    *(("hips", r) for r in ("spine", "chest", "neck", "head")),
    *(("hips", f"{s}_{r}") for s in SIDES for r in ("hip", "shoulder")),
    *((f"{s}_{a}", f"{s}_{b}") for s in SIDES for chain in (ARM, LEG) for a, b in pairwise(chain)),
)


def limbs(roles: Mapping[str, int]) -> dict[str, tuple[int, ...]]:
    """Return limb -> its joints that play a role, from the root to the tip."""
    chains: dict[str, tuple[str, ...]] = {"head": ("neck", "head")}
    for side in SIDES:
        chains[f"{side}_arm"] = tuple(f"{side}_{r}" for r in ARM)
        chains[f"{side}_leg"] = tuple(f"{side}_{r}" for r in LEG)
    return {limb: tuple(roles[r] for r in chain if r in roles) for limb, chain in chains.items()}


def parts(tree: Tree, roles: Mapping[str, int], neck: tuple[int, ...]) -> tuple[str, ...]:
    """Return for each joint the part it belongs to: head, torso, a limb, or "" outside the hips."""
    roots = {j: "head" for j in (*neck, roles.get("head", -1)) if j >= 0}
    for kind, role in (("leg", "hip"), ("arm", "shoulder")):
        pair = [roles[f"{side}_{role}"] for side in SIDES]
        junction = tree.common(pair)
        for side, joint in zip(SIDES, pair, strict=True):
            roots[tree.between(junction, joint)[0]] = f"{side}_{kind}"
    roots[roles["hips"]] = "torso"
    out: list[str] = []
    for joint in range(len(tree.names)):
        parent = tree.parents[joint]
        out.append(roots.get(joint, out[parent] if parent >= 0 else ""))
    return tuple(out)
