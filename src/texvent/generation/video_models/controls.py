"""Control of a video by a scene: pipelines that follow a control video, and what each takes."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from types import MappingProxyType
from typing import TYPE_CHECKING

from texvent.errors import ConfigError, FileFormatError, InputError, shown
from texvent.generation.video_models.model_files import (
    CONFIG,
    CONTROL_PART,
    find_network,
    read_json,
    read_pipeline_index,
)

if TYPE_CHECKING:
    from pathlib import Path

    from texvent.generation.video_models.config import DiffusersConfig, VideoModel


@dataclass(frozen=True)
class ControlPipeline:
    """A diffusers class whose videos follow a control video."""

    argument: str
    """Argument of its call that takes the control video."""
    controls: tuple[str, ...]
    """Controls that its publisher's program makes, the default first."""
    side: int
    """Width and height are multiples of it."""
    step: int
    """Frames are multiples of it and one more."""
    transformer: str
    """Class of its network."""
    needs_lora: bool = False
    """Whether its control is a LoRA, without which the video follows nothing."""
    is_channels: bool = False
    """Whether the control is more channels of the network's input."""


PIPELINES: Mapping[str, ControlPipeline] = MappingProxyType(
    {
        # github.com/ali-vilab/VACE: vace/annotators/{depth,scribble,flow}.py
        "WanVACEPipeline": ControlPipeline(
            "video", ("depth", "edges", "flow"), 16, 4, "WanVACETransformer3DModel"
        ),
        # github.com/nvidia-cosmos/cosmos-transfer2.5: scripts/diffusers_inference.py
        "Cosmos2_5_TransferPipeline": ControlPipeline(
            "controls", ("depth", "edges", "ids"), 16, 4, "CosmosTransformer3DModel"
        ),
        # github.com/aigc-apps/VideoX-Fun: README.md (Canny, depth; also pose, MLSD). Its decoder
        # makes other numbers of frames of even numbers of latent ones.
        "CogVideoXFunControlPipeline": ControlPipeline(
            "control_video",
            ("depth", "edges"),
            16,
            8,
            "CogVideoXTransformer3DModel",
            is_channels=True,
        ),
        # The card of Lightricks/LTX-2.3-22b-IC-LoRA-Union-Control (Canny, depth; also pose)
        "LTX2InContextPipeline": ControlPipeline(
            "reference_conditions",
            ("depth", "edges"),
            32,
            8,
            "LTX2VideoTransformer3DModel",
            needs_lora=True,
        ),
    }
)
"""diffusers class → how it follows a scene."""


def with_controls(model: VideoModel) -> VideoModel:
    """The model, with the class that its folder names where nothing else says that it follows."""
    if model.pipeline is not None or model.folder is None:
        return model
    try:
        name = str(read_pipeline_index(model.folder)["_class_name"])
    except (InputError, FileFormatError):
        return model  # said when the files are needed
    return replace(model, pipeline=name) if name in PIPELINES else model


def check_control(model: VideoModel, config: DiffusersConfig) -> None:
    """Refuse a control, length or size that the model does not take; nothing is loaded for that.

    Raises:
        ConfigError: with what it takes.
    """
    pipeline = model.steering
    if pipeline is None:
        given = [name for name in ("control", *OF_CONTROL) if getattr(config, name) is not None]
        if given:
            from texvent.generation.video_models.known_models import MODELS

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
    for name in ("width", "height"):
        value = getattr(config, name)
        if model.multiple is not None and value is not None and value % model.multiple:
            raise ConfigError(
                f"{name} is {value}; {model.name} takes multiples of {model.multiple}"
            )


OF_CONTROL = ("look", "scene_seed", "assets", "least_agreement")
"""Options that belong to a control."""


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
    if (frames - 1) % pipeline.step:
        near = (frames - 1) // pipeline.step * pipeline.step + 1
        raise ConfigError(
            f"frames is {frames}; {model.name} takes multiples of {pipeline.step} and one more, "
            f"such as {max(near, pipeline.step + 1)}"
        )


def check_class(model: VideoModel, folder: Path) -> None:
    """Refuse a folder with the weights of a model that follows no scene, or in another way.

    Raises:
        InputError: its network is of another class, or takes no control.
        FileFormatError: a file is damaged.
    """
    pipeline, part = model.steering, "transformer"
    if pipeline is None:
        return
    found = (read_pipeline_index(folder).get(part) or [None, None])[1]
    channels = read_json(folder / part / CONFIG) if pipeline.is_channels else {}
    lacks_control = channels and channels.get("in_channels") == channels.get("out_channels")
    if found != pipeline.transformer or lacks_control:
        without = " without a control" if lacks_control else ""
        raise InputError(
            f"{folder} holds a {found}{without}, and {model.name} needs a {pipeline.transformer} "
            "that follows a scene; put the weights of that model there"
        )


NAMES = {"depth": "depth", "edges": "edge", "ids": "seg"}
"""Control → its name in revisions of Cosmos-Transfer2.5."""


def find_control_part(
    model: VideoModel, config: DiffusersConfig, folder: Path, announce: Callable[[str], None]
) -> tuple[tuple[str, Path], ...]:
    """Network of the control, fetched first if it is not here; none where it is among the parts.

    Raises:
        InputError, TexventError: as `model_files.find_files`.
    """
    if not model.control_revision or (folder / CONTROL_PART).is_dir():
        return ()
    revision = model.control_revision.format(NAMES[str(config.control)])
    if not model.repo:
        raise InputError(
            f"the model lacks the folder {folder / CONTROL_PART}, the network of control "
            f"{config.control}; put it there"
        )
    return ((CONTROL_PART, find_network(model.repo, revision, announce)),)
