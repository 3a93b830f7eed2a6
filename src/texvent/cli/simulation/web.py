"""`texvent app`: the web page, for the user who started it."""

from __future__ import annotations

import contextlib
import signal
import sys
import threading
import webbrowser
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import ClassVar

from texvent.cli.notices import write_out
from texvent.cli.options import parse_configs
from texvent.config import check_range
from texvent.errors import ConfigError
from texvent.io.atomic import temporary_folder
from texvent.web.job_page import JobServer
from texvent.web.server import PageServer

DESCRIPTION = """Open the web page: type a prompt or the path of a video, look at the events,
download them. Only those who have the address can reach the page."""
WAIT_S = 0.5
LEAD = """<!doctype html><meta name="referrer" content="no-referrer">
<meta http-equiv="refresh" content="0; url={}">"""


@dataclass(frozen=True, kw_only=True)
class AddressOptions:
    """Address at which the page is served."""

    short_flags: ClassVar[Mapping[str, str]] = {"quiet": "-q"}

    port: int = 0
    """TCP port; 0: any free one."""
    browser: bool = True
    """Open the page in the browser."""
    quiet: bool = False
    """Do not print the address."""

    def __post_init__(self) -> None:
        check_range("port", self.port, 0, 65_535)
        if self.quiet and not self.browser:
            raise ConfigError(
                "--quiet and --no-browser show the address nowhere; leave one of them out"
            )


def run(arguments: Sequence[str]) -> int:
    """Serve until Ctrl-C or SIGTERM; returns the exit code."""
    (options,) = parse_configs(
        arguments, {"page": AddressOptions()}, prog="texvent app", description=DESCRIPTION
    )
    return serve(JobServer(port=options.port), options)


def serve(server: PageServer, options: AddressOptions) -> int:
    """Show a page until Ctrl-C, SIGTERM, or the page needs it no more; returns the exit code."""
    stop = threading.Event()
    before = signal.signal(signal.SIGTERM, lambda number, frame: stop.set())
    try:
        with server, contextlib.ExitStack() as stack:
            if not options.quiet:
                write_out(f"{server.entry}\npress Ctrl-C to stop\n")
                sys.stdout.flush()
            if options.browser:
                # By a file: the words that start a browser are shown to every user.
                page = stack.enter_context(temporary_folder()) / "open.html"
                page.write_text(LEAD.format(server.entry), encoding="utf-8")
                webbrowser.open(page.as_uri())
            try:
                # In turns: on Windows Ctrl-C does not end a wait.
                while not (server.is_over() or stop.wait(WAIT_S)):
                    pass
            except KeyboardInterrupt:
                stop.set()
    finally:
        signal.signal(signal.SIGTERM, before)
    return 0
