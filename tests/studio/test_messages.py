"""The page's types are those of the server."""

from collections.abc import Callable
from pathlib import Path
from types import ModuleType

import pytest

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture(scope="module")
def generator(script: Callable[[str], ModuleType]) -> ModuleType:
    return script("messages")


def test_the_types_of_the_page_are_current(generator: ModuleType) -> None:
    written = generator.TARGET.read_text(encoding="utf-8")
    assert written == generator.typescript(), f"run `{generator.COMMAND}` and commit what it wrote"


def test_how_types_are_written(generator: ModuleType) -> None:
    text = generator.typescript()
    assert "  labels: [string, number][];" in text
    assert '  kind: "emotion" | "edit" | "place";' in text
    assert "  span: number[] | null;" in text
    assert "  parameters: Record<string, boolean | number | string | string[] | number[][] | null>;" in text
