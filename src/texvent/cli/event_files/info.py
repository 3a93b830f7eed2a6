"""`texvent info FILE`: what an event file or a video holds, and how it was made."""

from __future__ import annotations

import contextlib
import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path
from typing import Any

from texvent.capture.aedat4_frames import count_frames, is_aedat4
from texvent.capture.camera_path.opening import is_still
from texvent.capture.image_folder import read_image
from texvent.capture.open import open_frames
from texvent.cli.event_files.event_file_options import EventFileOptions
from texvent.cli.notices import write_out
from texvent.cli.option_types import REQUIRED
from texvent.cli.options import parse_configs
from texvent.config import CaptureConfig
from texvent.errors import FileFormatError, visible, warn
from texvent.event_packets import EventPackets
from texvent.frames import MICROSECONDS, FrameStream
from texvent.io.files import is_event_path, side_data
from texvent.io.reading import SeveralRecordingsError, UnknownLayoutError
from texvent.prompt_report import REPORT_KEY, PromptReport

DESCRIPTION = """Say what an event file or a video holds, and how it was made. The whole file is
read once, with flat memory, so the figures are exact and a damaged file is found."""

MOST_SHOWN = 80
"""Characters of a value, unless everything is asked for."""


@dataclass(frozen=True, kw_only=True)
class InfoOptions(EventFileOptions):
    """File to describe, and form of the report."""

    path: Path = REQUIRED
    """Event file, video file or image folder."""
    fps: Fraction | None = None
    """Frame rate of an image folder without times."""
    all: bool = False
    """Print everything that is stored, options included and in full."""
    json: bool = False
    """Print everything as JSON instead of lines."""


def run(arguments: Sequence[str]) -> int:
    """Run the command; returns its exit code."""
    (options,) = parse_configs(
        arguments, {"input": InfoOptions()}, prog="texvent info", description=DESCRIPTION
    )
    if options.format or is_event_path(options.path) or not options.path.exists():
        facts = _describe_file(options)
        if options.fps is not None:
            warn(f"fps has no effect: {options.path} holds events")
    elif is_still(options.path):
        facts = describe_image(options.path)
    else:
        facts = describe_frames(open_frames(options.path, CaptureConfig(fps=options.fps)))
    if options.json:
        write_out(json.dumps(facts, indent=2, ensure_ascii=False) + "\n")
    else:
        shown = facts if options.all else _main_facts(facts)
        most = None if options.all else MOST_SHOWN
        write_out("\n".join(_lines(shown, most=most)) + "\n")
        if len(shown) < len(facts):
            write_out(f"... {len(facts) - len(shown)} more: --all\n")
    return 0


def _main_facts(facts: Mapping[str, Any]) -> dict[str, Any]:
    """Facts that are single values; of the source its name, of the prompt's report its faults."""
    main = {name: value for name, value in facts.items() if not isinstance(value, Mapping)}
    if isinstance(source := facts.get("source"), Mapping) and "source" in source:
        main["source"] = source["source"]
    report = PromptReport.of_metadata(facts)
    if report is not None and not report.is_faithful:
        main[REPORT_KEY] = "; ".join(report.faults())
    return main


def _describe_file(options: InfoOptions) -> dict[str, Any]:
    """Facts of an event file; of one with several recordings, or unknown names, what it holds."""
    try:
        facts = describe_events(options.open())
    except SeveralRecordingsError as error:
        return {"recordings": list(error.streams), "note": "--stream NAME chooses one of them"}
    except UnknownLayoutError as error:
        if not options.json:
            write_out("".join(f"{one}\n" for one in error.holds))
        raise
    for name, read in side_data(options.path, options.format).items():
        facts[name] = 0
        with contextlib.suppress(FileFormatError) if options.repair else contextlib.nullcontext():
            for block in read():
                facts[name] += len(block["t"])
    if is_aedat4(options.path):
        facts["frames"] = count_frames(options.path)
    return facts


def describe_events(packets: EventPackets) -> dict[str, Any]:
    """Counts and times of a recording, read once."""
    count = on_events = 0
    first_us = last_us = None
    for packet in packets:
        if not len(packet):
            continue
        count += len(packet)
        on_events += int(packet.p.sum())
        first_us = int(packet.t[0]) if first_us is None else first_us
        last_us = int(packet.t[-1])
    facts: dict[str, Any] = {"sensor": str(packets.size), "events": count}
    if first_us is not None and last_us is not None:
        seconds = (last_us - first_us) / MICROSECONDS
        facts |= {
            "on_share": round(on_events / count, 4),
            "first_us": first_us,
            "last_us": last_us,
            "seconds": seconds,
            "events_per_second": round(count / seconds) if seconds else None,
        }
    return facts | {key: value for key, value in packets.metadata.items() if value is not None}


def describe_frames(video: FrameStream) -> dict[str, Any]:
    """Size, number and times of the frames of a video, read once."""
    count = 0
    first_us = last_us = 0
    kinds: set[str] = set()
    for frame in video:
        first_us = frame.t_us if count == 0 else first_us
        last_us = frame.t_us
        kinds.add(f"{frame.pixels.dtype} {'RGB' if frame.pixels.ndim == 3 else 'grey'}")
        count += 1
    return {
        "size": str(video.size),
        "frames": count,
        "fps": None if video.fps is None else str(video.fps),
        "first_us": first_us,
        "last_us": last_us,
        "seconds": (last_us - first_us) / MICROSECONDS,
        "pixels": ", ".join(sorted(kinds)),
        **{key: value for key, value in video.metadata.items() if value is not None},
    }


def describe_image(path: Path) -> dict[str, Any]:
    """Size and kind of one image, and what makes events of it.

    Raises:
        FileFormatError: it cannot be read.
    """
    pixels = read_image(path)
    return {
        "size": f"{pixels.shape[1]}x{pixels.shape[0]}",
        "frames": 1,
        "pixels": f"{pixels.dtype} {'RGB' if pixels.ndim == 3 else 'grey'}",
        "note": "one image; texvent simulate --camera saccade, shake or pan makes events of it",
    }


def _lines(facts: Mapping[str, Any], indent: str = "", *, most: int | None = None) -> list[str]:
    """`key  value` lines; tables are indented under their name, values longer than `most` cut."""
    width = max((len(key) for key in facts), default=0)
    lines = []
    for key, value in facts.items():
        if isinstance(value, Mapping):
            lines += [f"{indent}{key}", *_lines(value, indent + "  ", most=most)]
        else:
            # A seed is to be typed again, so its digits stay together.
            text = _text(value, is_name=key.endswith("seed"))
            # Within a value even a line end would begin a line that looks like another fact.
            lines.append(f"{indent}{key:<{width}}  {shortened(visible(text), most)}")
    return lines


def _text(value: Any, *, is_name: bool = False) -> str:
    if isinstance(value, int) and not isinstance(value, bool):
        return str(value) if is_name else f"{value:,}"
    return ", ".join(map(str, value)) if isinstance(value, list) else str(value)


def shortened(text: str, most: int | None) -> str:
    """A text of at most `most` characters: beginning and end, which of a path say the most."""
    if most is None or len(text) <= most:
        return text
    return f"{text[: most // 2]}...{text[most // 2 + 3 - most :]}"
