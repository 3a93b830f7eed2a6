"""Control of a video by a scene: pipelines that follow a control video, and what each takes."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from types import MappingProxyType
from typing import TYPE_CHECKING

from texvent.errors import FileFormatError, InputError
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
