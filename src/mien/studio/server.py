"""The studio's server: a few addresses under ``/api``, and the built page. Knows HTTP, works nothing out."""

import asyncio
import json
from collections.abc import AsyncIterator, Callable
from contextlib import asynccontextmanager
from dataclasses import asdict
from pathlib import Path
from threading import Event
from time import perf_counter
from typing import Any

from fastapi import FastAPI, Request, Response
from fastapi.exceptions import RequestValidationError
from fastapi.responses import JSONResponse, PlainTextResponse
from starlette.concurrency import run_in_threadpool
from starlette.staticfiles import StaticFiles

from ..emotion.safe import mended
from ..errors import FormatError, MienError, sentence
from ..formats import bvh
from ..render.wire import encode
from ..samples import SAMPLES
from . import answers
from .catalogue import SHOWN, hello
from .copied import copied
from .exports import TYPES, export, file_name
from .messages import (
    Checks,
    ClipInfo,
    Copied,
    CopiedRequest,
    Curve,
    CurvesRequest,
    EditRequest,
    ExportRequest,
    Hello,
    JointsInfo,
    Project,
    Readings,
    RolesRequest,
    WorkInfo,
)
from .naming import joints as joints_of
from .pictures import preset_picture
from .security import App, Guard
from .session import Session, SupersededError
from .square import encode_square
from .stack import asked
from .work import StoppedError

STATIC = Path(__file__).parent / "static"
LARGEST_UPLOAD = 256 * 2**20
LONGEST_UPLOAD = 120.0  # seconds
BINARY = "application/octet-stream"
NOT_BUILT = (
    "The studio's page is not part of this installation: it was not built. In a source tree, run\n"
    "  npm ci && npm run build\nin the folder frontend, and start the studio again.\n"
)


def make_app(session: Session, *, token: str, hosts: frozenset[str]) -> App:
    """Return the application for a session; ``hosts`` are the addresses it answers to."""
    app = FastAPI(docs_url=None, redoc_url=None, openapi_url=None)
    _failures(app)
    _clips(app, session)
    _edits(app, session)
    _exports(app, session)
    _projects(app, session)
    if (STATIC / "index.html").is_file():
        app.mount("/", StaticFiles(directory=STATIC, html=True))
    else:
        app.get("/")(lambda: PlainTextResponse(NOT_BUILT, 503))
    return Guard(app, hosts=hosts, token=token, largest_upload=LARGEST_UPLOAD)


def _failures(app: FastAPI) -> None:
    """Make every failure one sentence in JSON."""

    def answer(status: int) -> Callable[[Request, Exception], Response]:
        return lambda _, error: JSONResponse({"error": sentence(error)}, status)

    def misfit(_: Request, error: Exception) -> Response:
        found: Any = error.errors()[0] if isinstance(error, RequestValidationError) else {}
        where = ".".join(map(str, found.get("loc", ())[1:]))
        return JSONResponse({"error": f"the message does not fit: {where}: {found.get('msg', '')}"}, 422)

    app.add_exception_handler(SupersededError, answer(409))
    app.add_exception_handler(StoppedError, answer(409))
    app.add_exception_handler(MienError, answer(422))
    app.add_exception_handler(OSError, answer(500))
    app.add_exception_handler(Exception, answer(500))
    app.add_exception_handler(RequestValidationError, misfit)


def _clips(app: FastAPI, session: Session) -> None:
    @app.get("/api/hello")
    def greet() -> Hello:
        return hello(session.infos(), list(session.given), largest_upload=LARGEST_UPLOAD)

    @app.get("/api/clips")
    def clips() -> list[ClipInfo]:
        return session.infos()

    @app.post("/api/clips")
    async def upload(request: Request, name: str = "clip.bvh") -> ClipInfo:
        data = await _body(request)
        return await run_in_threadpool(session.open, name, data)

    @app.post("/api/samples/{name}")
    def sample(name: str) -> ClipInfo:
        if name not in SHOWN:
            raise MienError(f"there is no sample {name!r:.40}; there are {', '.join(SHOWN)}")
        return session.open(f"{name}.bvh", bvh.render(SAMPLES[name]().motion))

    @app.delete("/api/clips/{identity}")
    def close(identity: str) -> None:
        session.close(identity)

    @app.get("/api/clips/{identity}/motion")
    def motion(identity: str) -> Response:
        clip = session.clip(identity)
        return Response(encode(clip.motion, clip.id, like=clip.figure), media_type=BINARY)

    @app.get("/api/clips/{identity}/joints")
    def joints(identity: str) -> JointsInfo:
        return joints_of(session.clip(identity).motion)

    @app.post("/api/clips/{identity}/roles")
    def name(identity: str, request: RolesRequest) -> ClipInfo:
        with session.alone():
            return session.name_joints(identity, request.roles)

    @app.get("/api/presets/{name:path}.png")
    def picture(name: str) -> Response:
        return Response(preset_picture(name, session.workspace.folder), media_type="image/png")


def _edits(app: FastAPI, session: Session) -> None:
    @app.post("/api/edit")
    def edit(request: EditRequest) -> Response:
        with session.turn(request, "edit") as progress:
            start = perf_counter()
            clip = session.clip(request.clip)
            after = session.edited(clip.id, request.stack, live=request.live, progress=progress)
            said = {"steps": [step.edit for step in after.history], "notes": list(mended(after))}
            seconds = perf_counter() - start
            data = encode(after, clip.id, like=clip.figure, seconds=seconds, **said)
            return Response(data, media_type=BINARY)

    @app.post("/api/square")
    def square(request: EditRequest) -> Response:
        with session.turn(request, "square"):
            clip = session.clip(request.clip)
            return Response(encode_square(clip.motion, clip.id, like=clip.figure), media_type=BINARY)

    @app.post("/api/reading")
    def reading(request: EditRequest) -> Readings:
        with session.turn(request, "reading") as progress:
            clip = session.clip(request.clip)
            after = session.edited(clip.id, request.stack, live=request.live, progress=progress)
            return answers.readings(clip.motion, after, asked(request.stack))

    @app.post("/api/checks")
    def checks(request: EditRequest) -> Checks:
        with session.turn(request, "checks") as progress:
            clip = session.clip(request.clip)
            after = session.edited(clip.id, request.stack, live=request.live, progress=progress)
            return answers.checks(clip.motion, after)

    @app.post("/api/curves")
    def curves(request: CurvesRequest) -> list[Curve]:
        with session.alone():
            clip = session.clip(request.clip)
            after = session.edited(clip.id, request.stack)
            return answers.curves(clip.motion, after, request.names)

    @app.post("/api/copied")
    def copy(request: CopiedRequest) -> Copied:
        with session.alone():
            clip = session.clip(request.clip)
            roles = clip.motion.skeleton.roles
            recipe = session.recipe(clip.id, request.stack)
            out = f"{request.name}.bvh" if request.name else ""
            return copied(clip.name, request.stack, recipe, roles, out=out)

    @app.get("/api/progress")
    def progress(client: str) -> list[WorkInfo]:
        return session.works.of(client)


def _exports(app: FastAPI, session: Session) -> None:
    def made(request: ExportRequest, gone: Event) -> Response:
        with session.works.begun(request.client, "export", gone=gone) as progress:
            with session.alone():
                clip = session.clip(request.clip)
                recipe = session.recipe(clip.id, request.stack)
                after = session.edited(clip.id, request.stack, progress=progress)
            progress("making the file", None)
            data = export(request.kind, clip.motion, after, recipe, request.options, progress=progress)
        return _file(data, file_name(clip.name, request.kind), TYPES[request.kind])

    @app.post("/api/export")
    async def give(asking: Request, request: ExportRequest) -> Response:
        async with _listening(asking) as gone:
            return await run_in_threadpool(made, request, gone)


def _projects(app: FastAPI, session: Session) -> None:
    @app.get("/api/project")
    def project() -> Response:
        return JSONResponse(session.workspace.project())  # null where nothing was kept yet

    @app.put("/api/project")
    def keep(project: Project) -> None:
        session.workspace.keep_project(asdict(project))

    @app.post("/api/project/open")
    async def read(request: Request) -> Project:
        from pydantic import TypeAdapter, ValidationError

        data = await _body(request)
        try:
            found = TypeAdapter(Project).validate_python(json.loads(data))
        except (ValueError, ValidationError, RecursionError):
            raise FormatError("this is no project file of mien studio") from None
        await run_in_threadpool(take, found)
        return found

    def take(project: Project) -> None:
        with session.alone():
            session.take_roles(project)


@asynccontextmanager
async def _listening(request: Request) -> AsyncIterator[Event]:
    """Yield what is set when nobody waits for the answer any more."""
    gone = Event()

    async def listen() -> None:
        while (await request.receive())["type"] != "http.disconnect":
            pass
        gone.set()

    listening = asyncio.create_task(listen())
    try:
        yield gone
    finally:
        listening.cancel()


async def _body(request: Request) -> bytes:
    """Return the body of a request; raises ``FormatError`` where it comes too slowly."""
    try:
        async with asyncio.timeout(LONGEST_UPLOAD):
            return await request.body()
    except TimeoutError:
        raise FormatError("the file took too long to come") from None


def _file(data: bytes, name: str, kind: str) -> Response:
    from urllib.parse import quote

    return Response(
        data,
        media_type=kind,
        headers={"Content-Disposition": f"attachment; filename*=UTF-8''{quote(name)}"},
    )
