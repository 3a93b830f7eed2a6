"""Protocol of text-to-video generators."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, ClassVar, Protocol

from texvent.frames import FrameStream
from texvent.runtime.progress import Progress


class Generator(Protocol):
    """Turns a prompt into a video (Eq. 3).

    Built as `Generator(config, seed=seed, size=size)`; size None means its own. A class may also
    have `default_sensor`: a sensor name, or None to keep the size of its videos.
    """

    config_type: ClassVar[Callable[[], Any]]
    """Frozen dataclass with the generator's options, or a function that gives its defaults."""
    default_interpolate: ClassVar[str]
    """Interpolator that suits its videos: "motion" or "exact" if they can be rendered at any
    instant."""

    def generate(self, prompt: str, *, progress: Progress | None = None) -> FrameStream:
        """The video for `prompt`.

        Frames are made on demand where the generator can, all at once before this returns where
        it cannot (learned models). Their size is the generator's own; the pipeline
        fits them to the sensor.

        Args:
            prompt: what to show.
            progress: receives progress; may stop the run.

        Raises:
            InputError: the prompt is empty.
        """
        ...


def renders_instants(generator_class: type) -> bool:
    """Whether the videos of a generator can be rendered at any instant, and so again."""
    if getattr(generator_class, "makes_whole_videos", False):
        return False  # some know the motion between their frames
    return getattr(generator_class, "default_interpolate", None) in ("exact", "motion")
