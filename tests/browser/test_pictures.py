"""The documentation's pictures of the studio can be made, and show it as it is."""

import importlib.util
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest
from PIL import Image

ROOT = Path(__file__).resolve().parents[2]
SMALL = (170, 102)  # in which letters that other fonts set otherwise make no difference


def script() -> ModuleType:
    spec = importlib.util.spec_from_file_location("studio_pictures", ROOT / "scripts" / "studio_pictures.py")
    assert spec
    assert spec.loader
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


PICTURES = script()


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("pictures")
    PICTURES.make_all(folder, list(PICTURES.PICTURES))
    return folder


@pytest.mark.parametrize("name", PICTURES.PICTURES)
def test_the_picture_is_of_the_studio_as_it_is(name: str, made: Path) -> None:
    one, kept = (Image.open(folder / f"{name}.png") for folder in (made, PICTURES.TARGET))
    assert one.size[0] == kept.size[0]
    assert abs(one.size[1] - kept.size[1]) < 40, "other fonts move lines, by little"
    new, old = (np.asarray(picture.convert("RGB").resize(SMALL), float) for picture in (one, kept))
    assert new.std() > 8, "it is not blank"
    assert np.abs(new - old).mean() < 6.0, "run scripts/studio_pictures.py: the studio looks otherwise now"
