"""Small pictures of presets for the panel: one moment of the sample walk, edited; made once, then kept."""

from hashlib import sha256
from importlib.metadata import version
from io import BytesIO
from pathlib import Path

from ..emotion.presets import PRESETS, preset
from ..emotion.resolve import apply
from ..errors import MienError, unknown
from ..formats import files
from ..render import strip
from ..samples import walk

SECONDS = 2.4
SHEET, WIDTH, TOP, BOTTOM = 700, 200, 16, 26  # pixels: of the sheet, of the picture, what is cut off


def preset_picture(name: str, folder: Path) -> bytes:
    """Return the picture of a preset as PNG, kept in a folder; raises ``MienError`` for an unknown one."""
    if name not in PRESETS:
        raise MienError(unknown("preset", name, PRESETS))
    made_of = sha256(f"{version('mien')} {preset(name)!r}".encode()).hexdigest()
    path = folder / "pictures" / f"{made_of}.png"
    try:
        return path.read_bytes()
    except OSError:
        made = _picture(name)
    path.parent.mkdir(parents=True, exist_ok=True)
    files.write(path, made)
    return made


def _picture(name: str) -> bytes:
    motion = apply(walk(seconds=SECONDS).motion, preset(name))
    sheet = strip(motion, poses=1, views=("three-quarter",), width=SHEET, title="")
    # The figure stands in the middle of its sheet; the names of the view and the time are left off.
    width, height = sheet.size
    half = WIDTH // 2
    picture = sheet.crop((width // 2 - half, TOP, width // 2 + half, height - BOTTOM))
    data = BytesIO()
    picture.save(data, "PNG")
    return data.getvalue()
