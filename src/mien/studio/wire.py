"""Motions as bytes for the page; written where pictures are, so that a page without a server has them too."""

from ..render.wire import encode as encode
from ..render.wire import frames_of as frames_of
from ..render.wire import packed as packed
from ..render.wire import places as places
