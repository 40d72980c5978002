"""Shared fixtures. Real clips are other people's and stay outside the project; tests skip without them."""

import os
from pathlib import Path

import pytest
from hypothesis import settings

ROOT = Path(__file__).resolve().parents[1]
DATA = Path(os.environ.get("MIEN_DATA", ROOT.parent / "shared" / "data"))


# How long an example takes says nothing on a busy machine. The same examples every time, so that a
# commit passes or fails whoever runs it; MIEN_FUZZ=1 looks for new ones.
settings.register_profile("mien", deadline=None, derandomize=True)
settings.register_profile("fuzz", deadline=None, max_examples=1000)
settings.load_profile("fuzz" if os.environ.get("MIEN_FUZZ") else "mien")


@pytest.fixture(scope="session")
def data() -> Path:
    """The folder of real clips (set MIEN_DATA to use another)."""
    if not DATA.is_dir():
        pytest.skip("no real clips: set MIEN_DATA to a folder that has them")
    return DATA
