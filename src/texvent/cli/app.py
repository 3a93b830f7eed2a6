"""`texvent`: find the command, run it, and turn every error into one line and an exit code.

Standard output and error never stop a command: closed, full, or with no reader left.
"""

from __future__ import annotations

import errno
import gc
import importlib
import io
import os
import signal
import sys
from collections.abc import Sequence
from typing import Any, TextIO

from texvent._registry import Registry, say_absent, suggest
from texvent._require import lab_command
from texvent._version import full_version
from texvent.cli.notices import one_line_warnings, say, with_flags, write_out
from texvent.errors import ConfigError, MissingDependencyError, OutputError, TexventError, shown
from texvent.io.atomic import protected_inputs
from texvent.runtime.work.interrupts import clean_up, has_threads, raise_interrupted
from texvent.runtime.work.side_work import finishing_side_work


class _Lasting(io.FileIO):
    """A file descriptor; what the system refuses to take is lost, and the refusal kept."""

    refusal: OSError | None = None

    def write(self, data: Any) -> int:
        """Write bytes, or lose them."""
        if self.refusal is None:
            try:
                return super().write(data) or 0
            except OSError as error:
                self.refusal = error
        return memoryview(data).nbytes


def open_standard_streams() -> None:
    """Let the process write to stdout and stderr whatever becomes of them.

    Where they were closed, no file that is opened later gets their numbers.
    """
    for number in range(3):
        try:
            os.fstat(number)
        except OSError:
            os.dup2(os.open(os.devnull, os.O_RDWR), number)
    sys.stdout, sys.stderr = _lasting(sys.stdout, 1), _lasting(sys.stderr, 2)


def allow_any_text() -> None:
    """Let output that the terminal's encoding cannot show lose a character, not the run.

    Help has Greek letters, which a plain C locale has not; a path may hold bytes that are not
    UTF-8, and those are written as they are.
    """
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            is_utf8 = stream.encoding.lower().replace("-", "") == "utf8"
            stream.reconfigure(errors="surrogateescape" if is_utf8 else "replace")


def refusal_of_output() -> str | None:
    """Why part of standard output was lost; None also where its reader (head, less) ended first."""
    sys.stdout.flush()
    raw = getattr(getattr(sys.stdout, "buffer", None), "raw", None)
    refusal = raw.refusal if isinstance(raw, _Lasting) else None
    if refusal is None or refusal.errno in (errno.EPIPE, errno.EINVAL):  # EINVAL: of Windows
        return None
    return refusal.strerror


def _lasting(stream: TextIO | None, number: int) -> TextIO:
    """The stream, unless it is a terminal, over a descriptor that lasts."""
    if stream is not None and (stream.isatty() or not isinstance(stream, io.TextIOWrapper)):
        return stream
    return io.TextIOWrapper(
        io.BufferedWriter(_Lasting(number, "w", closefd=False)),
        encoding="utf-8" if stream is None else stream.encoding,
        line_buffering=stream is None or stream.line_buffering or stream.write_through,
    )


COMMANDS = {
    "generate": (
        "texvent.cli.simulation.generate",
        "Events, video, image and page from a text prompt.",
    ),
    "batch": ("texvent.cli.simulation.batch", "Events for every prompt of a file."),
    "dataset": ("texvent.cli.dataset.dataset", "Data sets of any size: made, resumed, checked."),
    "simulate": (
        "texvent.cli.simulation.simulate",
        "Events from a video, an image folder or a camera.",
    ),
    "render": (
        "texvent.cli.event_files.show:run_render",
        "A video, image or page of an event file.",
    ),
    "view": (
        "texvent.cli.event_files.show:run_view",
        "Open an event file in the browser: point cloud, playback, rate.",
    ),
    "app": (
        "texvent.cli.simulation.pages:run_app",
        "The web page: prompt or video in, events out.",
    ),
    "live": (
        "texvent.cli.simulation.pages:run_live",
        "A camera or video beside its events in the browser.",
    ),
    "info": (
        "texvent.cli.event_files.info",
        "What an event file or video holds, and how it was made.",
    ),
    "check": (
        "texvent.cli.simulation.check",
        "What in a video harms events, and which option helps.",
    ),
    "convert": (
        "texvent.cli.event_files.convert",
        "Another event format, a region, a time range, files merged.",
    ),
    "validate": (
        "texvent.cli.event_files.validate",
        "Can this event file be trusted? A verdict and an exit code.",
    ),
    "compare": (
        "texvent.cli.event_files.compare",
        "How close an event file is to the true one, by many metrics.",
    ),
    "calibrate": (
        "texvent.cli.simulation.calibrate",
        "Fit the physical model to a recording of frames and events.",
    ),
    "data": (
        "texvent.cli.setup.downloads:run_data",
        "Recordings and clips to try things on: list them, fetch them.",
    ),
    "weights": (
        "texvent.cli.setup.downloads:run_weights",
        "Published network weights: list them, fetch them.",
    ),
    "generators": (
        "texvent.cli.setup.generators",
        "Text-to-video generators: which there are, which are ready.",
    ),
    "doctor": ("texvent.cli.setup.doctor", "What is installed, what is missing, how to get it."),
}
"""Command → `module` or `module:function`, without which it is `run`, and what it does."""
PACKAGES = Registry("command", {})
"""Packages with more commands: mappings like `COMMANDS`, named by entry points."""
OF_THE_LAB = ("align", "bench", "evaluate", "nt-imagenet", "reconstruct", "train")
"""Commands of the package texvent-lab."""
OF_THE_PAGE = ("browser", "gui", "page", "serve", "ui", "web")
"""Words by which users look for the command `app`."""
LONGEST_LISTING, LONGEST_WORD = 220, 30
"""Characters of the list of commands and of a word that is none, in an error."""


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line.

    Args:
        arguments: words after `texvent`; default: those of the process.

    Returns:
        Exit code: 0, or the `exit_code` of the error (2 for bad input), or 128 + n after signal n.
    """
    if arguments is not None:
        allow_any_text()
        return _run(list(arguments))
    open_standard_streams()
    allow_any_text()
    # Imports and kernels leave few cycles: looking for them took 7 % of the first run.
    gc.set_threshold(50_000, 20, 50)
    code = _run(sys.argv[1:], is_process=True)
    refusal = refusal_of_output()
    if refusal is None:
        return code
    say(f"error: standard output cannot be written: {refusal}; files that were asked for are kept")
    return code or OutputError.exit_code


def _run(words: list[str], *, is_process: bool = False) -> int:
    """Exit code of a command; every error becomes one line."""
    try:
        with (
            raise_interrupted(until_exit=is_process),
            protected_inputs(),
            one_line_warnings(),
            finishing_side_work(),
        ):
            return _dispatch(words)
    except TexventError as error:
        say(f"error: {with_flags(str(error))}")
        return error.exit_code
    except SystemExit as stop:
        # Help was shown.
        return int(stop.code or 0)
    except KeyboardInterrupt as interrupt:
        clean_up()
        if not has_threads():  # OpenBLAS then interrupts the process itself
            say("error: the system gives no more threads or processes (ulimit -u); end some")
            return TexventError.exit_code
        number = getattr(interrupt, "number", signal.SIGINT)
        say(f"interrupted ({signal.Signals(number).name}); nothing half-written was left behind")
        return 128 + number
    except MemoryError:
        say("error: memory ran out; use smaller frames, or close other programs")
        return TexventError.exit_code
    except OSError as error:
        where = f" ({error.filename})" if error.filename else ""
        say(f"error: the system refused{where}: {error.strerror or error}")
        return OutputError.exit_code


def _dispatch(words: list[str]) -> int:
    if not words or words[0] in ("-h", "--help", "help"):
        _show_help()
        return 0 if words else 2
    if words[0] in ("-V", "--version"):
        write_out(f"texvent {full_version()}\n")
        return 0
    commands = COMMANDS if words[0] in COMMANDS else own_commands()
    if words[0] not in commands:
        commands = all_commands()
    if words[0] not in commands:
        if words[0] in OF_THE_LAB:
            raise MissingDependencyError(
                f"texvent {words[0]} is a command of the package texvent-lab; "
                f"install it with: {lab_command()}"
            )
        sought = "app" if words[0] in OF_THE_PAGE else words[0]
        listed = suggest(sought, tuple(commands), longest=LONGEST_LISTING)
        gone = "".join(f"; {say_absent(one)}" for one in {*PACKAGES.absent().values()})
        raise ConfigError(f"unknown command {shown(words[0][:LONGEST_WORD])}; {listed}{gone}")
    module, _, function = commands[words[0]][0].partition(":")
    command = getattr(importlib.import_module(module), function or "run")
    code: int = command(words[1:])
    return code


def own_commands() -> dict[str, tuple[str, str]]:
    """`COMMANDS`, and those of entry points of texvent's own distribution."""
    commands = dict(COMMANDS)
    for name in PACKAGES.shipped():
        commands.update(PACKAGES.load(name))
    return commands


def all_commands() -> dict[str, tuple[str, str]]:
    """The commands of all packages; no other package replaces one of texvent's.

    Raises:
        TexventError: a package cannot be loaded.
    """
    own, others = own_commands(), dict[str, tuple[str, str]]()
    for name in PACKAGES.entries():
        others.update(PACKAGES.load(name))
    return {**own, **others, **own}


def _show_help() -> None:
    commands = all_commands()
    width = max(map(len, commands))
    lines = [
        "usage: texvent COMMAND [OPTIONS]",
        "",
        "Text prompts and videos to the stream of an event camera.",
        "",
        *(f"  {name:<{width}}  {text}" for name, (_, text) in commands.items()),
        "",
        "Try:  texvent generate 'a red car drives left past two trees at dusk' -o out.h5",
        "Help: texvent COMMAND --help    Version: texvent --version",
        "",
    ]
    write_out("\n".join(lines))


if __name__ == "__main__":
    sys.exit(main())
