"""Server of a page: HTTP on 127.0.0.1 by the standard library, for the user who started it.

Every address is one of a few names, so no request reaches another file. Requests that name another
host (DNS rebinding), come from another page or do not know the server's token are refused, and so
are bodies above a bound. A browser gets the token by the address that it opens first, and keeps it
as a cookie.
"""

from __future__ import annotations

import contextlib
import functools
import json
import secrets
import socket
import sys
import threading
import time
import urllib.parse
from collections.abc import Callable, Mapping
from http import HTTPStatus
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from importlib import resources
from io import BufferedIOBase
from typing import Any, NamedTuple, Self, TypeAlias

from texvent.errors import InputError, TexventError, one_line

HOST = "127.0.0.1"
CALL_BYTES, FILE_BYTES = 2**16, 2**32
"""Largest request, and largest file that a page sends."""
READ_S, SEND_S = 10.0, 60.0
"""Time that a whole request may take to arrive, and an answer to be taken, s."""
MOST_CONNECTIONS = 64
"""Requests that are arriving; a further one ends the oldest."""
NO_TOKEN = (
    "the token of this server is missing, or is that of a server that has ended; "
    "open the address that texvent printed when it started"
)
HEADERS = {
    "Cache-Control": "no-store",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Referrer-Policy": "no-referrer",
    "X-Content-Type-Options": "nosniff",
}
POLICY = (
    "default-src 'self'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; "
    "img-src 'self' data:; object-src 'none'; base-uri 'none'; form-action 'none'; "
    "frame-ancestors 'none'"
)
NOTHING_POLICY = "default-src 'none'"


HTML = "text/html; charset=utf-8"


class Answer(NamedTuple):
    """Answer to a request."""

    content: str | bytes
    kind: str = "application/json"
    policy: str = NOTHING_POLICY
    """Rights of a browser with it (Content-Security-Policy)."""


Gets: TypeAlias = Mapping[str, Callable[[Mapping[str, str]], Answer | None]]
Posts: TypeAlias = Mapping[str, Callable[[Mapping[str, Any]], None]]
Uploads: TypeAlias = Mapping[str, Callable[[str, BufferedIOBase, int], Answer]]


class PageServer:
    """A page, served at once and until it is closed.

    Args:
        text: the page, HTML.
        gets: path → its answer, given the query; None where there is nothing.
        posts: path → action, given the values that the page's script sends; a `TexventError` is
            what the script receives.
        uploads: path → what takes a file: its name, the connection and the number of bytes.
        port: TCP port; 0: any free one.

    Raises:
        InputError: the port is taken.
    """

    def __init__(
        self, text: str, gets: Gets, posts: Posts, uploads: Uploads | None = None, *, port: int = 0
    ) -> None:
        self.gets: Gets = {"/": lambda query: Answer(text, HTML, POLICY), **gets}
        self.posts, self.uploads = posts, uploads or {}
        try:
            self._server = _Server((HOST, port), _Handler)
        except OSError as error:
            reason = f"{error.strerror}; choose another port, or none"
            raise InputError(f"cannot listen on port {port}: {reason}") from error
        self._server.page = self
        port = self._server.server_port
        self.address = f"http://{HOST}:{port}/"
        self.token, self.cookie = secrets.token_urlsafe(), f"texvent-{port}"
        threading.Thread(target=self._server.serve_forever, daemon=True).start()

    @property
    def entry(self) -> str:
        """The address to open first, with the token: for the user's eyes alone."""
        return f"{self.address}?token={self.token}"

    def is_over(self) -> bool:
        """Whether the page needs no server any more."""
        return False

    def close(self) -> None:
        """Stop the server."""
        self._server.shutdown()
        self._server.server_close()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *error: object) -> None:
        self.close()


class _Server(ThreadingHTTPServer):
    """The server; a connection that breaks off ends silently."""

    request_queue_size = 128
    page: PageServer
    arriving: dict[socket.socket, float]
    """Connections whose request is not known to be the user's yet → when they began, s."""

    def __init__(self, *arguments: Any) -> None:
        self.arriving = {}
        super().__init__(*arguments)

    def process_request(self, request: Any, client_address: Any) -> None:
        """Answer a connection in a thread."""
        self.arriving[request] = time.monotonic()
        super().process_request(request, client_address)

    def service_actions(self) -> None:
        """After each connection, and twice a second: end those that are too old or too many."""
        connections = list(self.arriving.items())
        for place, (connection, began_s) in enumerate(connections, start=MOST_CONNECTIONS):
            if place < len(connections) or time.monotonic() - began_s > READ_S:
                self.arriving.pop(connection, None)
                with contextlib.suppress(OSError):
                    connection.shutdown(socket.SHUT_RDWR)

    def shutdown_request(self, request: Any) -> None:
        """Close a connection."""
        self.arriving.pop(request, None)
        super().shutdown_request(request)

    def handle_error(self, request: Any, client_address: Any) -> None:
        """Nothing of a broken connection: the terminal belongs to the command."""
        if not isinstance(sys.exception(), OSError):
            super().handle_error(request, client_address)


class _Handler(BaseHTTPRequestHandler):
    """Checks requests and hands them to the page."""

    server: _Server
    timeout = SEND_S

    def do_GET(self) -> None:
        """The page, or a part of it."""
        path, query = self._path
        get = self.server.page.gets.get(path)
        self._answer(get and functools.partial(get, query))

    def do_POST(self) -> None:
        """An action, or a file."""
        path, query = self._path
        action, take = self.server.page.posts.get(path), self.server.page.uploads.get(path)

        def act(action: Callable[[Mapping[str, Any]], None]) -> Answer:
            action(self._json())
            return Answer("{}")

        if take is None:
            self._answer(action and functools.partial(act, action))
        else:
            name = query.get("name", "")
            self._answer(lambda: take(name, self.rfile, self._length(FILE_BYTES)))

    def _answer(self, find: Callable[[], Answer | None] | None) -> None:
        """Send an answer, or one line why there is none."""
        if self._is_refused():
            return
        try:
            answer = find and find()
        except _RequestError as error:
            self._refuse(error.status, str(error))
        except TexventError as error:
            self._refuse(HTTPStatus.BAD_REQUEST, str(error))
        except Exception as error:  # noqa: BLE001  # whatever it is, the page must not wait for ever
            reason = f"{type(error).__name__}: {one_line(error)}"
            self._refuse(HTTPStatus.BAD_REQUEST, f"a value is missing or unfit ({reason})")
        else:
            if answer is None:
                self._refuse(HTTPStatus.NOT_FOUND, "there is no such page or action")
            else:
                self._send(answer)

    @property
    def _path(self) -> tuple[str, dict[str, str]]:
        path, _, query = self.path.partition("?")
        return path, dict(urllib.parse.parse_qsl(query))

    def _is_refused(self) -> bool:
        """Refuse a request of another host, another page, or one who does not know the token."""
        own = self.server.page.address.removeprefix("http://").rstrip("/")
        names = {own, own.replace(HOST, "localhost")}
        host, origin = self.headers.get("Host", ""), self.headers.get("Origin")
        site, (path, query) = self.headers.get("Sec-Fetch-Site", "none"), self._path
        is_foreign = site not in ("none", "same-origin") and (
            (self.command, path) != ("GET", "/") or self.headers.get("Sec-Fetch-Mode") != "navigate"
        )
        if host not in names:
            self._refuse(HTTPStatus.MISDIRECTED_REQUEST, "this page answers to localhost only")
        elif is_foreign or (origin is not None and origin.removeprefix("http://") not in names):
            self._refuse(HTTPStatus.FORBIDDEN, "requests from other pages are refused")
        elif (self.command, path) == ("GET", "/") and self._is_token(query.get("token", "")):
            self._hand_over_token(is_followed=site in ("none", "same-origin"))
        elif not any(map(self._is_token, self._cookies())):
            self._refuse(HTTPStatus.FORBIDDEN, NO_TOKEN)
        else:
            self.server.arriving.pop(self.connection, None)
            return False
        return True

    def _is_token(self, text: str) -> bool:
        return secrets.compare_digest(text.encode(), self.server.page.token.encode())

    def _cookies(self) -> list[str]:
        """Values of this server's cookie."""
        pairs = (one.strip().partition("=") for one in self.headers.get("Cookie", "").split(";"))
        return [value for name, _, value in pairs if name == self.server.page.cookie]

    def _hand_over_token(self, *, is_followed: bool) -> None:
        """Put the token into a cookie, and lead away from the address that shows it.

        A browser that another page or file led here sends no such cookie along a redirection;
        it does when the answer itself goes on to the page.
        """
        cookie = (
            f"{self.server.page.cookie}={self.server.page.token}; Path=/; HttpOnly; SameSite=Strict"
        )
        on = {"Location": "/"} if is_followed else {"Refresh": "0; url=/"}
        status = HTTPStatus.SEE_OTHER if is_followed else HTTPStatus.OK
        self._send(Answer("", HTML), status, {"Set-Cookie": cookie, **on})

    def _length(self, most: int) -> int:
        """Bytes of the body, not read yet."""
        text = self.headers.get("Content-Length", "")
        if not (text.isascii() and text.isdigit()):
            raise _RequestError(HTTPStatus.LENGTH_REQUIRED, "the length is missing")
        if len(text) > 18 or int(text) > most:
            message = f"the request is larger than {most:,} bytes"
            raise _RequestError(HTTPStatus.REQUEST_ENTITY_TOO_LARGE, message)
        return int(text)

    def _json(self) -> dict[str, Any]:
        try:
            values = json.loads(self.rfile.read(self._length(CALL_BYTES)) or "{}")
        except (ValueError, RecursionError) as error:
            raise _RequestError(HTTPStatus.BAD_REQUEST, "the request is no JSON") from error
        if not isinstance(values, dict):
            raise _RequestError(HTTPStatus.BAD_REQUEST, "the request is no JSON object")
        return values

    def _refuse(self, status: int, text: str) -> None:
        self.close_connection = True  # the body was not read
        self._send(Answer(text, "text/plain; charset=utf-8"), status)

    def _send(
        self,
        answer: Answer,
        status: int = HTTPStatus.OK,
        more: Mapping[str, str] | None = None,
    ) -> None:
        content, kind, policy = answer
        body = content.encode() if isinstance(content, str) else content
        headers = {**HEADERS, "Content-Type": kind, "Content-Security-Policy": policy}
        self.send_response(status)
        for name, value in {**headers, **(more or {})}.items():
            self.send_header(name, value)
        self.send_header("Content-Length", str(len(body)))
        self.end_headers()
        self.wfile.write(body)

    def log_message(self, format: str, *args: Any) -> None:
        """Nothing: the terminal belongs to the command."""


class _RequestError(Exception):
    def __init__(self, status: int, message: str) -> None:
        super().__init__(message)
        self.status = status


def page_text(name: str, choices: Mapping[str, Any]) -> str:
    """A page of this package, with the style that all share and the names to choose from."""
    folder = resources.files("texvent.web")
    template, style = (folder.joinpath(one).read_text("utf-8") for one in (name, "style.css"))
    names = json.dumps(choices).replace("<", "\\u003c")
    return template.replace("{{style}}", style).replace("{{choices}}", names)
