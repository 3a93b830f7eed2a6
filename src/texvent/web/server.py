"""The web server: uvicorn in a thread, with bounds on connections that never finish a request."""

from __future__ import annotations

import socket
import threading
from typing import Any

from texvent._require import require
from texvent.errors import InputError

FIRST_PORT = 7860
PORTS_TRIED = 100
HEADER_S = 10.0
"""Longest wait for the head of a request."""
MAX_CONNECTIONS = 512
START_S = 30.0


class Server:
    """Serves an ASGI application until closed."""

    def __init__(self, application: Any, *, host: str, port: int) -> None:
        """Listen at once.

        Args:
            application: ASGI application.
            host: address to listen on.
            port: TCP port; 0 takes the first free one from 7860 on.

        Raises:
            InputError: the port is taken or the address is not one of this machine's.
        """
        uvicorn = require("uvicorn", extra="app")
        self._socket = _listen(host, port)
        config = uvicorn.Config(
            application,
            http=_impatient_protocol(),
            ws="none",
            log_level="critical",
            access_log=False,
            server_header=False,
            proxy_headers=False,
            limit_concurrency=MAX_CONNECTIONS,
            timeout_graceful_shutdown=1,
        )
        self._server = uvicorn.Server(config)
        self._thread = threading.Thread(
            target=self._server.run, kwargs={"sockets": [self._socket]}, daemon=True
        )
        self._host = host

    def start(self) -> str:
        """Serve in a thread; returns the page's address.

        Raises:
            InputError: the server does not start.
        """
        self._thread.start()
        waiting = threading.Event()
        for _ in range(int(START_S / 0.05)):
            if self._server.started:
                break
            if not self._thread.is_alive():
                raise InputError("the web server ended while it started; is gradio complete?")
            waiting.wait(0.05)
        name = "127.0.0.1" if self._host in ("0.0.0.0", "") else self._host
        name = f"[{name}]" if ":" in name else name
        return f"http://{name}:{self._socket.getsockname()[1]}/"

    def close(self) -> None:
        """End all connections and stop."""
        self._server.should_exit = True
        self._thread.join(timeout=10)
        self._socket.close()


def _listen(host: str, port: int) -> socket.socket:
    family = socket.AF_INET6 if ":" in host else socket.AF_INET
    ports = [port] if port else range(FIRST_PORT, FIRST_PORT + PORTS_TRIED)
    reason: OSError | None = None
    for one in ports:
        listener = socket.socket(family)
        listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            listener.bind((host.strip("[]"), one))
            listener.listen(128)
        except OSError as error:
            listener.close()
            reason = error
        else:
            return listener
    raise InputError(
        f"cannot listen on {host}, port {port or f'{FIRST_PORT} to {ports[-1]}'}: "
        f"{reason.strerror if reason else 'no port'}; choose others by --host and --port"
    )


def _impatient_protocol() -> type[Any]:
    """HTTP/1.1 by uvicorn, ending connections whose request never gets a complete head."""
    h11 = require("h11", extra="app")
    base: Any = require("uvicorn.protocols.http.h11_impl", extra="app").H11Protocol

    class ImpatientProtocol(base):  # type: ignore[misc]
        """A connection that waits `HEADER_S` for a head, however slowly its bytes come."""

        _timer: Any = None

        def connection_made(self, transport: Any) -> None:
            super().connection_made(transport)
            self._wait()

        def data_received(self, data: bytes) -> None:
            super().data_received(data)
            if self.conn.their_state is not h11.IDLE:
                self._forget()
            elif self._timer is None:
                self._wait()

        def connection_lost(self, error: Exception | None) -> None:
            self._forget()
            super().connection_lost(error)

        def _wait(self) -> None:
            self._timer = self.loop.call_later(HEADER_S, self.transport.abort)

        def _forget(self) -> None:
            if self._timer is not None:
                self._timer.cancel()
                self._timer = None

    return ImpatientProtocol
