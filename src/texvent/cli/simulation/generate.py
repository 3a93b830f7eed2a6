"""`texvent generate PROMPT`: events, film, picture and page from a text prompt."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar

from texvent._registry import GENERATORS, load_object
from texvent.capture.open import open_frames
from texvent.cli.command import resolve_command
from texvent.cli.option_types import REQUIRED
from texvent.cli.options import peek_options
from texvent.cli.outputs import OutputOptions
from texvent.cli.run import execute, print_settings
from texvent.console_progress import ConsoleProgress
from texvent.errors import ConfigError, InputError
from texvent.generate.prompts.upsample_config import UpsampleConfig
from texvent.io.atomic import check_output
from texvent.pipeline import text_to_video, video_to_events
from texvent.settings import Settings

DESCRIPTION = """Turn a sentence into the events that an event camera would record. The embedded
generator renders simple 3-D shapes, without weights or download; `texvent generators` lists learned
models, whose videos are cached.

  texvent generate "a red car drives left past two trees at dusk" -o out.h5
  texvent generate "a dog runs" --generator wan-1.3b --simulator v2e --seed 3"""
STORED_VIDEO = "texvent.generate.videos.stored_video"
VIDEO_EXTENSION = ".avi"


@dataclass(frozen=True, kw_only=True)
class PromptOptions(UpsampleConfig):
    """What to show."""

    positional: ClassVar[tuple[str, ...]] = ("prompt",)
    main_options: ClassVar[tuple[str, ...]] = (
        "out", "generator", "duration", "fps", "sensor", "simulator", "preset",
        "contrast_threshold", "noise", "interpolate", "seed", "events_only", "config", "dry_run",
        "overwrite",
    )  # fmt: skip

    prompt: str = REQUIRED
    """What to show, in plain English, quoted."""
    generator: str = next(iter(GENERATORS.builtin))
    """Text-to-video generator: see texvent generators, ./folder or hub:org/name. A folder holds a
    saved diffusers pipeline; hub: names a repository of the model hub."""
    video_only: bool = False
    """Write the generated video (.avi, lossless, 16 bits) instead of events, and stop."""
    from_video: Path | None = None
    """Take this video for the prompt's instead of generating one; the options are then those of
    texvent simulate."""


@dataclass(frozen=True, kw_only=True)
class FromVideoOptions:
    """A prompt and its video."""

    positional: ClassVar[tuple[str, ...]] = ("prompt",)

    prompt: str = REQUIRED
    """What the video shows; stored with the events."""
    from_video: Path = REQUIRED
    """The video: one that --video-only wrote, or any other."""


def run(arguments: Sequence[str]) -> int:
    """Run the command; returns its exit code."""
    if peek_options(arguments, ("from_video",))["from_video"]:
        return _run_from_video(arguments)
    settings, own, output = resolve_command(
        "generate", arguments, PromptOptions(), description=DESCRIPTION
    )
    if output.print_config:
        return print_settings(settings)
    if own.video_only:
        return _write_video(own, settings, output)
    if output.dry_run and (plan := _plan(own.prompt, settings)) is not None:
        sys.stdout.write(f"{plan}\n")
        return 0
    output.check(own.prompt)
    with ConsoleProgress(is_quiet=output.quiet) as progress:
        video = text_to_video(detail(own.prompt, own, progress), settings, progress=progress)
    simulation = video_to_events(video, settings, prompt=own.prompt)
    return execute(simulation, output, subject=own.prompt)


def _plan(prompt: str, settings: Settings) -> str | None:
    """What a learned generator would have to do first; None if the video is at hand."""
    part = GENERATORS.load(str(settings.generator))
    generator = part(settings.source, seed=settings.run.seed, size=settings.size)
    plan = getattr(generator, "plan", None)
    return None if plan is None else plan(prompt)


def detail(prompt: str, options: UpsampleConfig, progress: ConsoleProgress) -> str:
    """The prompt that the generator is given: the user's, made detailed if that is wanted."""
    if options.upsample is None:
        return prompt
    detailed: str = load_object("texvent.generate.prompts.upsample:upsample_prompt")(
        prompt, options
    )
    progress.announce(f"prompt   {detailed}")
    return detailed


def _run_from_video(arguments: Sequence[str]) -> int:
    settings, own, output = resolve_command(
        "simulate", arguments, FromVideoOptions(), description=DESCRIPTION
    )
    if output.print_config:
        return print_settings(settings)
    if not own.from_video.is_file():
        raise InputError(f"no such video: {own.from_video}")
    output.check(own.prompt)
    # A video of ours knows what made it; any other is read as texvent simulate reads it.
    known = load_object(f"{STORED_VIDEO}:reopen")(own.from_video)
    source = known if known is not None and settings.source.fps is None else own.from_video
    video = open_frames(source, settings.source, size=settings.size)
    simulation = video_to_events(video, settings, prompt=own.prompt)
    return execute(simulation, output, subject=own.prompt)


def _write_video(own: PromptOptions, settings: Settings, output: OutputOptions) -> int:
    """Write the video of a prompt and print its path."""
    named = output.event_file(own.prompt)
    path = named if output.out is not None else named.with_suffix(VIDEO_EXTENSION)
    if path.suffix.lower() != VIDEO_EXTENSION:
        raise ConfigError(
            f"{path} is to hold a lossless video; its name must end in {VIDEO_EXTENSION}"
        )
    check_output(path, overwrite=output.overwrite)
    with ConsoleProgress(is_quiet=output.quiet) as progress:
        video = text_to_video(detail(own.prompt, own, progress), settings, progress=progress)
        load_object(f"{STORED_VIDEO}:write_stream")(video, path, overwrite=output.overwrite)
    if not output.quiet:
        sys.stdout.write(f"{path}\n")
    return 0
