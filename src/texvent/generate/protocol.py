"""What every text-to-video generator offers."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, ClassVar, Protocol

from texvent.sensor import SensorSize
from texvent.video import FrameStream


class Generator(Protocol):
    """Turns a prompt into a video (Eq. 3). Built as `Generator(config, seed=seed, size=size)`."""

    config_type: ClassVar[type]
    """Frozen dataclass with the generator's options."""
    default_interpolate: ClassVar[str]
    """Interpolator that suits its videos: "exact" if they can be rendered at any instant."""

    def generate(self, prompt: str) -> FrameStream:
        """The video for `prompt`; frames are made as they are asked for.

        Raises:
            InputError: the prompt is empty.
        """
        ...


class GeneratorFactory(Protocol):
    """How a generator class is called."""

    config_type: ClassVar[type]
    default_interpolate: ClassVar[str]

    def __call__(self, config: Any, *, seed: int, size: SensorSize | None) -> Generator:
        """Build a generator; `size` None means its own default size."""
        ...


Notes = Mapping[str, Any]
"""What a generator reports about a prompt, such as the words it did not understand."""
