"""`texvent generate --preview FILE.png`: what a prompt shows, in a second or two."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

from texvent._registry import GENERATORS
from texvent.cli.notices import say, write_out
from texvent.cli.outputs import OutputOptions
from texvent.cli.run import describe_scene
from texvent.errors import ConfigError
from texvent.generate.procedural import ProceduralGenerator
from texvent.generate.scene_input import Subject
from texvent.io.atomic import atomic_file, check_output
from texvent.run.prepare import make_video
from texvent.runtime.displays.console_progress import ConsoleProgress
from texvent.settings.resolution import Settings
from texvent.video import frame_time_us

EXTENSION = ".png"
_ABOUT_HALF = 0.43
"""Of the clip. At its half, what repeats every second would look as at the beginning."""


def write_preview(prompt: Subject, settings: Settings, path: Path, output: OutputOptions) -> None:
    """Write the scene at its beginning, about its middle and its end; say what is shown.

    Raises:
        ConfigError: the name does not end in .png, or the generator is a learned model.
        InputError: the prompt cannot be shown.
        OutputError: the file exists already, or cannot be written.
    """
    from texvent.view.stills import draw_stills  # brings OpenCV

    if path.suffix.lower() != EXTENSION:
        raise ConfigError(f"preview is {path}; its name must end in {EXTENSION}")
    if not issubclass(GENERATORS.load(str(settings.generator)), ProceduralGenerator):
        raise ConfigError(
            "--preview shows scenes of the embedded generator; a learned model must make its whole "
            "video first: use --video-only"
        )
    check_output(path, overwrite=output.overwrite)
    settings = replace(settings, source=replace(settings.source, samples=1))  # a draft
    with ConsoleProgress(is_quiet=output.quiet) as progress:
        video = make_video(prompt, settings, progress=progress)
    if not output.quiet:
        for line in describe_scene(video.metadata, with_words=True):
            say(line)
    scene: Any = video
    end_us = frame_time_us(scene.frame_count - 1, scene.fps)
    image = draw_stills(scene, (0, round(_ABOUT_HALF * end_us), end_us))
    with atomic_file(path, overwrite=output.overwrite) as part:
        part.write_bytes(image)
    if not output.quiet:
        write_out(f"{path}\n")
