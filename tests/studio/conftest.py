"""A studio in a folder of its own, and a client that is let in."""

import json
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("fastapi", reason="the studio's packages are not installed")
pytest.importorskip("httpx2", reason="httpx2 is not installed")

from starlette.testclient import TestClient

from mien.formats import bvh
from mien.samples import walk
from mien.studio.security import hosts_of
from mien.studio.server import make_app
from mien.studio.session import Session
from mien.studio.workspace import Workspace

TOKEN = "t" * 40


@pytest.fixture
def workspace(tmp_path: Path) -> Workspace:
    return Workspace(tmp_path / "studio")


@pytest.fixture
def session(workspace: Workspace) -> Session:
    return Session(workspace)


@pytest.fixture
def stranger(session: Session) -> Iterator[TestClient]:
    """A client without the token."""
    app = make_app(session, token=TOKEN, hosts=hosts_of("127.0.0.1", 8765))
    with TestClient(app, base_url="http://127.0.0.1:8765", raise_server_exceptions=False) as client:
        yield client


@pytest.fixture
def client(stranger: TestClient) -> TestClient:
    """A client with it."""
    stranger.headers["Authorization"] = f"Bearer {TOKEN}"
    return stranger


@pytest.fixture
def clip(client: TestClient) -> str:
    """The id of a walk that is open."""
    data = bvh.render(walk(seconds=2.5).motion)
    return client.post("/api/clips", params={"name": "walk.bvh"}, content=data).json()["id"]


@pytest.fixture(scope="session")
def decode() -> Callable:
    """A reader of binary answers of its own."""
    return _decode


def _decode(data: bytes) -> tuple[dict, dict[str, np.ndarray]]:
    assert data[:4] == b"MIEN"
    length = int.from_bytes(data[4:8], "little")
    assert length % 4 == 0
    head, body = json.loads(data[8 : 8 + length]), data[8 + length :]
    arrays = {}
    for about in head["arrays"]:
        assert about["start"] % 4 == 0
        kind = np.dtype({"float32": "<f4", "uint8": "u1"}[about["type"]])
        count = int(np.prod(about["shape"]))
        arrays[about["name"]] = np.frombuffer(body, kind, count, about["start"]).reshape(about["shape"])
    return head, arrays
