"""What a joint's name says: the side of the body and the roles it may play.

Exporters agree on words, not on meaning: a *shoulder* is the collar bone in one scheme and the upper
arm in the next, a *foot* the ankle or the toes. So a name gives a set of possible roles, and the
shape of the skeleton decides (``topology``, ``limbs``).
"""

import re
from functools import lru_cache

SIDE_WORDS = {"left": "left", "lft": "left", "l": "left", "right": "right", "rgt": "right", "r": "right"}
SIDE_SIGNS = {"左": "left", "右": "right"}

# Words that say nothing about the role: rigs, exporters, kinds of node.
_NOISE = (
    "joint jnt jt bone bn skel skeleton base cc rl mixamorig character bip biped def org fk ik rig root mot "
    "b sk ctrl"
)
_SILENT = frozenset(_NOISE.split())

_ROLE_WORDS = {
    "hips": "hips hip pelvis waist lowerbody 下半身 腰 センター",
    "spine": "spine abdomen ab abs torso lowerback back lowerspine stomach belly spinelower waist lumbar "
    "loback lowertorso 上半身 chest",
    "chest": "chest spine thorax upperback upperchest torso ribs ribcage uppertorso upback chestupper "
    "spineupper upperspine 上半身 back",
    "neck": "neck lowerneck upperneck necktwist neckbase 首",
    "head": "head face skull 頭",
    "collar": "collar clavicle clav shoulder shldr collarbone scapula innershoulder 肩",
    "shoulder": "shoulder shldr arm upperarm uparm uarm humerus upperarm armupper bicep 腕",
    "elbow": "elbow forearm lowerarm lowarm loarm farm radius ulna armlower ひじ",
    "wrist": "wrist hand handroot palm 手首",
    "hip": "hip upleg upperleg thigh femur uleg legupper leg 足",
    "knee": "knee leg shin calf lowerleg lowleg loleg tibia lleg leglower crus ひざ",
    "ankle": "ankle foot feet 足首",
    "toe": "toe toes toebase ball forefoot foot toefoot つま先",
}

ROLES_OF: dict[str, set[str]] = {}
for _role, _words in _ROLE_WORDS.items():
    for _word in _words.split():
        ROLES_OF.setdefault(_word, set()).add(_role)

# Parts that are never a role themselves, whatever role word stands beside them.
_EXTRA = re.compile(
    r"twist|share|roll|finger|thumb|index|mid|ring|pinky|pinkie|little|eye|jaw|tongue|teeth|breast|ribs|"
    r"end$|tip$|nub$|site|helper|buttock|glute|hipjoint|facial|metacarp|metatars|brow|lip|mouth|hair|ear$|weapon"
)
_SPLIT = re.compile(r"[A-Z]+(?=[A-Z][a-z])|[A-Z]?[a-z]+|[A-Z]+|[^\W\d_a-zA-Z]+")


@lru_cache(maxsize=4096)
def words(name: str) -> tuple[str, tuple[str, ...]]:
    """Return the side (``left``, ``right`` or ``""``) and the words of a name, lower case, in order."""
    bare = re.split(r"[:|]", name)[-1]
    side, found = "", []
    for sign, meaning in SIDE_SIGNS.items():
        if sign in bare:
            side, bare = meaning, bare.replace(sign, "")
    for word in (w.lower() for w in _SPLIT.findall(bare)):
        if word in SIDE_WORDS and not side:
            side = SIDE_WORDS[word]
        elif word not in _SILENT:
            found.append(word)
    return _peel(side, found)


def _peel(side: str, found: list[str]) -> tuple[str, tuple[str, ...]]:
    """Take a side written into the first word (``leftupleg``, ``lfemur``) off it."""
    if side or not found:
        return side, tuple(found)
    for prefix in sorted(SIDE_WORDS, key=len, reverse=True):
        rest = found[0].removeprefix(prefix)
        if rest != found[0] and ("".join([rest, *found[1:]]) in ROLES_OF or _EXTRA.match(rest)):
            return SIDE_WORDS[prefix], (rest, *found[1:])
    return side, tuple(found)


def side_of(name: str) -> str:
    """Return ``left``, ``right`` or ``""``."""
    return words(name)[0]


@lru_cache(maxsize=4096)
def key_of(name: str) -> str:
    """Return a name without its side, for comparing the two sides: digits are kept."""
    return "".join(words(name)[1]) + "".join(re.findall(r"\d+", name))


@lru_cache(maxsize=4096)
def roles_of(name: str) -> frozenset[str]:
    """Return the roles that a joint of this name may play, without side; empty if it says nothing."""
    key = "".join(words(name)[1])
    return frozenset() if _EXTRA.search(key) else frozenset(ROLES_OF.get(key, ()))


@lru_cache(maxsize=4096)
def is_extra(name: str) -> bool:
    """Say whether the name is that of a twist bone, finger, tip, eye or the like."""
    return _EXTRA.search("".join(words(name)[1])) is not None
