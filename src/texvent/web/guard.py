"""What stands before the page: it checks where requests come from, how large and how slow they are.

An ASGI layer around any application; it knows nothing of Gradio but the names of its routes.
"""

from __future__ import annotations

import asyncio
import ipaddress
import secrets
import time
from collections.abc import Awaitable, Callable, Iterable, MutableMapping
from http.cookies import CookieError, SimpleCookie
from pathlib import Path
from typing import Any
from urllib.parse import unquote, urlsplit

Message = MutableMapping[str, Any]
Receive = Callable[[], Awaitable[Message]]
Send = Callable[[Message], Awaitable[None]]
Application = Callable[[Message, Receive, Send], Awaitable[None]]

SESSION = "texvent-session"
"""Cookie that tells one visitor's results from another's."""
LOOPBACK_NAMES = frozenset({"localhost", "127.0.0.1", "::1"})
PAGES = frozenset({"/", "/config", "/config/", "/favicon.ico", "/manifest.json", "/robots.txt"})
FOLDERS = ("/assets/", "/static/", "/svelte/", "/theme.css", "/results/")
API = "/gradio_api/"
FILE = f"{API}file="
CALLS = (
    *(
        f"{API}{name}"
        for name in ("queue/", "run/", "upload", "heartbeat/", "startup-events", "info")
    ),
    *(f"{API}{name}" for name in ("theme.css", "cancel", "reset")),
)
"""All that the page itself asks for; Gradio's other routes (proxies, monitoring) are closed."""
CALL_BYTES = 2**20
"""Largest request that is no upload."""
FORM_BYTES = 2**16
"""What a form adds to an uploaded file."""
SILENCE_S = 20.0
"""Longest wait for the next part of a request."""
GRACE_S = 15.0
SLOWEST_BYTES_PER_S = 16_000
"""Least mean rate of an upload once `GRACE_S` are over."""
HEADERS = {
    "x-content-type-options": "nosniff",
    "x-frame-options": "SAMEORIGIN",
    "referrer-policy": "no-referrer",
    "cross-origin-resource-policy": "same-origin",
    "content-security-policy": (
        "default-src 'self' data: blob: 'unsafe-inline' 'unsafe-eval'; object-src 'none'; "
        "base-uri 'self'; form-action 'self'; frame-ancestors 'self'"
    ),
}
"""Of every answer that does not say otherwise. Gradio needs inline scripts; no other host is asked
and no other page may frame this one."""


class Guard:
    """Refuses requests for other hosts, from other origins, for foreign files, too large or slow.

    Results lie at /results/; the application answers those by the session in the cookie.
    """

    def __init__(
        self,
        application: Application,
        *,
        host: str,
        allowed_hosts: Iterable[str] = (),
        upload_bytes: int,
        public_files: Path,
        before_upload: Callable[[], None] = lambda: None,
    ) -> None:
        """Prepare.

        Args:
            application: what answers the requests that pass.
            host: the address listened on.
            allowed_hosts: further names of this machine, such as that of a proxy.
            upload_bytes: largest uploaded file.
            public_files: the only folder whose files Gradio may serve.
            before_upload: called before an upload is taken.
        """
        self._application = application
        self._is_open = host not in LOOPBACK_NAMES
        self._names = {_bare(name) for name in (host, *allowed_hosts)} | LOOPBACK_NAMES
        self._upload_bytes = upload_bytes
        self._public_files = public_files.resolve()
        self._before_upload = before_upload

    async def __call__(self, scope: Message, receive: Receive, send: Send) -> None:
        """Answer one request."""
        if scope["type"] == "lifespan":
            await self._application(scope, receive, send)
            return
        if scope["type"] != "http":
            return  # The page uses no web sockets.
        headers = {
            name.decode("latin-1"): value.decode("latin-1") for name, value in scope["headers"]
        }
        session = session_of(headers.get("cookie", ""))
        reply = _Reply(send, new_session=None if session else secrets.token_urlsafe(24))
        refusal = self._refuse(scope, headers)
        if refusal is not None:
            await reply.refuse(*refusal)
            return
        is_upload = scope["path"].rstrip("/") == f"{API}upload"
        most = self._upload_bytes + FORM_BYTES if is_upload else CALL_BYTES
        if _length(headers) > most:
            await reply.refuse(413, f"the request is larger than {most:,} bytes")
            return
        if is_upload:
            await asyncio.to_thread(self._before_upload)
        body = _Body(receive, most, reply)
        try:
            await self._application(scope, body.receive, reply.send)
        except _BodyError as error:
            await reply.refuse(error.status, str(error))
        except Exception:
            # The application fails in its own way on a body that was cut off here.
            if body.refused is None:
                raise
        if body.refused is not None:
            await reply.refuse(body.refused.status, str(body.refused))

    def _refuse(self, scope: Message, headers: dict[str, str]) -> tuple[int, str] | None:
        host = headers.get("host", "")
        name = _bare(host)
        if name not in self._names and not (self._is_open and _is_address(name)):
            return 421, "this page does not answer to that host name; see texvent app --allow-host"
        origin = headers.get("origin")
        if origin is not None and not self._is_own(origin, host):
            return 403, "requests from other pages are refused"
        is_navigation = headers.get("sec-fetch-mode") == "navigate" and scope["method"] == "GET"
        if headers.get("sec-fetch-site") in ("cross-site", "same-site") and not is_navigation:
            return 403, "requests from other pages are refused"
        path = scope["path"]
        if path.startswith(FILE):
            asked = Path(unquote(path[len(FILE) :]))
            if asked.is_absolute() and asked.resolve().is_relative_to(self._public_files):
                return None
            return 403, "this file is not served"
        if path in PAGES or path.startswith((*FOLDERS, *CALLS)):
            return None
        return 404, "there is no such page"

    def _is_own(self, origin: str, host: str) -> bool:
        address = urlsplit(origin).netloc
        return bool(address) and (address == host or _bare(address) in self._names - LOOPBACK_NAMES)


def session_of(cookie: str) -> str | None:
    """The session in a Cookie header, or None."""
    try:
        morsel = SimpleCookie(cookie).get(SESSION)
    except CookieError:
        return None
    return morsel.value if morsel is not None and len(morsel.value) >= 32 else None


class _BodyError(Exception):
    def __init__(self, status: int, message: str) -> None:
        super().__init__(message)
        self.status = status


class _Body:
    """Passes on a request's body while it stays small and comes fast enough."""

    def __init__(self, receive: Receive, most: int, reply: _Reply) -> None:
        self._receive = receive
        self._most = most
        self._reply = reply
        self._seen = 0
        self._began = time.monotonic()
        self._is_complete = False
        self.refused: _BodyError | None = None

    async def receive(self) -> Message:
        if self._is_complete:
            return await self._receive()  # Waits for the visitor to leave.
        try:
            message = await asyncio.wait_for(self._receive(), SILENCE_S)
        except TimeoutError:
            raise self._refusal(408, "the request came too slowly") from None
        self._seen += len(message.get("body", b""))
        self._is_complete = not message.get("more_body", False)
        if self._seen > self._most:
            raise self._refusal(413, f"the request is larger than {self._most:,} bytes")
        seconds = time.monotonic() - self._began
        if not self._is_complete and seconds > GRACE_S + self._seen / SLOWEST_BYTES_PER_S:
            raise self._refusal(408, "the request came too slowly")
        return message

    def _refusal(self, status: int, message: str) -> _BodyError:
        self.refused = _BodyError(status, message)
        self._reply.is_closed = True
        return self.refused


class _Reply:
    """Passes on an answer with the headers of this page."""

    def __init__(self, send: Send, *, new_session: str | None) -> None:
        self._send = send
        self._new_session = new_session
        self._is_begun = False
        self.is_closed = False
        """True where the application's answer is no longer wanted."""

    async def send(self, message: Message) -> None:
        if self.is_closed:
            return
        if message["type"] == "http.response.start":
            self._is_begun = True
            message["headers"] = self._with_headers(list(message.get("headers", ())))
        await self._send(message)

    async def refuse(self, status: int, text: str) -> None:
        if self._is_begun:
            return
        self._is_begun = True
        body = text.encode()
        headers = [
            (b"content-type", b"text/plain; charset=utf-8"),
            (b"content-length", str(len(body)).encode()),
            (b"connection", b"close"),
        ]
        start = {"type": "http.response.start", "status": status}
        await self._send({**start, "headers": self._with_headers(headers)})
        await self._send({"type": "http.response.body", "body": body})

    def _with_headers(self, headers: list[tuple[bytes, bytes]]) -> list[tuple[bytes, bytes]]:
        given = {name.lower() for name, _ in headers}
        headers += [
            (name.encode(), value.encode())
            for name, value in HEADERS.items()
            if name.encode() not in given
        ]
        if self._new_session is not None:
            cookie = f"{SESSION}={self._new_session}; Path=/; HttpOnly; SameSite=Lax"
            headers.append((b"set-cookie", cookie.encode()))
        return headers


def _bare(host: str) -> str:
    """A host without its port and brackets, in lower case."""
    host = host.strip().lower()
    if host.startswith("["):
        return host[1:].partition("]")[0]
    return host if host.count(":") > 1 else host.partition(":")[0]


def _is_address(name: str) -> bool:
    """True for an IP address: no foreign name can lead a browser to ask for one."""
    try:
        ipaddress.ip_address(name)
    except ValueError:
        return False
    return True


def _length(headers: dict[str, str]) -> int:
    length = headers.get("content-length", "0")
    return int(length) if length.isascii() and length.isdigit() and len(length) < 20 else 0
