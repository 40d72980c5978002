"""The examples in the documentation of measures do what they say."""

import doctest

import numpy as np
import pytest

from mien.analysis import effort, hulls, laban, windows
from mien.kinematics import landmarks
from mien.signal import derivatives


@pytest.mark.parametrize(
    "module", [effort, hulls, laban, windows, landmarks, derivatives], ids=lambda m: m.__name__
)
def test_examples(module) -> None:
    found = doctest.testmod(module, extraglobs={"np": np})
    assert found.attempted > 0
    assert found.failed == 0
