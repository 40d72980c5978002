"""Who may talk to the studio: this machine, this page, with this token; and what the page may do."""

import hmac
from collections.abc import Awaitable, Callable, MutableMapping
from typing import Any

from starlette.datastructures import Headers
from starlette.responses import JSONResponse

Scope = MutableMapping[str, Any]
Receive = Callable[[], Awaitable[MutableMapping[str, Any]]]
Send = Callable[[MutableMapping[str, Any]], Awaitable[None]]
App = Callable[[Scope, Receive, Send], Awaitable[None]]

UPLOAD = "/api/clips"
LARGEST_MESSAGE = 4 * 2**20
POLICY = (
    "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' blob: data:; "
    "connect-src 'self'; font-src 'self'; media-src blob:; base-uri 'none'; form-action 'none'; "
    "frame-ancestors 'none'"
)
HEADERS = {
    "Content-Security-Policy": POLICY,
    "X-Content-Type-Options": "nosniff",
    "Referrer-Policy": "no-referrer",
    "Cross-Origin-Opener-Policy": "same-origin",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Cache-Control": "no-store",
}


class Guard:
    """Lets in requests to one of ``hosts`` from pages of these hosts, to the API only with the token.

    A page of another site that knows the port is refused by its Origin, a name that was made to point here
    by the Host, another user of this machine by the token.
    """

    def __init__(self, app: App, *, hosts: frozenset[str], token: str, largest_upload: int) -> None:
        self.app, self.hosts, self.token, self.largest_upload = app, hosts, token, largest_upload

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Refuse a request, or pass it on; every answer gets the headers of ``HEADERS``."""
        if scope["type"] != "http":
            if scope["type"] == "lifespan":
                await self.app(scope, receive, send)
            return

        async def with_headers(message: MutableMapping[str, Any]) -> None:
            if message["type"] == "http.response.start":
                own = [(name.lower().encode(), value.encode()) for name, value in HEADERS.items()]
                names = {name for name, _ in own}
                there = [(k, v) for k, v in message.get("headers", []) if k.lower() not in names]
                message = {**message, "headers": [*there, *own]}
            await send(message)

        headers, path = Headers(scope=scope), scope["path"]
        refused = self._refusal(headers, path) or self._size(headers, path, scope["method"])
        answer: Any = self.app
        if refused:
            status, why = refused
            answer = JSONResponse({"error": why}, status)
        await answer(scope, receive, with_headers)

    def _refusal(self, headers: Headers, path: str) -> tuple[int, str] | None:
        if headers.get("host", "").lower() not in self.hosts:
            return 421, "this is not a name of the studio's address"
        origin = headers.get("origin")
        if origin is not None and origin.lower().removeprefix("http://") not in self.hosts:
            return 403, "another site may not use the studio"
        if headers.get("sec-fetch-site", "none") not in ("same-origin", "none"):
            return 403, "another site may not use the studio"
        if path.startswith("/api/"):
            given = headers.get("authorization", "").removeprefix("Bearer ")
            if not hmac.compare_digest(given.encode(), self.token.encode()):
                return 401, "this page has no key: open the address that mien studio printed"
        return None

    def _size(self, headers: Headers, path: str, method: str) -> tuple[int, str] | None:
        """Refuse a body without a length, or one that is too long; the server reads no more than it says."""
        if method in ("GET", "HEAD", "DELETE"):
            return None
        length = headers.get("content-length", "")
        if not length.isdecimal():
            return 411, "say how long the message is"
        most = self.largest_upload if path == UPLOAD else LARGEST_MESSAGE
        if int(length) > most:
            return 413, f"that is larger than {most // 2**20} MB, which is the most"
        return None


def hosts_of(host: str, port: int) -> frozenset[str]:
    """Return what may stand in the Host header of requests to an address."""
    names = {host, "127.0.0.1", "localhost", "[::1]"} if host in ("127.0.0.1", "localhost", "::1") else {host}
    return frozenset(f"[{n}]:{port}" if ":" in n and "[" not in n else f"{n}:{port}" for n in names)
