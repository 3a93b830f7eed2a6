"""Learned text-to-video models: the table `known_models.toml`, and what its rows take of a control.

Every value of a row is a default that an option overrides. No row was run with its published
weights, which cannot be had where texvent's tests run; its pipeline class runs there with tiny
random weights of the same layout.
"""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from fractions import Fraction
from importlib.resources import files

from texvent.errors import ConfigError, shown
from texvent.generation.video_models.config import DiffusersConfig, VideoModel
from texvent.generation.video_models.controls import ControlPipeline

OF_CONTROL = ("look", "scene_seed", "assets", "least_agreement")
"""Options that belong to a control."""


def _read_table() -> dict[str, VideoModel]:
    text = files(__package__).joinpath("known_models.toml").read_text(encoding="utf-8")
    table, rows = tomllib.loads(text), {}
    publishers = table.pop("negative_prompts")
    for name, own in table.items():
        facts = {**table.get(own.pop("like", ""), {}), **own}
        maker = next((one for one in publishers if facts["repo"].startswith(one)), None)
        facts.setdefault("negative_prompt", publishers.get(maker))
        facts |= {
            key: tuple(facts.get(key, ())) for key in ("sigmas", "loras", "upscalers", "unused")
        }
        if "frame_range" in facts:
            facts["frame_range"] = tuple(facts["frame_range"])
        rows[name] = VideoModel(name=name, **facts | {"fps": Fraction(facts["fps"])})
    return rows


MODELS: Mapping[str, VideoModel] = _read_table()
"""Name → row, what people run most first."""


def check_control(model: VideoModel, config: DiffusersConfig) -> None:
    """Refuse a control, length or size that the model does not take; nothing is loaded for that.

    Raises:
        ConfigError: with what it takes.
    """
    pipeline = model.steering
    if pipeline is None:
        given = [name for name in ("control", *OF_CONTROL) if getattr(config, name) is not None]
        if given:
            able = ", ".join(name for name, row in MODELS.items() if row.steering is not None)
            raise ConfigError(
                f"{given[0]} is set, but {model.name} follows no scene; models that do: {able}"
            )
        return
    if config.control not in pipeline.controls:
        raise ConfigError(
            f"control is {shown(config.control)}; {model.name} takes {', '.join(pipeline.controls)}"
        )
    if pipeline.needs_lora and not config.lora:
        raise ConfigError(
            f"{model.name} follows a scene by a LoRA, and none is given; fetch it (hf download "
            f"{model.control_lora or 'REPOSITORY'}) and give lora=FILE"
        )
    _check_shape(model, config, pipeline)


def check_shape(model: VideoModel, config: DiffusersConfig) -> None:
    """Refuse a length or size that a row says its model does not make; nothing is loaded for that.

    Raises:
        ConfigError: with what it makes.
    """
    frames = config.frames
    if model.frame_range is not None and frames is not None:
        fewest, most = model.frame_range
        if not fewest <= frames <= most:
            raise ConfigError(f"frames is {frames}; {model.name} makes {fewest} to {most} frames")
    if model.frame_step is not None and frames is not None:
        _check_step(model, frames, model.frame_step)
    for name in ("width", "height"):
        value = getattr(config, name)
        if model.multiple is not None and value is not None and value % model.multiple:
            raise ConfigError(
                f"{name} is {value}; {model.name} takes multiples of {model.multiple}"
            )


def _check_shape(model: VideoModel, config: DiffusersConfig, pipeline: ControlPipeline) -> None:
    for name in ("frames", "width", "height"):
        if getattr(config, name) is None:
            raise ConfigError(f"{name} is not known of {model.name}; give {name}, such as 49")
    for name in ("width", "height"):
        value = getattr(config, name)
        if value % pipeline.side:
            near = max(pipeline.side, round(value / pipeline.side) * pipeline.side)
            raise ConfigError(
                f"{name} is {value}; {model.name} takes multiples of {pipeline.side}, such as "
                f"{near}"
            )
    frames = config.frames or 0
    longest = model.longest
    if longest is not None and frames > longest:
        seconds = f", {float(longest / model.fps):.3g} s at {model.fps} fps" if model.fps else ""
        raise ConfigError(
            f"frames is {frames}; {model.name} follows a scene over at most {longest} frames"
            f"{seconds}"
        )
    _check_step(model, frames, pipeline.step)


def _check_step(model: VideoModel, frames: int, step: int) -> None:
    if (frames - 1) % step:
        near = max(round((frames - 1) / step), 1) * step + 1
        raise ConfigError(
            f"frames is {frames}; {model.name} takes multiples of {step} and one more, such as "
            f"{near}"
        )
