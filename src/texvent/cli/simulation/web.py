"""`texvent app`: the web page, on this machine unless told otherwise."""

from __future__ import annotations

import signal
import sys
import threading
import webbrowser
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import ClassVar

from texvent._registry import GENERATORS
from texvent.cli.notices import write_out
from texvent.cli.options import parse_configs
from texvent.config import check_range
from texvent.errors import ConfigError
from texvent.web.gradio_page import WebPage
from texvent.web.limits import Limits
from texvent.web.workspace import Workspace

DESCRIPTION = """Open the web page: type a prompt or drop a video, look at the events, download
them in any format. It needs the extra "app": pip install 'texvent[app]'

Only this machine can reach the page. --host 0.0.0.0 opens it to the network: then anybody there
can make this machine work; put it behind a server that asks for a password."""
LOOPBACK = "127.0.0.1"
WAIT_S = 0.5


@dataclass(frozen=True, kw_only=True)
class AppOptions:
    """Where the page is served, and what it offers."""

    short_flags: ClassVar[Mapping[str, str]] = {"quiet": "-q"}

    host: str = LOOPBACK
    """Address to listen on; 127.0.0.1 is reached from this machine only."""
    port: int = 0
    """TCP port; 0 takes the first free one from 7860 on."""
    allow_host: str = ""
    """Further host names that the page answers to, separated by commas, such as that of a proxy
    before it."""
    generators: str = next(iter(GENERATORS.builtin))
    """Generators that visitors may choose, separated by commas."""
    browser: bool = True
    """Open the page in the browser."""
    quiet: bool = False
    """Do not print the address."""

    def __post_init__(self) -> None:
        check_range("port", self.port, 0, 65_535)
        if not self.generators.strip(" ,"):
            raise ConfigError("generators is empty; name at least one, such as procedural")


def run(arguments: Sequence[str]) -> int:
    """Serve until Ctrl-C or SIGTERM; returns the exit code."""
    options, limits = parse_configs(
        arguments,
        {"page": AppOptions(), "limits": Limits()},
        prog="texvent app",
        description=DESCRIPTION,
    )
    generators = _names(options.generators)
    for name in generators:
        GENERATORS.load(name)
    stop = threading.Event()
    before = signal.signal(signal.SIGTERM, lambda number, frame: stop.set())
    try:
        with Workspace() as workspace:
            page = WebPage(
                workspace,
                limits=limits,
                generators=generators,
                allowed_hosts=_names(options.allow_host),
            )
            address = page.launch(host=options.host, port=options.port)
            if not options.quiet:
                write_out(f"{address}\npress Ctrl-C to stop\n")
                sys.stdout.flush()
            if options.browser:
                webbrowser.open(address)
            try:
                # In turns: on Windows Ctrl-C does not end a wait.
                while not stop.wait(WAIT_S):
                    pass
            except KeyboardInterrupt:
                stop.set()
            page.close()
    finally:
        signal.signal(signal.SIGTERM, before)
    return 0


def _names(text: str) -> tuple[str, ...]:
    return tuple(name.strip() for name in text.split(",") if name.strip())
