"""The strip inside a notebook page."""

from base64 import b64decode
from html.parser import HTMLParser
from io import BytesIO

import numpy as np
from PIL import Image

from mien import samples
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
