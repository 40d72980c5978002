"""Films read back by Pillow and PyAV."""

import sys

import av
import numpy as np
import pytest
from PIL import Image

from mien import samples
from mien.errors import FormatError, MienError
from mien.render import animate
from mien.render.ground import grid
from mien.render.solids import Camera, view_axes
from mien.render.video import frame_rate


@pytest.fixture(scope="module")
def walk():
    return samples.walk(seconds=1.0, fps=30).motion


def gif_frames(path):
    with Image.open(path) as film:
        durations = []
        for k in range(film.n_frames):
            film.seek(k)
            durations.append(film.info["duration"])
        return film.size, durations


def test_a_gif_has_the_frames_size_and_length_asked_for(tmp_path, walk):
    path = animate(walk, tmp_path / "walk.gif", fps=12, size=96)
    size, durations = gif_frames(path)
    assert size == (96, 96)
    assert len(durations) == 13
    assert sum(durations) == pytest.approx(13 / 12 * 1000, abs=10)


def test_an_mp4_is_h264_with_even_sizes(tmp_path, walk):
    path = animate(walk, tmp_path / "walk.mp4", fps=10, size=(101, 77))
    with av.open(str(path)) as film:
        stream = film.streams.video[0]
        frames = [frame.to_ndarray(format="rgb24") for frame in film.decode(stream)]
        assert stream.codec_context.name == "h264"
        assert stream.codec_context.pix_fmt == "yuv420p"
        assert stream.average_rate == 10
    assert len(frames) == 11
    assert frames[0].shape == (76, 100, 3)
    assert np.ptp(frames[5].astype(int), axis=2).max() > 80  # the colours of the limbs are there


def test_the_clips_own_rate_is_divided_by_a_whole_number(tmp_path):
    path = tmp_path / "a.gif"
    assert frame_rate(path, 30.0003, None) == pytest.approx(30.0, abs=0.01)
    assert frame_rate(path, 120.0, None) == 30.0
    assert frame_rate(path, 50.0, None) == 25.0
    assert frame_rate(path, 24.0, None) == 24.0


@pytest.mark.parametrize("suffix", [".gif", ".mp4"])
def test_the_same_motion_gives_the_same_bytes(tmp_path, walk, suffix):
    a, b = (animate(walk, tmp_path / f"{k}{suffix}", fps=8, size=64).read_bytes() for k in "ab")
    assert a == b


def test_it_tells_how_far_it_is_and_can_be_ended(tmp_path, walk):
    told = []
    animate(walk, tmp_path / "a.gif", fps=4, size=64, progress=lambda what, share: told.append((what, share)))
    assert told == [*(("drawing", k / 5) for k in range(5)), ("writing", None)]

    def enough(what, share):
        if share > 0.5:
            raise MienError("enough")

    with pytest.raises(MienError, match="enough"):
        animate(walk, tmp_path / "b.mp4", fps=4, size=64, progress=enough)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["a.gif"]


def test_before_and_after_stand_side_by_side_and_the_shorter_waits(tmp_path, walk):
    path = animate(walk, tmp_path / "both.gif", against=walk[:16], fps=10, size=80)
    size, durations = gif_frames(path)
    assert size == (160, 80)
    assert sum(durations) == pytest.approx(1100, abs=10)


def test_a_ghost_film_has_one_panel(tmp_path, walk):
    path = animate(walk, tmp_path / "ghost.gif", against=walk, beside=False, fps=5, size=80, view="side")
    assert gif_frames(path)[0] == (80, 80)


def test_one_frame(tmp_path, walk):
    assert len(gif_frames(animate(walk[:1], tmp_path / "one.gif", size=64))[1]) == 1


def test_the_camera_follows(tmp_path):
    """The walk goes several leg lengths; the figure stays in the middle of the picture."""
    path = animate(
        samples.walk(seconds=3.0, fps=30).motion, tmp_path / "far.gif", fps=3, size=120, view="side"
    )
    with Image.open(path) as film:
        for k in range(film.n_frames):
            film.seek(k)
            picture = np.asarray(film.convert("RGB")).astype(int)
            columns = np.nonzero(np.ptp(picture, axis=2) > 80)[1]
            assert abs(columns.mean() - 60) < 15


@pytest.mark.parametrize("view", ["three-quarter", "front", "top"])
def test_the_grid_stays_in_the_world_while_the_camera_moves(view):
    up, step = np.array([0.0, 1.0, 0.0]), 0.5
    axes = view_axes(view, up, np.array([0.0, 0.0, 1.0]))

    def floor(shift):
        canvas = np.full((100, 100, 3), 255.0, np.float32)
        point = np.array([shift, 0.0, 0.0])
        grid(canvas, Camera(axes, point, 50.0, 50.0, 60.0), up, point, 1.0, step)
        return canvas

    np.testing.assert_allclose(floor(0.0), floor(2 * step), atol=0.1)
    assert np.abs(floor(0.0) - floor(0.5 * step)).max() > 10


def test_mp4_without_pyav_says_how_to_get_it(tmp_path, walk, monkeypatch):
    monkeypatch.setitem(sys.modules, "av", None)
    with pytest.raises(MienError, match=r"MP4 needs PyAV: pip install av \(or write a \.gif\)"):
        animate(walk, tmp_path / "walk.mp4")
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("name", "options", "message"),
    [
        ("walk.avi", {}, r"\.gif or a \.mp4"),
        ("walk.gif", {"fps": 0}, "fps must be above 0"),
        ("walk.gif", {"fps": 60}, "at most 50"),
        ("walk.gif", {"size": 8}, "32 to 4096"),
        ("walk.gif", {"view": "beside"}, "no view 'beside'"),
    ],
)
def test_what_cannot_be_filmed_is_refused(tmp_path, walk, name, options, message):
    with pytest.raises(MienError, match=message):
        animate(walk, tmp_path / name, **options)


def test_an_existing_film_is_kept_unless_forced(tmp_path, walk):
    path = tmp_path / "walk.gif"
    path.write_bytes(b"mine")
    with pytest.raises(FormatError, match="exists already"):
        animate(walk[:2], path, size=64)
    assert path.read_bytes() == b"mine"
    animate(walk[:2], path, size=64, force=True)
    assert path.read_bytes()[:3] == b"GIF"


def test_a_missing_folder_is_named(tmp_path, walk):
    with pytest.raises(FormatError, match="there is no folder"):
        animate(walk, tmp_path / "none" / "walk.gif")
