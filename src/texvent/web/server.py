"""Server of the page: HTTP on 127.0.0.1 by the standard library, for the user of this machine.

Every address is one of a few names, so no request reaches another file. Requests that name another
host (DNS rebinding) or come from another page are refused, and so are bodies above a bound.
Prompts, scenes and videos may name files of this machine, as on the command line.
"""

from __future__ import annotations

import json
import shutil
import sys
import tempfile
import threading
from http import HTTPStatus
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from importlib import resources
from pathlib import Path
from typing import Any, Self

from texvent._registry import GENERATORS, SIMULATORS
from texvent.config import RunConfig
from texvent.errors import InputError
from texvent.sensor import SENSORS
from texvent.web.job import Job

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
    "object-src 'none'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'"
)
VIEWER_POLICY = (
    "sandbox allow-scripts; default-src 'none'; script-src 'unsafe-inline'; "
    "style-src 'unsafe-inline'; img-src data:; frame-ancestors 'self'"
)
NOTHING_POLICY = "default-src 'none'"
RESULTS = {
    "events": ("events.h5", "application/octet-stream", NOTHING_POLICY),
    "video": ("events.events.mp4", "video/mp4", NOTHING_POLICY),
    "page": ("events.events.html", "text/html; charset=utf-8", VIEWER_POLICY),
}
"""Files that a run writes, their kinds, and what a browser may do with them."""


class PageServer:
    """The page and its latest job, in a folder that is deleted at the end.

    Raises:
        InputError: the port is taken.
    """

    def __init__(self, *, port: int = 0) -> None:
        """Listen at once.

        Args:
            port: TCP port; 0: any free one.
        """
        self.folder = Path(tempfile.mkdtemp(prefix="texvent-app-"))
        self.job: Job | None = None
        self._jobs = 0
        self._lock = threading.Lock()
        try:
            self._server = _Server((HOST, port), _Handler)
        except OSError as error:
            self.close()
            reason = f"{error.strerror}; choose another port, or none"
            raise InputError(f"cannot listen on port {port}: {reason}") from error
        self._server.page = self  # type: ignore[attr-defined]
        self.address = f"http://{HOST}:{self._server.server_port}/"
        threading.Thread(target=self._server.serve_forever, daemon=True).start()

    def begin(self, command: str, options: list[str], subject: str) -> Job:
        """Start a job, which takes the place of the one before; arguments as those of `Job`."""
        with self._lock:
            self._jobs += 1
            if self.job is not None:
                self.job.stop()
                shutil.rmtree(self.job.folder, ignore_errors=True)
            folder = self.folder / f"job-{self._jobs}"
            folder.mkdir()
            self.job = Job(folder, command, options, subject)
            return self.job

    def close(self) -> None:
        """Stop the job and the server, and delete all files."""
        if self.job is not None:
            self.job.stop()
        if hasattr(self, "_server"):
            self._server.shutdown()
            self._server.server_close()
        shutil.rmtree(self.folder, ignore_errors=True)

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
    """Answers to the requests of the page."""

    timeout = 20
    """Longest silence of a connection, s."""

    @property
    def page(self) -> PageServer:
        page: PageServer = self.server.page  # type: ignore[attr-defined]
        return page

    def do_GET(self) -> None:
        """The page, the state of the job, or one of its files."""
        if self._is_refused():
            return
        path, job = self.path.partition("?")[0], self.page.job
        if path == "/":
            self._send(page_html(), "text/html; charset=utf-8", policy=POLICY)
        elif path == "/job":
            facts = {"state": "none", "text": ""} if job is None else job.describe()
            self._send(json.dumps(facts), "application/json")
        elif path[1:] in RESULTS and job is not None:
            self._result(job, path[1:])
        else:
            self._refuse(HTTPStatus.NOT_FOUND, "there is no such page")

    def do_POST(self) -> None:
        """Start or stop a job."""
        if self._is_refused():
            return
        path = self.path.partition("?")[0]
        try:
            if path == "/stop":
                if self.page.job is not None:
                    self.page.job.stop()
            elif path == "/run":
                self.page.begin(*_command(self._json()))
            else:
                self._refuse(HTTPStatus.NOT_FOUND, "there is no such page")
                return
        except _RequestError as error:
            self._refuse(error.status, str(error))
            return
        self._send("{}", "application/json")

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
            values = json.loads(self.rfile.read(int(text)))
        except (ValueError, RecursionError) as error:
            raise _RequestError(HTTPStatus.BAD_REQUEST, "the request is no JSON") from error
        if not isinstance(values, dict):
            raise _RequestError(HTTPStatus.BAD_REQUEST, "the request is no JSON object")
        return values

    def _result(self, job: Job, name: str) -> None:
        file, kind, policy = RESULTS[name]
        path = job.file(file)
        if path is None:
            self._refuse(HTTPStatus.NOT_FOUND, "there is no such result")
        else:
            self._send(path.read_bytes(), kind, policy=policy)

    def _refuse(self, status: int, text: str) -> None:
        self.close_connection = True  # the body was not read
        self._send(text, "text/plain; charset=utf-8", status=status)

    def _send(
        self,
        content: str | bytes,
        kind: str,
        *,
        status: int = HTTPStatus.OK,
        policy: str = NOTHING_POLICY,
    ) -> None:
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


def _command(values: dict[str, Any]) -> tuple[str, list[str], str]:
    """Command, flags and subject of the page's fields; empty fields are left to the defaults."""
    texts = {name: str(text).strip() for name, text in values.items()}
    video = texts.get("video", "")
    named: tuple[str, ...] = ("simulator", "preset", "sensor", "seed")
    if not video:
        named = (*named, "generator", "duration")
    flags = [f"--{name}={texts[name]}" for name in named if texts.get(name)]
    return ("simulate", flags, video) if video else ("generate", flags, texts.get("prompt", ""))


def page_html() -> str:
    """The page, with the names to choose from."""
    template = resources.files("texvent.web").joinpath("page.html").read_text(encoding="utf-8")
    choices = {
        "generators": GENERATORS.names(),
        "simulators": SIMULATORS.names(),
        "simulator": RunConfig.simulator,
        "presets": {name: list(SIMULATORS.load(name).presets) for name in SIMULATORS.names()},
        "sensors": list(SENSORS),
    }
    return template.replace("{{choices}}", json.dumps(choices).replace("<", "\\u003c"))
