"""Server of a page: HTTP on 127.0.0.1 by the standard library, for the user of this machine.

Every address is one of a few names, so no request reaches another file. Requests that name another
host (DNS rebinding) or come from another page are refused, and so are bodies above a bound.
"""

from __future__ import annotations

import json
import sys
import threading
import urllib.parse
from collections.abc import Callable, Mapping
from http import HTTPStatus
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from importlib import resources
from typing import Any, NamedTuple, Self, TypeAlias

from texvent.errors import InputError, TexventError

HOST = "127.0.0.1"
CALL_BYTES = 2**16
"""Largest request."""
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
    """What a browser may do with it (Content-Security-Policy)."""


Gets: TypeAlias = Mapping[str, Callable[[Mapping[str, str]], Answer | None]]
Posts: TypeAlias = Mapping[str, Callable[[Mapping[str, Any]], None]]


class PageServer:
    """A page, served at once and until it is closed.

    Args:
        text: the page, HTML.
        gets: path → its answer, given the query; None where there is nothing.
        posts: path → action, given the values that the page's script sends; a `TexventError` is
            what the script receives.
        port: TCP port; 0: any free one.

    Raises:
        InputError: the port is taken.
    """

    def __init__(self, text: str, gets: Gets, posts: Posts, *, port: int = 0) -> None:
        self.gets: Gets = {"/": lambda query: Answer(text, HTML, POLICY), **gets}
        self.posts = posts
        try:
            self._server = _Server((HOST, port), _Handler)
        except OSError as error:
            reason = f"{error.strerror}; choose another port, or none"
            raise InputError(f"cannot listen on port {port}: {reason}") from error
        self._server.page = self  # type: ignore[attr-defined]
        self.address = f"http://{HOST}:{self._server.server_port}/"
        threading.Thread(target=self._server.serve_forever, daemon=True).start()

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

    def handle_error(self, request: Any, client_address: Any) -> None:
        """Nothing of a broken connection: the terminal belongs to the command."""
        if not isinstance(sys.exception(), OSError):
            super().handle_error(request, client_address)


class _Handler(BaseHTTPRequestHandler):
    """Checks requests and hands them to the page."""

    timeout = 20
    """Longest silence of a connection, s."""

    @property
    def page(self) -> PageServer:
        page: PageServer = self.server.page  # type: ignore[attr-defined]
        return page

    def do_GET(self) -> None:
        """The page, or a part of it."""
        if self._is_refused():
            return
        path, _, query = self.path.partition("?")
        get = self.page.gets.get(path)
        answer = None if get is None else get(dict(urllib.parse.parse_qsl(query)))
        if answer is None:
            self._refuse(HTTPStatus.NOT_FOUND, "there is no such page")
        else:
            self._send(answer)

    def do_POST(self) -> None:
        """An action."""
        if self._is_refused():
            return
        action = self.page.posts.get(self.path.partition("?")[0])
        if action is None:
            self._refuse(HTTPStatus.NOT_FOUND, "there is no such action")
            return
        try:
            action(self._json())
        except _RequestError as error:
            self._refuse(error.status, str(error))
        except TexventError as error:
            self._refuse(HTTPStatus.BAD_REQUEST, str(error))
        except (KeyError, TypeError) as error:
            self._refuse(HTTPStatus.BAD_REQUEST, f"a value is missing or unfit: {error}")
        else:
            self._send(Answer("{}"))

    def _is_refused(self) -> bool:
        """Refuse a request that names another host or comes from another page."""
        own = self.page.address.removeprefix("http://").rstrip("/")
        names = {own, own.replace(HOST, "localhost")}
        host, origin = self.headers.get("Host", ""), self.headers.get("Origin")
        site = self.headers.get("Sec-Fetch-Site", "none")
        is_foreign = site not in ("none", "same-origin") and (
            (self.command, self.path) != ("GET", "/")
            or self.headers.get("Sec-Fetch-Mode") != "navigate"
        )
        if host not in names:
            self._refuse(HTTPStatus.MISDIRECTED_REQUEST, "this page answers to localhost only")
        elif is_foreign or (origin is not None and origin.removeprefix("http://") not in names):
            self._refuse(HTTPStatus.FORBIDDEN, "requests from other pages are refused")
        else:
            return False
        return True

    def _json(self) -> dict[str, Any]:
        text = self.headers.get("Content-Length", "")
        if not (text.isascii() and text.isdigit()):
            raise _RequestError(HTTPStatus.LENGTH_REQUIRED, "the length is missing")
        if len(text) > 18 or int(text) > CALL_BYTES:
            message = f"the request is larger than {CALL_BYTES:,} bytes"
            raise _RequestError(HTTPStatus.REQUEST_ENTITY_TOO_LARGE, message)
        try:
            values = json.loads(self.rfile.read(int(text)) or "{}")
        except (ValueError, RecursionError) as error:
            raise _RequestError(HTTPStatus.BAD_REQUEST, "the request is no JSON") from error
        if not isinstance(values, dict):
            raise _RequestError(HTTPStatus.BAD_REQUEST, "the request is no JSON object")
        return values

    def _refuse(self, status: int, text: str) -> None:
        self.close_connection = True  # the body was not read
        self._send(Answer(text, "text/plain; charset=utf-8"), status)

    def _send(self, answer: Answer, status: int = HTTPStatus.OK) -> None:
        content, kind, policy = answer
        body = content.encode() if isinstance(content, str) else content
        headers = {**HEADERS, "Content-Type": kind, "Content-Security-Policy": policy}
        self.send_response(status)
        for name, value in headers.items():
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
