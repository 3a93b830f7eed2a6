"""Upscalers of LTX-2.5's latents: files of a row, the network that each holds, loading.

A file has neither a folder nor a configuration: its tensors say how large its network is.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from texvent._require import require
from texvent.errors import FileFormatError, InputError
from texvent.generation.video_models.model_files import (
    CONFIG,
    find_file,
    loading,
    read_json,
    shapes_in,
)

if TYPE_CHECKING:
    from texvent.generation.video_models.config import VideoModel

EXTRA = "generate"
PARTS = ("latent_upsampler", "temporal_latent_upsampler")
"""Names of the networks in diffusers: double in space, and in time."""
ROLE = "an upscaler of latents"


def find_upscalers(
    model: VideoModel, announce: Callable[[str], None] | None = None
) -> tuple[tuple[str, Path], ...] | None:
    """Name and file of each upscaler of a row; None: one is not here, and may not be fetched.

    Raises:
        InputError, TexventError: as `model_files.find_file`.
    """
    found = []
    for part, name in zip(PARTS, model.upscalers, strict=False):
        path = find_file(model, name, "upscaler", announce)
        if path is None:
            return None
        found.append((part, path))
    return tuple(found)


def check_upscalers(upscalers: Sequence[tuple[str, Path]], folder: Path) -> None:
    """Refuse upscalers of another kind or of other latents, and a model that makes no keyframes.

    Raises:
        InputError: the model was not trained for them.
        FileFormatError: a file is damaged, or is no such upscaler.
    """
    if not upscalers:
        return
    if not read_json(folder / "transformer" / CONFIG).get("use_keyframes_abs_pos_embedding"):
        raise InputError(
            f"{folder} holds a network that makes no keyframes, from which frames in between are "
            "made; put the weights of LTX-2.5 there"
        )
    channels = read_json(folder / "vae" / CONFIG).get("latent_channels")
    for part, file in upscalers:
        layout, wanted = _read_layout(file), "time" if part == PARTS[1] else "space"
        if layout["temporal_upsample"] != (part == PARTS[1]):
            raise FileFormatError(f"{file} is no upscaler in {wanted}; put that file there")
        if layout["in_channels"] != channels:
            raise FileFormatError(
                f"{file} takes latents of {layout['in_channels']} channels, and {folder} makes "
                f"{channels}; put the upscaler of that model there"
            )


def _read_layout(file: Path) -> dict[str, Any]:
    """Options of the network whose tensors a file holds.

    Raises:
        FileFormatError: it is damaged, or of another network.
    """
    shapes = shapes_in(file)
    first = shapes.get("initial_conv.weight")
    is_rational = "upsampler.conv.weight" in shapes
    grown = shapes.get("upsampler.conv.weight" if is_rational else "upsampler.0.weight")
    is_temporal = grown is not None and len(grown) == 5
    if first is None or grown is None or grown[0] != first[0] * (2 if is_temporal else 4):
        raise FileFormatError(f"{file} holds no upscaler that doubles latents; fetch it again")
    blocks = {name.split(".")[1] for name in shapes if name.startswith("res_blocks.")}
    return {
        "in_channels": first[1],
        "mid_channels": first[0],
        "num_blocks_per_stage": len(blocks),
        "dims": len(first) - 2,
        "spatial_upsample": not is_temporal,
        "temporal_upsample": is_temporal,
        "use_rational_resampler": is_rational,
    }


def load_upscaler(file: Path, dtype: Any) -> Any:
    """The network of an upscaler's file.

    Raises:
        FileFormatError: the file is damaged, or its tensors do not fit.
    """
    kind = require("diffusers.pipelines.ltx2", extra=EXTRA).LTX2LatentUpsamplerModel
    load_file = require("safetensors.torch", extra=EXTRA).load_file
    with loading(file, ROLE):
        network = kind(**_read_layout(file))
        network.load_state_dict(load_file(file), strict=True, assign=True)
        return network.to(dtype)
