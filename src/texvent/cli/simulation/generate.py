"""`texvent generate PROMPT`: events, video, image and page from a text prompt."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, ClassVar, cast

from texvent._registry import DEFAULT_GENERATOR, GENERATORS
from texvent.cli.command import read_subject, resolve_command, subject_name
from texvent.cli.notices import say, write_out
from texvent.cli.option_types import REQUIRED
from texvent.cli.outputs import OutputOptions, default_event_file
from texvent.cli.run import describe_scene, execute, print_settings
from texvent.config import IdleOptions
from texvent.errors import ConfigError, InputError, warn
from texvent.frames import frame_time_us
from texvent.generation.subjects import SceneValue, Subject, check_takes, scenes
from texvent.generation.video_models.named_models import warn_low_fps
from texvent.io.atomic import atomic_file, check_output
from texvent.run.prepare import check_run, is_strict, make_scene, make_video, prepare_prompt
from texvent.runtime.console_progress import ConsoleProgress
from texvent.settings.resolution import Settings
from texvent.truth.layout import check_generator

DESCRIPTION = """Turn a sentence into the events that an event camera would record. The embedded
generator renders simple 3-D shapes; `texvent generators` lists learned models.

  texvent generate "a red car drives left past two trees at dusk" -o out.h5
  texvent generate "a dog runs" --generator wan-1.3b --simulator v2e --seed 3"""
VIDEO_EXTENSION, STILLS_EXTENSION = ".avi", ".png"
ABOUT_HALF = 0.43
"""Share of the clip. At its half, what repeats every second would look as at the beginning."""


@dataclass(frozen=True, kw_only=True)
class PromptOptions:
    """Scene."""

    input_texts: ClassVar[tuple[str, ...]] = ("generator",)
    outputs: ClassVar[tuple[str, ...]] = ("out", "preview", "write_scene")
    positional: ClassVar[tuple[str, ...]] = ("prompt",)
    main_options: ClassVar[tuple[str, ...]] = (
        "out", "generator", "duration", "sensor", "simulator", "preset",
        "contrast_threshold", "noise", "interpolate", "seed", "device", "previews", "config",
        "preview", "dry_run", "overwrite",
    )  # fmt: skip

    idle_with: ClassVar[IdleOptions] = {"llm_model": ("llm_url", (None,))}

    prompt: str = REQUIRED
    """Scene: a quoted sentence, or a scene file. See docs/scenes.md."""
    generator: str = DEFAULT_GENERATOR
    """Text-to-video generator: see texvent generators, ./folder or hub:org/name. A folder holds a
    saved diffusers pipeline; hub: names a repository of the model hub."""
    video_only: bool = False
    """Write the generated video (.avi, lossless, 16 bits) instead of events, and stop."""
    preview: Path | None = None
    """Stills of the scene (.png) instead of events. Says what is shown, and stops."""
    write_scene: Path | None = None
    """Write the scene of the prompt as a file (.toml, .json) instead of events, and stop."""
    llm_url: str | None = None
    """A language model reads the prompt instead of the embedded reader: its OpenAI-compatible
    server, such as http://localhost:8080/v1. See docs/scenes.md."""
    llm_model: str | None = None
    """Name of the model on that server."""


def run(arguments: Sequence[str]) -> int:
    """Run the command; returns its exit code."""
    settings, own, output = resolve_command(
        "generate", arguments, PromptOptions(), description=DESCRIPTION
    )
    if output.print_config:
        return print_settings(settings)
    _refuse_two_results(own, output)
    prompt = (
        _written(own, settings)
        if own.llm_url is not None
        else read_subject(own.prompt, getattr(settings.source, "assets", None))
    )
    if own.write_scene is not None:
        return _write_scene(prompt, own, settings, output)
    if own.video_only:
        return _write_video(prompt, own, settings, output)
    if own.preview is not None:
        _write_preview(prompt, settings, own.preview, output)
        return 0
    check_run(settings)
    files = output.files(subject_name(own.prompt))
    if files.truth:
        check_generator(own.generator)
    warn_low_fps(own.generator)
    if output.dry_run and (plan := _plan(prompt, settings)) is not None:
        write_out(f"{plan}\n")
        return 0
    with ConsoleProgress(is_quiet=output.quiet) as progress:
        simulation = prepare_prompt(prompt, settings, progress=progress)
    return execute(simulation, output, files)


def _refuse_two_results(own: PromptOptions, output: OutputOptions) -> None:
    """Refuse options that stop before the events beside each other or -o.

    Raises:
        ConfigError: two are given.
    """
    asked = {
        "-o": output.out is not None and not own.video_only and not output.dry_run,
        "--dry-run": output.dry_run,
        "--video-only": own.video_only,
        "--preview": own.preview is not None,
        "--write-scene": own.write_scene is not None,
    }
    given = [flag for flag, is_given in asked.items() if is_given]
    if len(given) > 1:
        raise ConfigError(f"{' and '.join(given)} exclude each other; give one of them")


def _written(own: PromptOptions, settings: Settings) -> SceneValue:
    """The scene that a language model writes for the prompt.

    Raises:
        InputError: `strict`, and the scene shows some words of the prompt by nothing.

    Warns:
        TexventWarning: there are such words, or the model added something.
    """
    if scenes().is_scene_file(own.prompt):
        raise ConfigError(f"--llm-url reads a sentence, and {own.prompt} is a scene file")
    name = str(settings.generator)
    check_takes(None, GENERATORS.load(name), name)
    scene, report = scenes().write_scene(own.prompt, own.llm_url or "", own.llm_model or "default")
    refusal = report.refusal() if is_strict(settings) else None
    if refusal is not None:
        raise InputError(refusal)
    for line in (*report.faults(), *report.notes):
        warn(f"prompt {line}")
    return cast(SceneValue, scene)


def _plan(prompt: Subject, settings: Settings) -> str | None:
    """Work that a learned generator has to do first; None if the video is stored."""
    part = GENERATORS.load(str(settings.generator))
    check_takes(prompt, part, str(settings.generator))
    generator = part(settings.source, seed=settings.run.seed, size=settings.size)
    plan = getattr(generator, "plan", None)
    return None if plan is None else plan(prompt)


def _write_scene(
    prompt: Subject, own: PromptOptions, settings: Settings, output: OutputOptions
) -> int:
    """Write the scene of a prompt and print its path."""
    path = own.write_scene or Path()
    scene = make_scene(prompt, settings)
    scenes().save_scene(path, scene, overwrite=output.overwrite)
    if not output.quiet:
        write_out(f"{path}\n")
    return 0


def _write_video(
    prompt: Subject, own: PromptOptions, settings: Settings, output: OutputOptions
) -> int:
    """Write the video of a prompt and print its path."""
    from texvent.generation.videos.stored_video import write_stream  # brings PyAV

    named = default_event_file(subject_name(own.prompt)).with_suffix(VIDEO_EXTENSION)
    path = output.out or named
    if output.format or output.truth:
        raise ConfigError("--video-only writes a video; leave out --format and --truth")
    if path.suffix.lower() != VIDEO_EXTENSION:
        raise ConfigError(
            f"{path} is to hold a lossless video; its name must end in {VIDEO_EXTENSION}"
        )
    check_output(path, overwrite=output.overwrite)
    warn_low_fps(own.generator)
    with ConsoleProgress(is_quiet=output.quiet) as progress:
        video = make_video(prompt, settings, progress=progress)
        write_stream(video, path, overwrite=output.overwrite)
    if not output.quiet:
        write_out(f"{path}\n")
    return 0


def _write_preview(prompt: Subject, settings: Settings, path: Path, output: OutputOptions) -> None:
    """Write the scene at its beginning, about its middle and its end; say what is shown.

    Of a learned model that follows a scene: its control video.

    Raises:
        ConfigError: the name does not end in .png, or the generator is a learned model.
        InputError: the prompt cannot be shown.
        OutputError: the file exists already, or cannot be written.
    """
    from texvent.view.stills import draw_stills  # brings OpenCV

    if path.suffix.lower() != STILLS_EXTENSION:
        raise ConfigError(f"preview is {path}; its name must end in {STILLS_EXTENSION}")
    part_class = GENERATORS.load(str(settings.generator))
    if not getattr(part_class, "takes_scenes", False):
        raise ConfigError(
            "--preview shows scenes of the embedded generator; a learned model must make its whole "
            "video first: use --video-only"
        )
    check_output(path, overwrite=output.overwrite)
    if is_steered := getattr(part_class, "makes_whole_videos", False):
        video = part_class(settings.source, seed=settings.run.seed, size=None).draw(prompt)
    else:
        settings = replace(settings, source=replace(settings.source, samples=1))  # a draft
        with ConsoleProgress(is_quiet=output.quiet) as progress:
            video = make_video(prompt, settings, progress=progress)
    if not output.quiet:
        for line in describe_scene(video.metadata, with_words=True):
            say(line)
    scene: Any = video
    last = scene.frame_count - 1
    if is_steered:
        frames = [scene[round(share * last)] for share in (0, ABOUT_HALF, 1)]
    else:
        end_us = frame_time_us(last, scene.fps)
        frames = [scene.at(t_us) for t_us in (0, round(ABOUT_HALF * end_us), end_us)]
    image = draw_stills(frames)
    with atomic_file(path, overwrite=output.overwrite) as part:
        part.write_bytes(image)
    if not output.quiet:
        write_out(f"{path}\n")
