"""Start the studio: find a port, print the address, serve until interrupted."""

import socket
import webbrowser
from dataclasses import dataclass
from threading import Thread, Timer

import uvicorn

from ..errors import MienError
from .security import App, hosts_of
from .server import make_app
from .session import Session
from .workspace import Workspace

WAIT = 0.6  # seconds from listening to opening the browser


@dataclass(frozen=True, eq=False)
class Server:
    """A server that listens already; ``run`` answers until it is interrupted."""

    session: Session
    address: str
    app: App
    listener: socket.socket

    def run(self, *, browser: bool) -> None:
        """Answer requests until Ctrl-C; with ``browser`` the page is opened."""
        Thread(target=_warm_up, daemon=True).start()
        if browser:
            timer = Timer(WAIT, webbrowser.open, [self.address])
            timer.daemon = True
            timer.start()
        config = uvicorn.Config(self.app, log_level="error", access_log=False, server_header=False)
        uvicorn.Server(config).run(sockets=[self.listener])


def serve(workspace: Workspace, *, host: str = "127.0.0.1", port: int = 0, usual: int = 0) -> Server:
    """Return a server for a workspace; ``port`` 0 is ``usual`` if that is free, else any that is.

    Raises ``MienError`` where the address cannot be listened on.
    """
    listener = _listener(host, port, usual)
    number = listener.getsockname()[1]
    session, token = Session(workspace), workspace.token()
    name = f"[{host}]" if ":" in host else host
    app = make_app(session, token=token, hosts=hosts_of(host, number))
    return Server(session, f"http://{name}:{number}/#token={token}", app, listener)


def _warm_up() -> None:
    """Do an edit once, so that what is imported when it is needed is there when the first slider moves."""
    from ..emotion.resolve import edit
    from ..samples import walk

    edit(walk(seconds=1.0).motion, "sad")


def _listener(host: str, port: int, usual: int) -> socket.socket:
    for number in [port] if port else [usual, 0]:
        try:
            return socket.create_server(
                (host, number), family=socket.AF_INET6 if ":" in host else socket.AF_INET, backlog=64
            )
        except OSError as error:
            refused = error
            if port or number == 0:
                break
    raise MienError(f"{host}:{port or usual} cannot be listened on ({refused.strerror or refused})")
