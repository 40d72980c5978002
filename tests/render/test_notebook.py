"""What notebooks show inside a page: the strip of a motion, readings and features."""

import dataclasses
import re
from base64 import b64decode
from html.parser import HTMLParser
from io import BytesIO
from xml.etree import ElementTree

import numpy as np
from PIL import Image

import mien
from mien import samples
from mien.analysis.laban_table import COMPONENTS, SELECTED
from mien.render import strip_html


def test_the_page_holds_a_small_picture_of_the_motion():
    class Tags(HTMLParser):
        found = ()

        def handle_starttag(self, tag, attrs):
            self.found += ((tag, dict(attrs)),)

    parser = Tags()
    text = strip_html(samples.walk(seconds=1.0).motion.with_(name='a "<walk>'))
    parser.feed(text)
    [(tag, attributes)] = parser.found
    assert tag == "img"
    assert attributes["alt"].startswith('a "<walk>: 61 frames')
    kind, data = attributes["src"].split(",")
    assert kind == "data:image/png;base64"
    assert len(text) < 150_000
    with Image.open(BytesIO(b64decode(data))) as image:
        assert image.width == 900
        assert np.ptp(np.asarray(image.convert("RGB")).astype(int), axis=2).max() > 80


def svgs(text):
    """Every <svg> of a page, parsed: so it is well-formed, and names are escaped."""
    return [ElementTree.fromstring(part) for part in re.findall(r"<svg.*?</svg>", text, re.DOTALL)]


def texts(tree):
    return [element.text for element in tree.iter("{http://www.w3.org/2000/svg}text")]


def test_a_reading_shows_the_disc_the_labels_and_the_reasons():
    walk = samples.walk(seconds=3.0).motion
    found = mien.read(mien.edit(walk, "sad"))
    page = found._repr_html_()
    disc, bars = svgs(page)
    assert (
        len([c for c in disc.iter("{http://www.w3.org/2000/svg}circle") if c.get("fill") == "#3d84cc"]) == 1
    )
    said = texts(bars)
    assert any("mild and unpleasant" in line for line in said)
    assert f"{100 * found.labels['sad']:.0f} %" in said
    for reason in found.why:
        assert reason.what in said
        assert reason.how_much in said
    assert "against its neutral clip" in said
    assert "http" not in page.replace("http://www.w3.org/2000/svg", "")
    assert "a guess" in mien.read(walk)._repr_html_()


def test_a_hostile_label_stays_a_text():
    found = mien.read(samples.walk(seconds=1.0).motion)
    hostile = dataclasses.replace(found, labels={"<script>x</script>": 0.9, "a & b": 0.1})
    page = hostile._repr_html_()
    assert "<script" not in page
    assert "<script>x</script>" in texts(svgs(page)[1])


def test_neutral_has_no_reasons():
    walk = samples.walk(seconds=2.0).motion
    assert not any("speaks" in line for line in texts(svgs(mien.read(walk, neutral=walk)._repr_html_())[1]))


def test_features_show_the_selected_ones_with_bars():
    found = mien.features(samples.walk(seconds=2.0).motion)
    [tree] = svgs(found._repr_html_())
    said = texts(tree)
    for d in SELECTED:
        assert d.name.replace("_", " ") in said
    bars = [float(r.get("width")) for r in tree.iter("{http://www.w3.org/2000/svg}rect")]
    assert len(bars) == len(SELECTED) == 31
    shown = [row for c in COMPONENTS for row in found.table() if row.feature.feature.component == c]
    values = np.array([row.value for row in shown if row.feature.selected])
    units = np.array([row.feature.feature.unit for row in shown if row.feature.selected])
    of_heights = np.array(bars)[units == "heights"], values[units == "heights"]
    shares = [numbers / numbers.max() for numbers in of_heights]
    np.testing.assert_allclose(*shares, atol=0.01)


def test_text_takes_the_colour_of_the_page():
    """So it is read on light and on dark pages alike; nothing paints a background."""
    page = mien.read(samples.walk(seconds=1.0).motion)._repr_html_()
    for tree in svgs(page):
        colours = {e.get("fill") for e in tree.iter("{http://www.w3.org/2000/svg}text")}
        assert colours == {"currentColor"}
    assert "background" not in page
