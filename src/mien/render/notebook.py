"""A motion in a notebook: a small strip of poses inside the page itself."""

from base64 import b64encode
from html import escape
from io import BytesIO

from ..motion import Motion
from .strip import strip


def strip_html(motion: Motion, *, poses: int = 8, width: int = 900) -> str:
    """Return an ``<img>`` element that holds a strip of ``poses`` seen from the side, ``width`` pixels."""
    out = BytesIO()
    image = strip(motion, poses=poses, views=("side",), width=width)
    image.quantize(128).save(out, "PNG")
    text = f"{motion.name or 'motion'}: {len(motion)} frames, {motion.duration:.2f} s"
    data = b64encode(out.getvalue()).decode("ascii")
    return f'<img alt="{escape(text)}" width="{width}" src="data:image/png;base64,{data}">'
