"""`texvent generate --preview FILE.png`: what a prompt shows, in a second or two."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from texvent.cli.notices import say, write_out
from texvent.cli.run import describe_scene
from texvent.errors import ConfigError
from texvent.generate.procedural import ProceduralGenerator, ProceduralVideo
from texvent.generate.scene_input import Subject
from texvent.io.atomic import atomic_file, check_output
from texvent.run.prepare import make_video
from texvent.runtime.displays.console_progress import ConsoleProgress
from texvent.settings.resolution import Settings
from texvent.video import frame_time_us

EXTENSION = ".png"


def check_preview(path: Path, generator_class: type, *, overwrite: bool) -> None:
    """Refuse a preview that cannot be, before any work.

    Raises:
        ConfigError: the name does not end in .png, or the generator is a learned model.
        OutputError: the file exists already, or cannot be written.
    """
    if path.suffix.lower() != EXTENSION:
        raise ConfigError(f"preview is {path}; its name must end in {EXTENSION}")
    if not issubclass(generator_class, ProceduralGenerator):
        raise ConfigError(
            "--preview shows scenes of the embedded generator; a learned model must make its whole "
            "video first: use --video-only"
        )
    check_output(path, overwrite=overwrite)


_ABOUT_HALF = 0.43
"""Of the clip. At its half, what repeats every second would look as at the beginning."""


def write_preview(
    prompt: Subject, settings: Settings, path: Path, *, overwrite: bool,
    is_quiet: bool,
) -> None:  # fmt: skip
    """Write the scene at its beginning, about its middle and its end; say what is shown.

    Raises:
        InputError: the prompt cannot be shown.
        OutputError: the image cannot be written.
    """
    from texvent.view.stills import draw_stills  # brings OpenCV

    settings = replace(settings, source=replace(settings.source, samples=1))  # a draft
    with ConsoleProgress(is_quiet=is_quiet) as progress:
        video = make_video(prompt, settings, progress=progress)
    if not is_quiet:
        for line in describe_scene(video.metadata, with_words=True):
            say(line)
    if not isinstance(video, ProceduralVideo):
        raise ConfigError("--preview needs a scene of the embedded generator")
    end_us = frame_time_us(video.frame_count - 1, video.fps)
    image = draw_stills(video, (0, round(_ABOUT_HALF * end_us), end_us))
    with atomic_file(path, overwrite=overwrite) as part:
        part.write_bytes(image)
    if not is_quiet:
        write_out(f"{path}\n")
