"""A small network that gives changes of brightness from a video's latents. Experimental.

Latents [C, T, h, w] go in as the diffusion model denoises them, with mean 0 and deviation 1 per
channel; `change.py` defines what comes out, for each latent frame after the first. All convolutions
work at the size of the latents, and the last one gives the B · p · p bins of the p × p pixels
of a latent pixel:

    x = conv(latents)                      3×3×3
    x = x + conv(silu(conv(silu(x))))      3×3×3 and 1×3×3, `blocks` times
    changes = shuffle(conv(silu(x)))       1×3×3

Convolutions in time see a latent frame and the two before it, never a later one, so events of a
latent frame can be made as soon as it is there. Before the first frame is its copy.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from texvent.config import check_range
from texvent.errors import ConfigError, FileFormatError, InputError
from texvent.extending import require
from texvent.generate.diffusers_models.latents import Latents
from texvent.io.atomic import atomic_file
from texvent.networks.layer_shapes import Shapes
from texvent.networks.weight_files import (
    SAFETENSORS,
    Tensor,
    check_finite,
    describe_mismatch,
    read_mapping,
    shapes_of,
    state_tensors,
)
from texvent_lab.latents.change import BALANCE, BrightnessChange

EXTRA = "generate"
CONFIG = "head_config"
"""Name of the config in the metadata of a file."""
WHERE_FROM = "texvent train latents writes it as weights.pt"
KERNEL = 3


@dataclass(frozen=True, kw_only=True)
class HeadConfig:
    """Sizes of a head.

    Raises:
        ConfigError: one is out of range.
    """

    channels: int
    """C: of the latents."""
    frames_per_latent: int
    """r: frames of a latent frame."""
    pixels_per_latent: int
    """p: decoded pixels per latent pixel, along each side."""
    bins: int = 8
    """B: bins of a latent frame."""
    width: int = 96
    """Channels inside."""
    blocks: int = 3
    """Residual blocks."""
    balance: float = BALANCE
    """α of the brightness it was trained on, on the 0..255 scale."""

    def __post_init__(self) -> None:
        for name in ("channels", "frames_per_latent", "pixels_per_latent", "bins", "width"):
            check_range(name, getattr(self, name), 1, 4096)
        check_range("blocks", self.blocks, 0, 64)
        check_range("balance", self.balance, 1e-6, 1e6)

    @property
    def shapes(self) -> Shapes:
        """Every tensor, by name."""
        width = self.width
        out = self.bins * self.pixels_per_latent**2
        layers = {"first": (width, self.channels, KERNEL), "last": (out, width, 1)}
        for number in range(self.blocks):
            layers[f"blocks.{number}.0"] = (width, width, KERNEL)
            layers[f"blocks.{number}.1"] = (width, width, 1)
        shapes: Shapes = {}
        for name, sizes in layers.items():
            shapes[f"{name}.weight"] = (*sizes, KERNEL, KERNEL)
            shapes[f"{name}.bias"] = sizes[:1]
        return shapes


@dataclass(frozen=True, eq=False)
class LatentHead:
    """A head and its weights."""

    config: HeadConfig
    tensors: Mapping[str, Tensor]

    def predict(self, latents: Latents) -> BrightnessChange:
        """Changes of brightness in the video that latents stand for.

        Args:
            latents: of the autoencoder that the head was trained for.

        Raises:
            InputError: the latents are of another kind, or there is but one latent frame.
        """
        torch = require("torch", extra=EXTRA)
        config, values = self.config, latents.values
        expected = (config.channels, config.frames_per_latent, config.pixels_per_latent)
        found = (len(values), latents.frames_per_latent, latents.pixels_per_latent)
        if found != expected:
            raise InputError(
                "this head is for latents with {} channels, {} frames and {} px; these have {}, {} "
                "and {}; give latents of the autoencoder that it was trained for".format(
                    *expected, *found
                )
            )
        if values.shape[1] < 2:
            raise InputError(
                "one latent frame shows no change; generate a longer video: two or more are needed"
            )
        with torch.inference_mode():
            device = next(iter(self.tensors.values())).device
            voxels = apply_head(self.tensors, config, torch.from_numpy(values)[None].to(device))
        return BrightnessChange(
            voxels[0].cpu().numpy(), latents.fps, config.frames_per_latent, config.balance
        )


def apply_head(tensors: Mapping[str, Tensor], config: HeadConfig, latents: Tensor) -> Tensor:
    """Changes [n, T − 1, B, H, W] of latents [n, C, T, h, w]; gradients flow."""
    torch = require("torch", extra=EXTRA)
    functional = torch.nn.functional

    def convolve(x: Tensor, name: str) -> Tensor:
        weight = tensors[f"{name}.weight"]
        past = weight.shape[2] - 1
        if past:
            x = functional.pad(x, (0, 0, 0, 0, past, 0), mode="replicate")
        side = KERNEL // 2
        return functional.conv3d(x, weight, tensors[f"{name}.bias"], padding=(0, side, side))

    x = convolve(latents, "first")
    for number in range(config.blocks):
        inner = convolve(functional.silu(x), f"blocks.{number}.0")
        x = x + convolve(functional.silu(inner), f"blocks.{number}.1")
    # The first latent frame is context only.
    x = convolve(functional.silu(x[:, :, 1:]), "last")
    return functional.pixel_shuffle(x.transpose(1, 2), config.pixels_per_latent)


def save_head(head: LatentHead, path: Path, *, overwrite: bool = False) -> None:
    """Write a head as a safetensors file, its sizes in the metadata.

    Raises:
        OutputError: the file exists, or cannot be written.
        ConfigError: the name does not end in .safetensors.
    """
    if path.suffix.lower() != SAFETENSORS:
        raise ConfigError(f"{path} must end in {SAFETENSORS}; it is written in that format")
    module = require("safetensors.torch", extra=EXTRA)
    tensors = {name: one.detach().cpu().contiguous() for name, one in head.tensors.items()}
    with atomic_file(path, overwrite=overwrite) as part:
        module.save_file(tensors, part, metadata={CONFIG: json.dumps(asdict(head.config))})


def load_head(path: Path) -> LatentHead:
    """Read what `save_head` or `texvent train latents` wrote.

    Raises:
        InputError: there is no such file.
        FileFormatError: it is damaged, or holds something else.
    """
    if not path.is_file():
        raise InputError(f"there is no file {path}; {WHERE_FROM}")
    content = read_mapping(path, WHERE_FROM, extra=EXTRA)
    try:
        config = HeadConfig(**_sizes(content, path))
    except (KeyError, ValueError, TypeError, ConfigError) as error:
        raise FileFormatError(f"{path} does not say the sizes of a head; {WHERE_FROM}") from error
    tensors = state_tensors(content, path, WHERE_FROM, extra=EXTRA)
    problem = describe_mismatch(shapes_of(tensors), config.shapes)
    if problem is not None:
        raise FileFormatError(f"{path} does not fit its sizes: it {problem}; {WHERE_FROM}")
    check_finite(tensors, path)
    return LatentHead(config, tensors)


def _sizes(content: Mapping[str, Any], path: Path) -> Mapping[str, Any]:
    """The config in a file: in the metadata of safetensors, beside the state in a checkpoint."""
    if path.suffix.lower() != SAFETENSORS:
        return dict(content[CONFIG])
    with require("safetensors", extra=EXTRA).safe_open(path, "pt") as file:
        return dict(json.loads(file.metadata()[CONFIG]))
