"""``mien studio``: the local page where clips are edited and seen."""

from pathlib import Path
from typing import Annotated

import typer

from ..errors import MienError
from .report import complain, note

USUAL_PORT = 8765


def studio(
    clips: Annotated[
        list[str] | None,
        typer.Argument(metavar="CLIPS", help="Clips to open; more can be dropped on the page."),
    ] = None,
    port: Annotated[
        int, typer.Option(min=0, max=65535, help="Port to listen on; without it 8765, or a free one.")
    ] = 0,
    host: Annotated[
        str, typer.Option(help="Address to listen on; others than this machine can reach all but 127.0.0.1.")
    ] = "127.0.0.1",
    browser: Annotated[
        bool, typer.Option("--browser/--no-browser", help="Open the page in the browser, too.")
    ] = True,
    workspace: Annotated[
        Path | None,
        typer.Option(help="Folder to keep what is open in; without it one in this user's data."),
    ] = None,
) -> None:
    """Open the studio: a page on this machine where a clip's mood is changed and seen at once.

    mien studio walk.bvh

    It prints its address, keeps what is open for the next time, and ends with Ctrl-C.
    """
    try:
        from ..studio.run import serve
    except ImportError as error:
        raise MienError(
            f'the studio needs more packages ({error.name}): pip install "mien[studio]"'
        ) from None
    from ..studio.workspace import Workspace, usual_folder
    from .inputs import expand

    found = expand(clips) if clips else []
    server = serve(Workspace(workspace or usual_folder()), host=host, port=port, usual=USUAL_PORT)
    for clip in found:
        try:
            opened = server.session.open(clip.path.name, clip.path.read_bytes())
            server.session.given.append(opened.id)
        except (MienError, OSError) as error:
            complain(str(error))
    typer.echo(server.address)
    note("mien studio runs until Ctrl-C; keep the address to yourself, it lets in whoever has it")
    server.run(browser=browser)
