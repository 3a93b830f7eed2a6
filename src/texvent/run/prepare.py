"""A run made ready: everything checked, its video there, its target rate reached.

The Python API, the command line, the web page, training samples and benchmarks all start here.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any, cast

from texvent._registry import DEFAULT_GENERATOR, GENERATORS, INTERPOLATORS, SIMULATORS
from texvent.errors import InputError, warn
from texvent.frames import FrameStream
from texvent.generation.subjects import SceneValue, Subject, check_takes, scenes
from texvent.pipeline import Simulation, text_to_events, text_to_video, video_to_events
from texvent.prompt_report import PromptReport
from texvent.run.rate_search import reach_target_rate
from texvent.runtime.memory import usable_bytes
from texvent.runtime.progress import Progress
from texvent.sensor import SensorSize
from texvent.settings.provenance import describe_weights
from texvent.settings.resolution import Settings
from texvent.simulation.gpu.support import choose_device

UNMEASURED = 200
"""Bytes per pixel of a part that declares none."""


def check_run(settings: Settings) -> None:
    """Refuse a run that cannot be, before any work.

    Raises:
        InputError: weights of the simulator or the interpolator are not here, or the sensor's
            pixels do not fit into memory.
        MissingDependencyError: a network needs a package.
    """
    describe_weights(settings)
    device = choose_device(settings.run, settings.simulate)
    if settings.size is not None:
        check_memory(settings, settings.size)
        device.check_memory(settings.size)


def estimate_bytes(settings: Settings, size: SensorSize) -> int:
    """Memory for the frames, the interpolator and the pixels of a run, bytes.

    Simulators and interpolators declare `bytes_per_pixel`, measured on moving texture; the frames
    in the queue count to the simulator. Memory does not grow with the length of a clip.
    """
    parts = (
        SIMULATORS.load(settings.run.simulator),
        INTERPOLATORS.load(settings.interpolate.interpolate),
    )
    per_pixel = sum(getattr(part, "bytes_per_pixel", UNMEASURED) for part in parts)
    return size.width * size.height * per_pixel


def check_memory(settings: Settings, size: SensorSize) -> None:
    """Refuse frames that do not fit into the memory of the machine: the system would end the run.

    Raises:
        InputError: they do not fit.
    """
    needed, usable = estimate_bytes(settings, size), usable_bytes()
    if needed > usable:
        raise InputError(
            f"frames of {size} pixels need about {needed / 1e9:.3g} GB of memory with "
            f"{settings.run.simulator} and interpolator {settings.interpolate.interpolate}; "
            f"{usable / 1e9:.3g} GB are usable here: give a smaller sensor"
        )


def prepare_prompt(
    prompt: Subject,
    settings: Settings,
    *,
    progress: Progress | None = None,
) -> Simulation:
    """The run of a prompt; a learned model makes its video here.

    Args:
        prompt: what to show: a sentence, or a scene of the embedded generator; stored with the
            events as it is given here.
        settings: all options.
        progress: receives progress of video generation and of the rate search.

    Raises:
        ConfigError: the run is impossible, which is found before the model starts.
        InputError: the prompt is empty, a file is missing, or the target rate is out of reach.
    """
    check_run(settings)
    prompt = _checked(prompt)
    simulation = text_to_events(prompt, settings, progress=progress)
    return reach_target_rate(simulation, progress=progress)


def open_subject(prompt: Subject, assets: Path | None = None) -> Subject:
    """The prompt, or the scene of a file if it names one.

    Raises:
        InputError: the file cannot be read.
        ConfigError: a field is wrong or a word is not shown, also with models of `assets`; the
            message begins with the name of the file.
    """
    if not isinstance(prompt, str) or not scenes().is_scene_file(prompt):
        return prompt
    return cast(Subject, scenes().check_words(scenes().load_scene(prompt), assets))


def report_prompt(
    prompt: Subject, settings: Settings, *, is_staged: bool = True
) -> PromptReport | None:
    """Report of the scene of a prompt, without its video.

    Args:
        prompt: what to show.
        settings: all options.
        is_staged: whether the scene is built too, which finds more and takes 0.1 s.

    Returns:
        The report; None for a learned generator, which gives none.

    Raises:
        InputError: the generator refuses the prompt.
    """
    generator_class = GENERATORS.load(settings.generator or DEFAULT_GENERATOR)
    check_takes(prompt, generator_class, str(settings.generator))
    generator = generator_class(settings.source, seed=settings.run.seed, size=settings.size)
    report: Callable[..., PromptReport] | None = getattr(generator, "report", None)
    return None if report is None else report(prompt, is_staged=is_staged)


def is_strict(settings: Settings) -> bool:
    """Whether prompts that are not shown as they say are refused."""
    return bool(getattr(settings.source, "strict", False))


def make_video(
    prompt: Subject,
    settings: Settings,
    *,
    progress: Progress | None = None,
) -> FrameStream:
    """The video of a prompt, fitted to the sensor; arguments and errors as `prepare_prompt`."""
    prompt = _checked(prompt)
    return text_to_video(prompt, settings, progress=progress)


def make_scene(prompt: Subject, settings: Settings) -> SceneValue:
    """The scene of a prompt; arguments and errors as `prepare_prompt`.

    Warns:
        TexventWarning: some of its words are not shown as they say.
    """
    name = settings.generator or DEFAULT_GENERATOR
    check_takes(None, GENERATORS.load(name), name)
    prompt = _checked(prompt)
    if not isinstance(prompt, str):
        return prompt
    reading = scenes().read(prompt, assets=getattr(settings.source, "assets", None))
    report = PromptReport(
        substituted=reading.substituted,
        not_understood=reading.not_understood,
        not_shown=tuple(f"{one} (checked only in a drawn prompt)" for one in reading.open_words),
    )
    for fault in report.warnings():
        warn(fault)
    return reading.scene


def prepare_source(
    source: Any,
    settings: Settings,
    *,
    t_us: Any = None,
    motion: Mapping[str, Any] | None = None,
    prompt: str | None = None,
    video_seed: int | None = None,
    progress: Progress | None = None,
) -> Simulation:
    """The run of recorded frames.

    Args:
        source: as `texvent.capture.open.open_frames` takes it.
        settings: all options.
        t_us: frame times of an array, µs.
        motion: motion vectors, depth and ids in memory, as `attach_motion` takes them.
        prompt: what the video shows; stored with the events. A video that texvent generated and
            wrote brings the facts of its generation along.
        video_seed: of a camera that shakes over a still image; None: that of the run.
        progress: receives progress of the rate search.

    Raises:
        ConfigError: the run is impossible.
        InputError: the frames cannot be read, or the target rate is out of reach.
    """
    from texvent.capture.open import open_frames  # brings readers that a prompt does not need

    check_run(settings)
    is_plain = motion is None and t_us is None and _is_as_stored(settings.source)
    if prompt is not None and is_plain:
        source = _stored_video(source) or source
    video = open_frames(
        source,
        settings.source,
        size=settings.size,
        t_us=t_us,
        motion=motion,
        seed=settings.run.seed if video_seed is None else video_seed,
    )
    return prepare_video(video, settings, prompt=prompt, progress=progress)


def prepare_video(
    video: FrameStream,
    settings: Settings,
    *,
    prompt: str | None = None,
    progress: Progress | None = None,
) -> Simulation:
    """The run of a video that is open already; arguments and errors as `prepare_source`."""
    check_run(settings)
    check_memory(settings, video.size)
    simulation = video_to_events(video, settings, prompt=prompt)
    simulation.device.check_memory(video.size)
    return reach_target_rate(simulation, progress=progress)


def _is_as_stored(capture: Any) -> bool:
    """Whether frames are all that is read, at their own rate and in their own light."""
    others = ("motion", "camera", "fps", "white_level")
    is_own_light = getattr(capture, "transfer", "auto") == "auto"
    return is_own_light and all(getattr(capture, name, None) is None for name in others)


def _stored_video(source: Any) -> FrameStream | None:
    """A video file that texvent wrote, with what made it; None for any other source."""
    if not isinstance(source, str | Path) or not Path(source).is_file():
        return None
    from texvent.generation.videos.stored_video import reopen  # brings PyAV

    video = reopen(Path(source))
    if video is None:
        return None
    return replace(video, metadata={**video.metadata, "source": str(source)})


def _checked(prompt: Any) -> Subject:
    """A prompt, or a scene whose fields are checked and built as those of files."""
    if isinstance(prompt, str):
        return prompt
    if not scenes().is_scene(prompt):
        raise InputError(
            f"the prompt is a {type(prompt).__name__}; give a text, such as 'a red car drives "
            "left', or a texvent_scenes.Scene"
        )
    return cast(Subject, scenes().checked_scene(prompt))
