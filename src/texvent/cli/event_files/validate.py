"""`texvent validate FILE`: can this recording be trusted? A verdict and an exit code."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from typing import Any, ClassVar

from texvent.cli.event_files.event_file_options import EventFileOptions, FileFactOptions
from texvent.cli.notices import write_out
from texvent.cli.options import parse_configs
from texvent.errors import warn
from texvent.io.files import codec_that_reads
from texvent.metrics.soundness import SoundnessCheck
from texvent.runtime.console_progress import ConsoleProgress
from texvent.runtime.progress import NO_PROGRESS, Progress

SUSPICIOUS = 1
"""Exit code of a recording that can be read but is suspicious or empty."""
SHOWN_HOT_PIXELS = 10
DESCRIPTION = """Read a whole event file and say whether it can be trusted: order, coordinates and
polarity (a file that breaks them is refused), exact duplicates, hot pixels, clumped timestamps,
a missing polarity. What many sound recordings have is a note.

Exit code: 0 sound, 1 suspicious or empty, 2 damaged or unreadable."""


NO_CHECKSUMS = "none: the format cannot notice events that were changed by damage"


@dataclass(frozen=True, kw_only=True)
class ValidateOptions(EventFileOptions):
    """File to check, and form of the report."""

    short_flags: ClassVar[Mapping[str, str]] = {**FileFactOptions.short_flags, "quiet": "-q"}

    json: bool = False
    """Print JSON instead of lines."""
    quiet: bool = False
    """Print nothing; the exit code says it."""


def run(arguments: Sequence[str]) -> int:
    """Run the command; returns its exit code."""
    (options,) = parse_configs(
        arguments, {"input": ValidateOptions()}, prog="texvent validate", description=DESCRIPTION
    )
    with ConsoleProgress(is_quiet=options.quiet) as progress:
        facts = validate(options, progress)
    if not options.quiet:
        text = json.dumps(facts, indent=2) if options.json else "\n".join(_lines(facts))
        write_out(text + "\n")
    return 0 if facts["verdict"] == "sound" else SUSPICIOUS


def validate(options: ValidateOptions, progress: Progress = NO_PROGRESS) -> dict[str, Any]:
    """Verdict, complaints and figures of a file.

    Raises:
        InputError: it cannot be read; FileFormatError if it is damaged.
    """
    events = options.open()
    check = SoundnessCheck(events.size)
    for packet in events.reporting_to(progress):
        check.update(packet)
    report = check.report()
    complaints = [*_missing_frames(events.metadata), *report.complaints()]
    verdict = "suspicious" if complaints else "sound"
    if not report.events:
        verdict = "empty"
        warn(f"{options.path} is empty: it holds no event")
    facts = asdict(report)
    hot = facts.pop("hot_pixels")
    shares = {name: facts[name] for name in ("clumped_share", "on_share")}
    rounded = {name: None if math.isnan(one) else round(one, 4) for name, one in shares.items()}
    is_checked = codec_that_reads(options.path, options.format).has_checksums
    return {
        "verdict": verdict,
        "complaints": complaints,
        "notes": report.notes(),
        "checksums": "yes" if is_checked else NO_CHECKSUMS,
        "sensor": str(events.size),
        **facts,
        **rounded,
        "hot_pixels": len(hot),
        "hottest": [list(pixel) for pixel in hot[:SHOWN_HOT_PIXELS]],
    }


def _missing_frames(metadata: Mapping[str, Any]) -> list[str]:
    """Complaint about frames that a live recording dropped or left out, of which no event is."""
    source = metadata.get("source")
    places = (metadata, source if isinstance(source, Mapping) else {})
    counts = [one.get("frames_dropped", 0) for one in places]
    lost = sum(count for count in counts if isinstance(count, int))
    return [f"{lost:,} frames of its source are missing"] if lost > 0 else []


def _lines(facts: Mapping[str, Any]) -> list[str]:
    """The verdict first, then the complaints, then figures."""
    figures = {
        name: value
        for name, value in facts.items()
        if name not in ("verdict", "complaints", "notes", "hottest")
    }
    width = max(map(len, figures))
    lines = [facts["verdict"], *(f"  {text}" for text in facts["complaints"])]
    lines += [f"  note: {text}" for text in facts["notes"]]
    for name, value in figures.items():
        shown = f"{value:,}" if isinstance(value, int) else value
        lines.append(f"{name:<{width}}  {shown}")
    return lines
