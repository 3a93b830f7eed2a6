"""The Python API: `generate`, `simulate`, `load`.

Keywords are the options of the command line: the same names and the same defaults, from the same
dataclasses; None means "as the preset has it".
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from fractions import Fraction
from pathlib import Path
from typing import Any, Literal, TypeAlias, overload

from numpy.typing import NDArray

from texvent._registry import load_object
from texvent.calibrate.rate import reach_target_rate
from texvent.event_packets import EventPackets
from texvent.events import EventStream
from texvent.pipeline import Simulation, text_to_events, video_to_events
from texvent.settings import resolve
from texvent.video import FrameStream

Rate: TypeAlias = int | float | str | Fraction
Source: TypeAlias = str | Path | FrameStream | NDArray[Any] | Iterable[Any]

__all__ = ["generate", "load", "simulate"]


@overload
def generate(
    prompt: str,
    *,
    generator: str | None = None,
    simulator: str | None = None,
    preset: str | None = None,
    as_packets: Literal[False] = False,
    **options: Any,
) -> EventStream: ...
@overload
def generate(
    prompt: str,
    *,
    generator: str | None = None,
    simulator: str | None = None,
    preset: str | None = None,
    as_packets: Literal[True],
    **options: Any,
) -> EventPackets: ...
def generate(
    prompt: str,
    *,
    generator: str | None = None,
    simulator: str | None = None,
    preset: str | None = None,
    as_packets: bool = False,
    config: str | Path | None = None,
    **options: Any,
) -> EventStream | EventPackets:
    """Events of the scene that a prompt describes.

    Args:
        prompt: what to show, such as "a red car drives left past two trees at dusk".
        generator: text-to-video generator; default "procedural", the embedded one.
        simulator: pixel model; default "texvent".
        preset: named set of simulator options; default the simulator's first, "paper".
        as_packets: give packets one by one, with flat memory, instead of one stream.
        config: a TOML or YAML file with options.
        **options: further options of `texvent generate --help`, such as `seed=3`,
            `sensor="davis346"`, `duration=2.0`, `interpolate="exact"`, `contrast_threshold=0.2`,
            `noise="none"`.

    Returns:
        The events, with their provenance in `metadata`.

    Raises:
        InputError: the prompt is empty.
        ConfigError: an unknown option, or a value out of range.
    """
    named = {"generator": generator, "simulator": simulator, "preset": preset}
    settings = resolve("generate", {**options, **named}, config=config)
    return _events(text_to_events(prompt, settings), as_packets)


@overload
def simulate(
    source: Source,
    *,
    t_us: Sequence[int] | None = None,
    fps: Rate | None = None,
    simulator: str | None = None,
    preset: str | None = None,
    as_packets: Literal[False] = False,
    **options: Any,
) -> EventStream: ...
@overload
def simulate(
    source: Source,
    *,
    t_us: Sequence[int] | None = None,
    fps: Rate | None = None,
    simulator: str | None = None,
    preset: str | None = None,
    as_packets: Literal[True],
    **options: Any,
) -> EventPackets: ...
def simulate(
    source: Source,
    *,
    t_us: Sequence[int] | None = None,
    fps: Rate | None = None,
    simulator: str | None = None,
    preset: str | None = None,
    as_packets: bool = False,
    config: str | Path | None = None,
    **options: Any,
) -> EventStream | EventPackets:
    """Events that an event camera would have recorded of a video.

    Args:
        source: a video file, an image folder, a camera or network address, an array [N, H, W] or
            [N, H, W, 3] (uint8, uint16, or float on the 0..255 scale), or a FrameStream.
        t_us: frame times, µs, for arrays; otherwise give `fps`.
        fps: frame rate, such as 24, 29.97 or "30000/1001"; video files know their own times.
        simulator: pixel model; default "texvent".
        preset: named set of simulator options; default the simulator's first, "paper".
        as_packets: give packets one by one, with flat memory, instead of one stream.
        config: a TOML or YAML file with options.
        **options: further options of `texvent simulate --help`, such as `interpolate="flow"`,
            `sensor="davis346"`, `contrast_threshold=0.2`, `noise="none"`, `seed=0`.

    Returns:
        The events, with their provenance in `metadata`.

    Raises:
        InputError: the source cannot be read, or holds NaN, negative or infinite intensities.
        ConfigError: an unknown option, or a value out of range.
    """
    named = {"fps": fps, "simulator": simulator, "preset": preset}
    settings = resolve("simulate", {**options, **named}, config=config)
    open_frames = load_object("texvent.capture.open:open_frames")
    video = open_frames(source, settings.source, size=settings.size, t_us=t_us)
    return _events(video_to_events(video, settings), as_packets)


def load(path: str | Path, *, format: str | None = None, size: Any = None) -> EventStream:
    """Events of a file, in memory; see `texvent.io.files` for the formats.

    Args:
        path: the file.
        format: its format, where the extension does not say.
        size: sensor size (width, height), for formats that do not store it.

    Raises:
        InputError: no such file, or the size is not stored and not given.
        FileFormatError: the file is damaged or of another format.
    """
    events: EventStream = load_object("texvent.io.files:load")(path, format=format, size=size)
    return events


def _events(simulation: Simulation, as_packets: bool) -> EventStream | EventPackets:
    packets = reach_target_rate(simulation)[0].packets
    return packets if as_packets else packets.collect()
