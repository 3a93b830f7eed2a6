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
from texvent.networks.weight_files import SAFETENSORS, Tensor, read_mapping
from texvent_lab.latents.change import BALANCE, BrightnessChange
from texvent_lab.networks.layers import Network

EXTRA = "generate"
_nn: Any = require("torch.nn", extra=EXTRA)
_Convolution: Any = _nn.Conv3d
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


class _CausalConvolution(_Convolution):
    """3D convolution that sees, of other latent frames, only those before."""

    def __init__(self, narrow: int, wide: int, frames: int) -> None:
        side = KERNEL // 2
        super().__init__(narrow, wide, (frames, KERNEL, KERNEL), padding=(0, side, side))

    def forward(self, x: Tensor) -> Tensor:
        past = self.kernel_size[0] - 1
        if past:
            x = _nn.functional.pad(x, (0, 0, 0, 0, past, 0), mode="replicate")
        return super().forward(x)


class LatentHead(Network):
    """A head and its weights."""

    def __init__(self, config: HeadConfig) -> None:
        """Random weights; the last layer is zero: nothing moves at first, and most voxels are 0."""
        super().__init__()
        self.config, width = config, config.width
        self.first = _CausalConvolution(config.channels, width, KERNEL)
        self.blocks = _nn.ModuleList(
            _nn.ModuleList(_CausalConvolution(width, width, frames) for frames in (KERNEL, 1))
            for _ in range(config.blocks)
        )
        self.last = _CausalConvolution(width, config.bins * config.pixels_per_latent**2, 1)
        for one in self.last.parameters():
            _nn.init.zeros_(one)

    def forward(self, latents: Tensor) -> Tensor:
        """Changes [n, T − 1, B, H, W] of latents [n, C, T, h, w]."""
        silu = _nn.functional.silu
        x = self.first(latents)
        for one, two in self.blocks:
            x = x + two(silu(one(silu(x))))
        # The first latent frame is context only.
        x = self.last(silu(x[:, :, 1:]))
        return _nn.functional.pixel_shuffle(x.transpose(1, 2), self.config.pixels_per_latent)

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
            voxels = self(torch.from_numpy(values)[None].to(self.first.weight.device))
        return BrightnessChange(
            voxels[0].cpu().numpy(), latents.fps, config.frames_per_latent, config.balance
        )


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
    head = LatentHead(config)
    head.read(content, path, WHERE_FROM)
    return head


def _sizes(content: Mapping[str, Any], path: Path) -> Mapping[str, Any]:
    """The config in a file: in the metadata of safetensors, beside the state in a checkpoint."""
    if path.suffix.lower() != SAFETENSORS:
        return dict(content[CONFIG])
    with require("safetensors", extra=EXTRA).safe_open(path, "pt") as file:
        return dict(json.loads(file.metadata()[CONFIG]))
