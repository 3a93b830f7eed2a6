"""The Python API: `generate`, `simulate`, `video`, `open`, `load` and `compare`.

Options are those of the command line: the same names and the same defaults, from the same
dataclasses; None means "as the preset has it".
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, TypeAlias, Unpack, overload

from numpy.typing import NDArray

from texvent.errors import ConfigError
from texvent.event_packets import EventPackets
from texvent.events import EventStream
from texvent.frames import FrameStream
from texvent.generation.subjects import Subject
from texvent.io.files import load
from texvent.io.files import open_events as open
from texvent.options.keywords import GenerateOptions, SimulateOptions, naming_options
from texvent.pipeline import Simulation
from texvent.run.files import TruthFolder, run_with_truth
from texvent.run.prepare import make_video, open_subject, prepare_prompt, prepare_source
from texvent.runtime.progress_option import ProgressOption, open_progress
from texvent.settings.resolution import Settings, resolve
from texvent.truth.layout import check_generator

if TYPE_CHECKING:
    from texvent.metrics.protocol import Metric

Source: TypeAlias = str | Path | FrameStream | NDArray[Any] | Iterable[Any]
Events: TypeAlias = str | Path | EventStream | EventPackets

__all__ = ["compare", "generate", "load", "open", "simulate", "video"]


@overload
def generate(
    prompt: Subject,
    *,
    as_packets: Literal[False] = False,
    config: str | Path | None = None,
    progress: ProgressOption = None,
    truth_folder: str | Path | TruthFolder | None = None,
    **options: Unpack[GenerateOptions],
) -> EventStream: ...
@overload
def generate(
    prompt: Subject,
    *,
    as_packets: Literal[True],
    config: str | Path | None = None,
    progress: ProgressOption = None,
    truth_folder: str | Path | TruthFolder | None = None,
    **options: Unpack[GenerateOptions],
) -> EventPackets: ...
@naming_options(GenerateOptions)
def generate(
    prompt: Subject,
    *,
    as_packets: bool = False,
    config: str | Path | None = None,
    progress: ProgressOption = None,
    truth_folder: str | Path | TruthFolder | None = None,
    **options: Unpack[GenerateOptions],
) -> EventStream | EventPackets:
    """Events of the scene that a prompt describes, or of a scene.

    Args:
        prompt: what to show, such as "a red car drives left past two trees at dusk"; a
            scene file (.toml, .json), or a `texvent_scenes.Scene`.
        as_packets: give packets one by one, with flat memory, instead of one stream.
        config: a TOML or YAML file with options.
        progress: a bar (True), none (False), or a function that takes steps done, steps in all or
            None, and what is done; default: a bar in a terminal or notebook.
        truth_folder: a new folder for all that is true of the scene, such as "car.truth", which
            `load_truth` reads; a `TruthFolder` names parts and may replace one.
        **options: those of `texvent generate --help`, such as `seed=3`, `sensor="davis346"`,
            `duration=2.0`, `interpolate="exact"`, `simulator="esim"`, `noise="none"`.

    Returns:
        The events, with their provenance in `metadata`.

    Warns:
        TexventWarning: words of the prompt are not understood, or hardly an event is signal.

    Raises:
        InputError: the prompt is empty, or the embedded generator understands nothing in it.
        ConfigError: an unknown option or a value out of range, also in a scene.

    Example:
        >>> import texvent
        >>> events = texvent.generate("a red ball bounces", sensor="48x36", duration=0.2, seed=3)
        >>> events.size, len(events) > 100
        (SensorSize(width=48, height=36), True)
    """
    settings = resolve("generate", options, config=config)
    prompt = open_subject(prompt, getattr(settings.source, "assets", None))
    output = _truth_output(truth_folder, as_packets=as_packets)
    if output is not None:
        check_generator(str(settings.generator))
    with open_progress(progress) as shown:
        run = prepare_prompt(prompt, settings, progress=shown)
        if output is not None:
            return run_with_truth(run, output, shown)
    return run.packets if as_packets else _collected(run, progress)


@overload
def simulate(
    source: Source,
    *,
    t_us: Sequence[int] | None = None,
    prompt: str | None = None,
    as_packets: Literal[False] = False,
    config: str | Path | None = None,
    progress: ProgressOption = None,
    truth_folder: str | Path | TruthFolder | None = None,
    **options: Unpack[SimulateOptions],
) -> EventStream: ...
@overload
def simulate(
    source: Source,
    *,
    t_us: Sequence[int] | None = None,
    prompt: str | None = None,
    as_packets: Literal[True],
    config: str | Path | None = None,
    progress: ProgressOption = None,
    truth_folder: str | Path | TruthFolder | None = None,
    **options: Unpack[SimulateOptions],
) -> EventPackets: ...
@naming_options(SimulateOptions)
def simulate(
    source: Source,
    *,
    t_us: Sequence[int] | None = None,
    prompt: str | None = None,
    as_packets: bool = False,
    config: str | Path | None = None,
    progress: ProgressOption = None,
    truth_folder: str | Path | TruthFolder | None = None,
    **options: Unpack[SimulateOptions],
) -> EventStream | EventPackets:
    """Events that an event camera would have recorded of a video.

    Args:
        source: a video file, an image folder, a camera or network address, an array [N, H, W] or
            [N, H, W, 3] (uint8, uint16, or float on the 0..255 scale), or a FrameStream; with
            `camera`, such as "saccade", a still image: its file, or an array [H, W] or [H, W, 3].
        t_us: frame times, µs, for arrays; otherwise give `fps`.
        prompt: what the video shows, stored with the events.
        as_packets: give packets one by one, with flat memory, instead of one stream.
        config: a TOML or YAML file with options.
        progress: as `generate`.
        truth_folder: as `generate`, for a FrameStream that knows its scene, or whose frames bring
            motion vectors along.
        **options: those of `texvent simulate --help`, such as `fps="30000/1001"`,
            `interpolate="flow"`, `sensor="davis346"`, `contrast_threshold=0.2`, `noise="none"`;
            of what a renderer knows, `motion` and `motion_back` are vectors from each frame to
            the next and to the previous one, [N, H, W, 2] or one less, px, x right and y down
            (`motion_convention` says where they are otherwise), `depth` is in m, [N, H, W], and
            `instances` are ids of objects: arrays, lists of arrays, or paths.

    Returns:
        The events, with their provenance in `metadata`.

    Warns:
        TexventWarning: hardly an event is signal, or the motion vectors explain little.

    Raises:
        InputError: the source cannot be read, or holds NaN, negative or infinite intensities; or
            the motion vectors do not fit it.
        ConfigError: an unknown option, or a value out of range.

    Example:
        >>> import numpy as np, texvent
        >>> frames = np.zeros((3, 4, 4), np.uint8)
        >>> frames[1:, 2, 2] = 6  # one pixel becomes brighter
        >>> events = texvent.simulate(frames, fps=100, interpolate="none", noise="none")
        >>> events.x.tolist(), events.y.tolist(), events.p.tolist()
        ([2], [2], [1])
    """
    settings, arrays = _simulation(source, options, config)
    output = _truth_output(truth_folder, as_packets=as_packets)
    with open_progress(progress) as shown:
        run = prepare_source(
            source, settings, t_us=t_us, motion=arrays, prompt=prompt, progress=shown
        )
        if output is not None:
            return run_with_truth(run, output, shown)
    return run.packets if as_packets else _collected(run, progress)


@naming_options(GenerateOptions)
def video(
    prompt: Subject,
    *,
    config: str | Path | None = None,
    progress: ProgressOption = None,
    **options: Unpack[GenerateOptions],
) -> FrameStream:
    """The frames alone of the scene that a prompt describes.

    Args:
        prompt: what to show: a sentence, a scene file or a scene.
        config: a TOML or YAML file with options.
        progress: as `generate`.
        **options: as `generate`; those of the simulator have no effect.

    Returns:
        Frames at the generator's rate, fitted to the sensor; `simulate` takes them. The embedded
        generator renders them when they are iterated.

    Raises:
        InputError, ConfigError: as `generate`.

    Example:
        >>> import texvent
        >>> frames = texvent.video("a red ball bounces", sensor="48x36", duration=0.2)
        >>> frames.size, next(iter(frames)).pixels.shape
        (SensorSize(width=48, height=36), (36, 48, 3))
    """
    settings = resolve("generate", options, config=config)
    prompt = open_subject(prompt, getattr(settings.source, "assets", None))
    with open_progress(progress) as shown:
        return make_video(prompt, settings, progress=shown)


def compare(
    events: Events,
    reference: Events,
    metrics: str | Metric | Iterable[str | Metric] | None = None,
    *,
    span_us: tuple[int, int] | None = None,
) -> dict[str, float]:
    """Distance of events from a reference, by many metrics.

    Args:
        events: the stream to judge, or its file.
        reference: the true stream, or its file.
        metrics: a name, such as "stpp", or several; default: all but those whose weights are
            missing.
        span_us: compare only events with `start <= t < stop`, µs; default: all.

    Returns:
        Name → value, NaN where a metric is undefined for these streams.

    Raises:
        InputError: the sensors differ in size, or a metric's weights are not here.
        ConfigError: an unknown metric, or a span that is not longer than 0.

    Example:
        >>> import texvent
        >>> events = texvent.generate("a red ball bounces", sensor="48x36", duration=0.2, seed=3)
        >>> texvent.compare(events, events, ["count_ratio", "stpp"])
        {'count_ratio': 1.0, 'stpp': 1.0}
    """
    from texvent.metrics.compare import compare as compare_streams

    return compare_streams(_stream(events), _stream(reference), metrics, span_us=span_us)


def _truth_output(
    folder: str | Path | TruthFolder | None, *, as_packets: bool
) -> TruthFolder | None:
    """Truth folder of a run, checked; None without one."""
    if folder is None:
        return None
    if as_packets:
        raise ConfigError(
            "truth_folder is given with as_packets=True, whose events are not made yet; leave one "
            "of them out"
        )
    output = folder if isinstance(folder, TruthFolder) else TruthFolder(folder)
    output.check()
    return output


def _simulation(
    source: Source, options: SimulateOptions, config: str | Path | None
) -> tuple[Settings, dict[str, Any]]:
    """Settings of a run from frames, and its fields of motion that are in memory."""
    from texvent.capture.motion_vectors.frames import (
        find_motion_sidecar,  # brings the readers of frames
    )

    given: dict[str, Any] = dict(options)
    arrays = {
        name: given.pop(name)
        for name in ("motion", "motion_back", "depth", "instances")
        if not isinstance(given.get(name), str | Path | None)
    }
    is_moving = bool({"motion", "motion_back"} & arrays.keys())
    beside = is_moving or getattr(source, "has_motion", False) or find_motion_sidecar(source)
    return resolve("simulate", given, config=config, motion_beside=beside), arrays


def _collected(run: Simulation, progress: ProgressOption) -> EventStream:
    """The events of a run, with a warning if there is no signal or hardly any."""
    return replace(run, warns=True).packets.collect(progress=progress)


def _stream(events: Events) -> EventStream:
    """Events in memory, of a file or of packets too."""
    if isinstance(events, EventStream):
        return events
    return events.collect() if isinstance(events, EventPackets) else load(events)
