"""Generator names beyond the registry: table rows, `hub:org/name`, folders of saved pipelines."""

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
from texvent.generate.video_config import DiffusersConfig
from texvent.generate.video_models.hub_names import HUB, REPOSITORY
from texvent.generate.video_models.known_models import LEAST_FPS, MODELS, VideoModel

if TYPE_CHECKING:
    from texvent.generate.diffusers_models.generator import DiffusersGenerator
    from texvent.sensor import SensorSize


@dataclass(frozen=True)
class ModelGenerator:
    """A row as a part that the pipeline can build: what `GENERATORS.load("wan-1.3b")` gives."""

    model: VideoModel
    default_interpolate: str = "flow"
    default_sensor: str | None = None
    """None: events have the size of the generated video."""

    @property
    def config_type(self) -> Callable[[], DiffusersConfig]:
        """Makes the options with this model's defaults."""
        defaults = {
            field.name: getattr(self.model, field.name)
            for field in dataclasses.fields(DiffusersConfig)
            if field.name in ("fps", "frames", "width", "height", "steps", "guidance")
        }
        return functools.partial(DiffusersConfig, **defaults)

    def __call__(
        self, config: DiffusersConfig, *, seed: int, size: SensorSize | None
    ) -> DiffusersGenerator:
        """The generator; `size` is left to the pipeline, which fits the finished frames."""
        del size  # the model has sizes of its own, which have nothing to do with a sensor
        from texvent.generate.diffusers_models.generator import DiffusersGenerator

        return DiffusersGenerator(config, model=self.model, seed=seed)


def names() -> tuple[str, ...]:
    """Names of the rows."""
    return tuple(MODELS)


def find(name: str) -> ModelGenerator | None:
    """The generator of that name, or None.

    A row's name, `hub:org/name`, or the path of a folder that holds a saved pipeline. A
    folder or repository that is named like one of a row takes the row's defaults.

    Raises:
        ConfigError: what follows `hub:` is no repository.
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
    ):
        known = _row_like(path.name)
        return ModelGenerator(
            dataclasses.replace(known, name=name, repo="", revision=None, folder=path)
        )
    return None


def warn_low_fps(name: str) -> None:
    """Say that a model makes few frames per second; other generators are let pass.

    Args:
        name: what `--generator` was given.

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
