"""`texvent check VIDEO`: what in a video harms events, and what helps."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, ClassVar

from rich.table import Table

from texvent.cli.notices import result_console, write_out
from texvent.cli.option_types import REQUIRED
from texvent.cli.options import parse_configs
from texvent.config import ReadingConfig
from texvent.frames import MICROSECONDS
from texvent.run.check import VideoCheckResult, check_frames, open_source
from texvent.runtime.console_progress import ConsoleProgress

FOUND = 1
"""Exit code with --strict of a video in which something was found."""
SHOWN_CUTS = 8
DESCRIPTION = """Look through a video once and say what in it harms events, and which option helps:
frozen or repeated frames, flicker, cuts, levels, motion per frame. texvent simulate --dry-run says
how many events to expect.

  texvent check clip.mp4
  texvent check frames/ --fps 120 --all

Exit code: 0; with --strict 1 if something was found."""


@dataclass(frozen=True, kw_only=True)
class CheckOptions:
    """Frames to check, and output of the report."""

    input_texts: ClassVar[tuple[str, ...]] = ("source",)
    positional: ClassVar[tuple[str, ...]] = ("source",)
    short_flags: ClassVar[dict[str, str]] = {"quiet": "-q"}
    main_options: ClassVar[tuple[str, ...]] = (
        "all", "json", "strict", "quiet", "fps", "start", "stop", "transfer", "white_level",
    )  # fmt: skip

    source: str = REQUIRED
    """Video file, image folder, camera (/dev/video0), stream (rtsp://...) or - (standard input)."""
    all: bool = False
    """Say of every check what it is for, also of those that found nothing."""
    json: bool = False
    """Print JSON instead of a table, with all measurements."""
    strict: bool = False
    """End with exit code 1 if something was found."""
    quiet: bool = False
    """No progress."""


def run(arguments: Sequence[str]) -> int:
    """Run the command; returns its exit code."""
    options, reading = parse_configs(
        arguments,
        {"input": CheckOptions(), "capture": ReadingConfig()},
        prog="texvent check",
        description=DESCRIPTION,
    )
    with ConsoleProgress(is_quiet=options.quiet) as progress:
        found = check_frames(open_source(options.source, reading), progress)
    if options.json:
        write_out(json.dumps(describe_check(found), indent=2) + "\n")
    else:
        _print_check(found, is_whole=options.all)
    is_fine = not any(one.is_found for one in found.report.findings)
    return 0 if is_fine or not options.strict else FOUND


def describe_check(found: VideoCheckResult) -> dict[str, Any]:
    """All that was found, JSON-ready."""
    return {
        "found": [*found.report.problems, *found.report.remarks],
        "size": str(found.size),
        "findings": [one.as_facts() for one in found.report.findings],
        "measurements": {name: round(one, 6) for name, one in found.report.measurements.items()},
        "cuts_s": [time / MICROSECONDS for time in found.cut_times_us],
    }


def _print_check(found: VideoCheckResult, *, is_whole: bool) -> None:
    """Print the checks, those that found something first and with advice, and a summary."""
    findings = sorted(found.report.findings, key=lambda one: not one.is_found)
    table = Table(box=None, pad_edge=False)
    for title in ("check", "measured", "limit", "what it does to events", "what helps"):
        table.add_column(title)
    for one in findings:
        has_advice = one.is_found or is_whole
        advice = (one.check.effect, one.check.help) if has_advice else ("", "")
        mark = "! " if one.is_found else ""
        table.add_row(f"{mark}{one.check.name}", one.value, one.check.limit, *advice)
    with result_console() as console:
        console.print(table)
    write_out("\n".join(["", *_summary(found), ""]))


def _summary(found: VideoCheckResult) -> list[str]:
    measurements, report = found.report.measurements, found.report
    names = [*report.problems, *report.remarks]
    lines = [
        f"{measurements['frames']:.0f} frames, {measurements['fps']:.4g} fps, {found.size}",
        f"found: {', '.join(names)}" if names else "nothing found",
    ]
    if found.cut_times_us:
        times = [f"{time / MICROSECONDS:.3f}" for time in found.cut_times_us[:SHOWN_CUTS]]
        more = ", ..." if len(found.cut_times_us) > SHOWN_CUTS else ""
        lines.insert(1, f"cuts at {', '.join(times)}{more} s")
    return lines
