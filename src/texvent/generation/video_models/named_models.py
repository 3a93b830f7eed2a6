"""Names that lead to a learned model: a row, `hub:org/name`, a folder; each a part of the pipeline.

One adapter (`diffusers_models/generator.py`) runs all of them.
"""

from __future__ import annotations

import dataclasses
import functools
import os
import re
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from texvent.errors import ConfigError, shown, warn
from texvent.generation.video_models.config import LEAST_FPS, DiffusersConfig, VideoModel
from texvent.generation.video_models.controls import with_controls
from texvent.generation.video_models.known_models import MODELS
from texvent.generation.video_models.model_files import HUB, INDEX, REPOSITORY

if TYPE_CHECKING:
    from texvent.generation.diffusers_models.generator import DiffusersGenerator
    from texvent.sensor import SensorSize


@dataclass(frozen=True)
class ModelGenerator:
    """A row as a part that the pipeline builds: the value of `GENERATORS.load("wan-1.3b")`."""

    model: VideoModel
    default_sensor: str | None = None
    """None: events have the size of the generated video."""
    makes_whole_videos: bool = True

    @property
    def takes_scenes(self) -> bool:
        """Whether its videos follow scenes."""
        return self.model.steering is not None

    has_ground_truth = takes_scenes

    @property
    def default_interpolate(self) -> str:
        """Interpolator that suits its videos."""
        return "motion" if self.takes_scenes else "flow"

    @property
    def config_type(self) -> Callable[[], DiffusersConfig]:
        """Factory of the options with this model's defaults."""
        names = ("fps", "frames", "width", "height", "steps", "guidance", "negative_prompt")
        defaults = {name: getattr(self.model, name) for name in names}
        if self.model.steering is not None:
            defaults["control"] = self.model.steering.controls[0]
        return functools.partial(DiffusersConfig, **defaults)

    def __call__(
        self, config: DiffusersConfig, *, seed: int, size: SensorSize | None
    ) -> DiffusersGenerator:
        """The generator; `size` is left to the pipeline, which fits the finished frames."""
        del size  # the model has sizes of its own, which have nothing to do with a sensor
        from texvent.generation.diffusers_models.generator import DiffusersGenerator
        from texvent.generation.diffusers_models.steered import SteeredGenerator

        if self.takes_scenes:
            return SteeredGenerator(config, model=self.model, seed=seed)
        return DiffusersGenerator(config, model=self.model, seed=seed)


def names() -> tuple[str, ...]:
    """Names of the rows."""
    return tuple(MODELS)


def find(name: str) -> ModelGenerator | None:
    """The generator of that name, or None.

    Args:
        name: a row, `hub:org/name[@revision]`, or the path of a folder with a saved pipeline. A
            folder or repository named like a row takes the row's defaults.

    Raises:
        ConfigError: `hub:` is followed by no repository name.
    """
    if name in MODELS:
        return ModelGenerator(MODELS[name])
    if name.startswith(HUB):
        repo, _, revision = name.removeprefix(HUB).partition("@")
        if not re.fullmatch(REPOSITORY, repo):
            raise ConfigError(
                f"generator {shown(name)} names no repository; write hub:organisation/name"
            )
        known = _row_like(repo.rpartition("/")[2])
        revision_or_row = revision or known.revision
        return ModelGenerator(
            dataclasses.replace(known, name=name, repo=repo, revision=revision_or_row)
        )
    path = Path(name).expanduser()
    if (
        name.startswith(("./", "../", "~"))
        or path.is_absolute()
        or (os.sep in name and path.is_dir())
        or os.path.isfile(path / INDEX)
    ):
        known = _row_like(path.name)
        model = dataclasses.replace(known, name=name, repo="", revision=None, folder=path)
        return ModelGenerator(with_controls(model))
    return None


def warn_low_fps(name: str) -> None:
    """Warn of a model that makes few frames per second; other generators pass.

    Args:
        name: value of `--generator`.

    Warns:
        TexventWarning: it makes fewer than `LEAST_FPS`.
    """
    part = find(name)
    if part is not None and part.model.is_low_fps:
        warn(
            f"{part.model.name} makes {part.model.fps} frames per second, so much moves between "
            f"two of them; models of {LEAST_FPS} and more suit events better: texvent generators"
        )


def _row_like(last_name: str) -> VideoModel:
    """The row of that name, or whose repository ends in it, or one that leaves everything open."""
    if last_name in MODELS:
        return MODELS[last_name]
    for row in MODELS.values():
        if row.repo.rpartition("/")[2] == last_name:
            return row
    return VideoModel(name=last_name)
