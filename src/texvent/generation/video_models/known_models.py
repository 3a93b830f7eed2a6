"""Learned text-to-video models: the table `known_models.toml`, and the names that lead to a model.

One adapter (`diffusers_models/generator.py`) runs all of them. Every value of a row is a default
that an option overrides. No row was run with its published weights, which cannot be had where
texvent's tests run; its pipeline class runs there with tiny random weights of the same layout.
"""

from __future__ import annotations

import dataclasses
import functools
import os
import re
import tomllib
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from fractions import Fraction
from importlib.resources import files
from pathlib import Path
from typing import TYPE_CHECKING, Any

from texvent.errors import ConfigError, shown, warn
from texvent.generation.video_config import DiffusersConfig
from texvent.generation.video_models.model_files import HUB, NOT_READ, REPOSITORY

if TYPE_CHECKING:
    from texvent.generation.diffusers_models.generator import DiffusersGenerator
    from texvent.sensor import SensorSize

LEAST_FPS = 24
"""Frame rate from which a model is recommended for events."""


@dataclass(frozen=True, kw_only=True)
class VideoModel:
    """One learned model; None: the pipeline's own default."""

    name: str
    """Name that `--generator` takes."""
    repo: str = ""
    """Repository on the model hub, `org/name`; empty for a local folder."""
    folder: Path | None = None
    """Local folder with the model, instead of the repository."""
    revision: str | None = None
    """Branch, tag or commit; None: the default branch."""
    pipeline: str | None = None
    """diffusers class; None: the one that `model_index.json` names."""
    image_pipeline: str | None = None
    """diffusers class that starts from an image with the same weights."""
    needs_image: bool = False
    """Whether an image is required."""
    fps: Fraction | None = None
    """Frame rate the model was trained for; the weights do not state it."""
    frames: int | None = None
    width: int | None = None
    height: int | None = None
    steps: int | None = None
    guidance: float | None = None
    negative_prompt: str | None = None
    """Content to avoid, by the publisher's own program; the pipeline's default is none."""
    differs: str = ""
    """Why frames, size, steps or guidance are not the call defaults of the pipeline."""
    call: Mapping[str, Any] = field(default_factory=dict, hash=False)
    """Further arguments of the pipeline's call."""
    sigmas: tuple[float, ...] = ()
    """Noise levels that a few-step model was distilled for, first to last; used with as many
    steps."""
    scheduler: Mapping[str, Any] = field(default_factory=dict, hash=False)
    """Settings of the noise schedule that the publisher asks for."""
    licence: str = NOT_READ
    """Licence of the weights, by its SPDX name where it has one."""
    licence_source: str = ""
    """Publisher's repository or page and file where the licence was read; empty: not read."""
    licence_terms: str = ""
    """Obligations beyond keeping notices, in a few words."""
    gpu_gb: float | None = None
    """GPU memory with every part on the device, GB, as makers or users report it."""
    offload_gb: float | None = None
    """GPU memory with parts moved to the device when used, GB."""
    dtype: str = "bfloat16"
    """Number format on a GPU."""
    needs_float32_vae: bool = False
    """Whether the decoder should stay in float32 (Wan's page asks for it)."""
    ignores_fps: bool = False
    """Whether the rate is known not to change the frames."""

    @property
    def is_low_fps(self) -> bool:
        """Whether the rate is below `LEAST_FPS`."""
        return self.fps is not None and self.fps < LEAST_FPS

    @property
    def licence_and_terms(self) -> str:
        """Licence with its terms, for messages and metadata."""
        return f"{self.licence}; {self.licence_terms}" if self.licence_terms else self.licence

    @property
    def memory(self) -> str:
        """GPU memory that it needs, for messages."""
        parts = [f"{self.gpu_gb:g} GB"] if self.gpu_gb else []
        parts += [f"{self.offload_gb:g} GB with --offload model"] if self.offload_gb else []
        return f"GPU memory {', '.join(parts) or 'not known'}"

    @property
    def source(self) -> str:
        """Origin of the weights, for messages and metadata."""
        if self.folder is not None:
            return str(self.folder)
        return f"{self.repo}@{self.revision}" if self.revision else self.repo


def _read_table() -> dict[str, VideoModel]:
    text = files(__package__).joinpath("known_models.toml").read_text(encoding="utf-8")
    table, rows = tomllib.loads(text), {}
    publishers = table.pop("negative_prompts")
    for name, facts in table.items():
        maker = next((one for one in publishers if facts["repo"].startswith(one)), None)
        facts.setdefault("negative_prompt", publishers.get(maker))
        sigmas = tuple(facts.pop("sigmas", ()))
        rows[name] = VideoModel(name=name, **facts | {"fps": Fraction(facts["fps"])}, sigmas=sigmas)
    return rows


MODELS: Mapping[str, VideoModel] = _read_table()
"""Name → row, the paper's default first."""


@dataclass(frozen=True)
class ModelGenerator:
    """A row as a part that the pipeline builds: the value of `GENERATORS.load("wan-1.3b")`."""

    model: VideoModel
    default_interpolate: str = "flow"
    default_sensor: str | None = None
    """None: events have the size of the generated video."""

    @property
    def config_type(self) -> Callable[[], DiffusersConfig]:
        """Factory of the options with this model's defaults."""
        names = ("fps", "frames", "width", "height", "steps", "guidance", "negative_prompt")
        defaults = {name: getattr(self.model, name) for name in names}
        return functools.partial(DiffusersConfig, **defaults)

    def __call__(
        self, config: DiffusersConfig, *, seed: int, size: SensorSize | None
    ) -> DiffusersGenerator:
        """The generator; `size` is left to the pipeline, which fits the finished frames."""
        del size  # the model has sizes of its own, which have nothing to do with a sensor
        from texvent.generation.diffusers_models.generator import DiffusersGenerator

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
    ):
        known = _row_like(path.name)
        return ModelGenerator(
            dataclasses.replace(known, name=name, repo="", revision=None, folder=path)
        )
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
