"""Small pictures of presets for the panel: one moment of the sample walk, edited; made once, then kept."""

from importlib.metadata import version
from io import BytesIO
from pathlib import Path

from ..emotion.presets import PRESETS, preset
from ..emotion.resolve import apply
from ..errors import MienError, unknown
from ..formats import files
from ..render import strip
from ..samples import walk

SECONDS, WIDTH, POSES = 2.4, 240, 3


def preset_picture(name: str, folder: Path) -> bytes:
    """Return the picture of a preset as PNG, kept in a folder; raises ``MienError`` for an unknown one."""
    if name not in PRESETS:
        raise MienError(unknown("preset", name, PRESETS))
    path = folder / "pictures" / version("mien") / f"{name.replace('/', '_')}.png"
    try:
        return path.read_bytes()
    except OSError:
        made = _picture(name)
    path.parent.mkdir(parents=True, exist_ok=True)
    files.write(path, made)
    return made


def _picture(name: str) -> bytes:
    motion = walk(seconds=SECONDS).motion
    picture = strip(apply(motion, preset(name)), poses=POSES, views=("side",), width=WIDTH, title="")
    data = BytesIO()
    picture.save(data, "PNG")
    return data.getvalue()
