"""Pictures to the bytes of a GIF or MP4 file: the same pictures always give the same bytes."""

from collections.abc import Iterator
from fractions import Fraction
from io import BytesIO
from itertools import chain
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from ..errors import MienError
from ..typing import Array

if TYPE_CHECKING:
    from PIL.Image import Image

# Frames a second: the usual most, and the limit. Players slow a GIF down whose frames last under 20 ms.
LIMITS = {".gif": (30.0, 50.0), ".mp4": (30.0, 240.0)}
SETS = 6  # pictures that a GIF's palette is made from


def frame_rate(path: Path, own: float, wanted: float | None) -> float:
    """Return the film's frames a second; by default the clip's ``own`` or a whole part of it.

    Raises ``MienError`` for a file ending that is not known, or a rate the format cannot hold.
    """
    if path.suffix.lower() not in LIMITS:
        raise MienError(f"{path}: a film is a .gif or a .mp4 file")
    usual, most = LIMITS[path.suffix.lower()]
    if wanted is None:
        return own / max(1, int(np.ceil(own / usual - 0.01)))
    if not 0 < wanted <= most:
        raise MienError(f"fps must be above 0 and at most {most:g} for {path.suffix}, got {wanted:g}")
    return wanted


def encode(path: Path, pictures: Iterator[Array], fps: float) -> bytes:
    """Return the bytes of a film of ``pictures (H, W, 3)`` uint8, in the format of the file's ending."""
    return _gif(pictures, fps) if path.suffix.lower() == ".gif" else _mp4(pictures, fps)


def _gif(pictures: Iterator[Array], fps: float) -> bytes:
    from PIL import Image

    frames = [Image.fromarray(picture) for picture in pictures]
    palette = _palette(frames)
    indexed = [frame.quantize(palette=palette, dither=Image.Dither.NONE) for frame in frames]
    # A GIF counts in hundredths of a second: rounding the times, not the durations, keeps the length.
    times = np.rint(100.0 * np.arange(len(frames) + 1) / fps).astype(int) * 10
    out = BytesIO()
    indexed[0].save(
        out,
        "GIF",
        save_all=True,
        append_images=indexed[1:],
        duration=np.diff(times).tolist(),
        loop=0,
        optimize=False,
    )
    return out.getvalue()


def _palette(frames: "list[Image]") -> "Image":
    """Return one palette of 256 colours for all frames, from a few of them side by side."""
    from PIL import Image

    chosen = frames[:: max(1, len(frames) // SETS)]
    width, height = chosen[0].size
    together = Image.new("RGB", (width * len(chosen), height))
    for i, frame in enumerate(chosen):
        together.paste(frame, (i * width, 0))
    return together.quantize(256)


# With x264's macroblock tree small films differ from run to run, even on one thread.
X264 = {"crf": "20", "preset": "fast", "threads": "1", "x264-params": "mbtree=0"}


def _mp4(pictures: Iterator[Array], fps: float) -> bytes:
    """H.264 in yuv420p, which every player and browser shows; one thread, so that bytes repeat."""
    try:
        import av
    except ImportError as error:
        raise MienError("MP4 needs PyAV: pip install av (or write a .gif)") from error
    out = BytesIO()
    first = next(pictures)
    with av.open(out, "w", format="mp4", options={"fflags": "+bitexact"}) as film:
        stream = film.add_stream("libx264", rate=Fraction(fps).limit_denominator(1001), options=X264)
        stream.width, stream.height, stream.pix_fmt = first.shape[1], first.shape[0], "yuv420p"
        for picture in chain([first], pictures):
            film.mux(stream.encode(av.VideoFrame.from_ndarray(picture, format="rgb24")))
        film.mux(stream.encode())
    return out.getvalue()
