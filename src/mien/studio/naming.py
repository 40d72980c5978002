"""Which joint plays which role, said by a person where it is not found, or found wrongly."""

from collections.abc import Mapping
from dataclasses import replace

from ..errors import BodyError
from ..kinematics.body import OPTIONAL, ROLES, Body, guessed
from ..kinematics.roles import known_roles
from ..motion import Motion
from .messages import JointsInfo, RoleGroup, RoleInfo


def joints(motion: Motion) -> JointsInfo:
    """Return the roles with the joints that play them, as said or else as guessed, and all joints."""
    playing = guessed(motion) | dict(motion.skeleton.roles)
    roles = [RoleInfo(role, _group(role), role not in OPTIONAL, playing.get(role, "")) for role in ROLES]
    depths: list[int] = []
    for parent in motion.skeleton.parents.tolist():
        depths.append(depths[parent] + 1 if parent >= 0 else 0)
    return JointsInfo(sorted(roles, key=lambda one: not one.needed), list(motion.skeleton.names), depths)


def own_roles(motion: Motion, given: Mapping[str, str]) -> dict[str, str]:
    """Return the roles to keep for a clip of which a person says ``given``; none where it says nothing new.

    What is guessed and not given is kept as "", so that it is not guessed again. Raises ``BodyError`` in one
    sentence where a needed role or a joint is missing, one joint is given twice, or a limb does not hang
    together.
    """
    named = {role: name for role, name in known_roles(given, "roles").items() if name}
    if not named:
        return {}
    missing = [role for role in ROLES if role not in OPTIONAL and role not in named]
    if missing:
        raise BodyError(f"choose a joint for {_listed(missing)}: no body is without")
    found = guessed(motion)
    roles = named | {role: "" for role in found if role not in named}
    Body.of(with_roles(motion, roles))
    return {} if roles == found and fits(motion, {}) else roles


def with_roles(motion: Motion, roles: Mapping[str, str]) -> Motion:
    """Return the motion with the roles of its joints as they are said."""
    return motion.with_(skeleton=replace(motion.skeleton, roles=dict(roles)))


def fits(motion: Motion, roles: Mapping[str, str]) -> bool:
    """Say whether a motion has a body when the roles of its joints are these."""
    try:
        Body.of(with_roles(motion, roles))
    except BodyError:
        return False
    return True


def _group(role: str) -> RoleGroup:
    return "left" if role.startswith("left_") else "right" if role.startswith("right_") else "trunk"


def _listed(roles: list[str]) -> str:
    words = [role.replace("_", " ") for role in roles]
    return words[0] if len(words) == 1 else f"{', '.join(words[:-1])} and {words[-1]}"
