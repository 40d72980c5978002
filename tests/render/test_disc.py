"""The disc of emotions: where dots and words are, in the page and in the picture."""

import re
from html.parser import HTMLParser
from xml.etree import ElementTree

import numpy as np
import pytest

import mien
from mien import samples
from mien.emotion.circumplex import QUADRANTS, words
from mien.errors import MienError
from mien.render import Dot, disc, disc_page
from mien.render.disc import MARGIN, SIZE, disc_shapes, disc_svg
from mien.render.shapes import INKS, Labels, Round, Stroke, Words, picture, svg

REACH = 0.5 * SIZE - MARGIN
SVG = "{http://www.w3.org/2000/svg}"


def dots_of(shapes: list) -> list[Round]:
    return [s for s in shapes if isinstance(s, Round) and s.ink in ("mark", "other")]


def test_dots_are_where_their_clips_are() -> None:
    dots = [Dot("right", 1.0, 0.0), Dot("up", 0.0, 1.0), Dot("low", -0.6, -0.8, guess=True)]
    right, up, low = dots_of(disc_shapes(dots))
    assert (right.x, right.y) == pytest.approx((0.5 * SIZE + REACH, 0.5 * SIZE))
    assert (up.x, up.y) == pytest.approx((0.5 * SIZE, 0.5 * SIZE - REACH))
    assert (low.x, low.y) == pytest.approx((0.5 * SIZE - 0.6 * REACH, 0.5 * SIZE + 0.8 * REACH))
    assert (right.filled, low.filled) == (True, False)
    assert right.ink != low.ink


def test_every_word_and_quadrant_is_named() -> None:
    said = {s.text for s in disc_shapes([]) if isinstance(s, Words)}
    assert said >= {*words(), *QUADRANTS.values(), "pleasant", "unpleasant", "intense", "mild"}


@pytest.mark.parametrize("size", [SIZE, 380.0])
def test_nothing_is_written_over_the_edge_or_over_another_word(size: float) -> None:
    dots = [Dot(f"clip {i}.bvh", *place) for i, place in enumerate([(0.9, 0.1), (-0.9, 0.1), (0.0, 0.0)])]
    boxes = [s.box for s in disc_shapes(dots, size=size) if isinstance(s, Words)]
    for i, (left, top, right, bottom) in enumerate(boxes):
        assert left >= 0 <= top
        assert max(right, bottom) <= size
        for other in boxes[:i]:
            assert left >= other[2] or right <= other[0] or top >= other[3] or bottom <= other[1]


def test_clips_at_one_place_lie_beside_each_other() -> None:
    shapes = dots_of(disc_shapes([Dot(str(i), -0.6, -0.2) for i in range(20)]))
    at = np.array([[s.x, s.y] for s in shapes])
    apart = np.linalg.norm(at[:, None] - at[None], axis=-1)[np.triu_indices(20, 1)]
    assert apart.min() >= 1.9 * shapes[0].radius
    assert np.linalg.norm(at - at[0], axis=1).max() < 0.11 * REACH


def test_many_clips_are_drawn_small_and_stay_near() -> None:
    many = dots_of(disc_shapes([Dot(str(i), 0.5, 0.5) for i in range(3000)]))
    assert len(many) == 3000
    assert many[0].radius < 3
    true = np.array([0.5 * SIZE + 0.5 * REACH, 0.5 * SIZE - 0.5 * REACH])
    assert max(np.hypot(s.x - true[0], s.y - true[1]) for s in many) < 0.11 * REACH


class Page(HTMLParser):
    """What a page is made of."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.tags: list[str] = []
        self.addresses: list[str] = []
        self.text = ""
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list) -> None:
        self.tags.append(tag)
        self.addresses += [value for name, value in attrs if name in ("src", "href", "onload", "onclick")]

    def handle_data(self, data: str) -> None:
        self.text += data


def test_a_page_needs_nothing_and_trusts_no_name() -> None:
    name = '<script>alert("x")</script> & "y\'.bvh'
    text = disc_page([Dot(name, 0.2, 0.3, said="<b>sad</b> 90 %")], title="<i>a title</i>")
    page = Page(text)
    assert not {"script", "b", "i", "img", "link", "iframe"} & set(page.tags)
    assert page.addresses == []
    assert name in page.text
    assert "<b>sad</b> 90 %" in page.text
    assert "a guess" not in page.text.split("ring is a guess")[1]
    assert not re.findall(r"(?:https?:)?//(?!www\.w3\.org/2000/svg)", text.replace("</", ""))


def test_the_names_are_under_the_pointer() -> None:
    tree = ElementTree.fromstring(disc_svg([Dot("a & b.bvh", 0.5, 0.1, said="happy 80 %"), Dot("", 0, 0)]))
    said = [title.text for title in tree.iter(f"{SVG}title")]
    assert said == ["a & b.bvh\nhappy 80 %"]
    assert "2 clips" in tree.attrib["aria-label"]


def test_the_picture_shows_what_the_page_shows() -> None:
    dots = [Dot("one", 0.5, -0.5), Dot("two", -0.5, 0.5, guess=True)]
    image = np.asarray(disc(dots, width=720)).astype(int)
    assert image.shape == (720, 720, 3)
    one, two = dots_of(disc_shapes(dots))
    assert image[round(one.y), round(one.x)] == pytest.approx(INKS["mark"].picture, abs=6)
    ring = image[round(two.y) - 6 : round(two.y) + 7, round(two.x) - 6 : round(two.x) + 7].reshape(-1, 3)
    assert (np.abs(ring - INKS["other"].picture).max(axis=1) < 40).any()
    with pytest.raises(MienError, match="at least 64 pixels"):
        disc(dots, width=10)


def test_a_reading_as_a_dot() -> None:
    found = mien.read(samples.walk(seconds=1.0).motion)
    dot = Dot.of("walk", found)
    assert (dot.valence, dot.arousal, dot.guess) == (*found.place, True)
    assert dot.said.startswith(next(iter(found.labels)))


def test_shapes_are_drawn_to_scale() -> None:
    """A line and a filled circle come out where they were laid out, at any size of the picture."""
    shapes = [Round(75.0, 25.0, 20.0), Stroke(0.0, 75.0, 100.0, 75.0, "ink")]
    for across in (100, 250):
        image = np.asarray(picture(shapes, 100.0, 100.0, across=across)).astype(int).sum(axis=2)
        dark = np.argwhere(image < 400) / across
        circle = dark[dark[:, 0] < 0.5]
        assert circle.mean(axis=0) == pytest.approx([0.25, 0.75], abs=0.02)
        assert np.ptp(circle, axis=0) == pytest.approx([0.4, 0.4], abs=0.05)
        assert dark[dark[:, 0] > 0.5].mean(axis=0) == pytest.approx([0.75, 0.5], abs=0.02)
    assert ElementTree.fromstring(svg(shapes, 100, 100, label='a "b"')).attrib["aria-label"] == 'a "b"'


def test_labels_give_up_where_there_is_no_room() -> None:
    labels = Labels(100.0, 100.0)
    labels.keep(50.0, 50.0, 200.0)
    how = {"away": 5.0, "size": 12.0, "ink": "ink"}
    first = labels.beside(50.0, 50.0, "name", **how)
    assert first.x == 55.0, "over a point only where there is no other room"
    assert labels.beside(2.0, 50.0, "name", **how).anchor == "start"
    assert labels.beside(98.0, 20.0, "name", **how).anchor == "end"
    labels.taken.append((0.0, 0.0, 100.0, 100.0))
    assert labels.beside(50.0, 50.0, "name", **how) is None
