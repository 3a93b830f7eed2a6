"""`texvent replay EVENTS`: make an event file again from what is stored in it, and compare."""

from __future__ import annotations

import filecmp
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar

from texvent.cli.notices import write_out
from texvent.cli.option_types import REQUIRED
from texvent.cli.options import parse_configs
from texvent.errors import InputError, TexventError
from texvent.io.atomic import check_output
from texvent.io.files import load, open_events
from texvent.run.files import RunFiles, write_run
from texvent.run.replay import describe_differences, prepare_replay
from texvent.runtime.displays.console_progress import ConsoleProgress

DESCRIPTION = """Make an event file again from the prompt or video, options and seed stored in it,
and say whether the bytes are the same. If the version, a weights file or the source is another one,
say so instead.

  texvent replay out.h5                       writes out.replay.h5
  texvent replay out.h5 --source moved.mp4 -o again.h5"""


@dataclass(frozen=True, kw_only=True)
class ReplayOptions:
    """Which file, and where the new one goes."""

    positional: ClassVar[tuple[str, ...]] = ("path",)
    short_flags: ClassVar[Mapping[str, str]] = {"out": "-o", "quiet": "-q"}

    path: Path = REQUIRED
    """Event file that texvent made."""
    out: Path | None = None
    """File to write. Without it: NAME.replay.h5, in the current folder."""
    source: Path | None = None
    """The video or folder it was made from, where that has moved."""
    anyway: bool = False
    """Go on though the version, a weights file or the source is another one."""
    format: str | None = None
    """Format to write, where the extension does not say which; default: as it was stored."""
    overwrite: bool = False
    """Replace the file if it exists already."""
    quiet: bool = False
    """No progress; only errors."""


def run(arguments: Sequence[str]) -> int:
    """Run the command; returns 0 if the bytes are the same."""
    (options,) = parse_configs(
        arguments, {"input": ReplayOptions()}, prog="texvent replay", description=DESCRIPTION
    )
    path = options.path
    if not path.exists():
        raise InputError(f"no such file: {path}")
    out = options.out or Path(f"{path.stem}.replay{path.suffix}")
    check_output(out, overwrite=options.overwrite)
    stored = open_events(path).metadata
    simulation = prepare_replay(stored, path=path, source=options.source)
    differences = describe_differences(stored, simulation.provenance)
    if differences and not options.anyway:
        raise TexventError(
            f"{path} cannot be made again as it was: {'; '.join(differences[:4])}. "
            "--anyway makes it with what is here"
        )
    format = options.format or stored.get("format")
    files = RunFiles(
        events=(out,),
        formats=(format,) if isinstance(format, str) else (),
        overwrite=options.overwrite,
    )
    metadata = simulation.provenance if differences else stored
    done = 0
    with ConsoleProgress(is_quiet=options.quiet) as progress:

        def count(frame: object, packet: object) -> None:
            nonlocal done
            done += bool(getattr(frame, "is_source", False))
            progress.advance("frames", done, simulation.video.frame_count)

        write_run(simulation, files, metadata=metadata, on_step=count)
    return _compare(path, out)


def _compare(path: Path, out: Path) -> int:
    """Say whether two files are the same; returns 0 if their bytes are, else 1."""
    if out.is_file() and filecmp.cmp(path, out, shallow=False):
        write_out(f"{out}: the same bytes as {path}\n")
        return 0
    before, again = load(path), load(out)
    if again == before:
        write_out(f"{out}: the same events as {path}, in other bytes\n")
        return 0 if out.is_dir() else 1
    write_out(f"{out}: other events than {path}, {len(again):,} for {len(before):,}\n")
    return 1
