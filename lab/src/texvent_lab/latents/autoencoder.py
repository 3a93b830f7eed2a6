"""Latents of any frames: a video autoencoder of diffusers, from a folder. Experimental."""

from __future__ import annotations

import json
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.errors import InputError, one_line
from texvent.extending import require
from texvent.generate.diffusers_models.latents import WAN, Latents
from texvent.networks.weight_files import describe_file

EXTRA = "generate"
LTX = "AutoencoderKLLTXVideo"
CONFIG_FILE, WEIGHTS_FILE = "config.json", "diffusion_pytorch_model.safetensors"


@dataclass(frozen=True, eq=False)
class Autoencoder:
    """An autoencoder of diffusers' class for Wan or for LTX-Video."""

    module: Any
    """The module, in evaluation."""
    digest: str
    """Of its weights and its config."""

    @property
    def frames_per_latent(self) -> int:
        """r: frames of a latent frame after the first."""
        if self._is_wan:
            return 1 << int(sum(self.module.config.temperal_downsample))
        return int(self.module.temporal_compression_ratio)

    @property
    def pixels_per_latent(self) -> int:
        """Pixels of a latent pixel, along each side."""
        config = self.module.config
        if self._is_wan:
            return int(config.patch_size or 1) << (len(config.dim_mult) - 1)
        return int(self.module.spatial_compression_ratio)

    @classmethod
    def load(cls, folder: Path) -> Autoencoder:
        """Load an autoencoder that lies on this machine.

        Args:
            folder: with config.json and diffusion_pytorch_model.safetensors.

        Raises:
            InputError: they are not there, are damaged, or of another class.
        """
        config = folder / CONFIG_FILE
        weights = folder / WEIGHTS_FILE
        if not config.is_file() or not weights.is_file():
            raise InputError(
                f"{folder} does not have {CONFIG_FILE} and {WEIGHTS_FILE}; give the folder vae of "
                "a downloaded model"
            )
        diffusers = require("diffusers", extra=EXTRA)
        try:
            name = json.loads(config.read_text(encoding="utf-8")).get("_class_name")
            if name not in (WAN, LTX):
                raise InputError(f"{folder} holds the class {name}; known are {WAN} and {LTX}")
            module = getattr(diffusers, name).from_pretrained(folder, local_files_only=True)
        except (OSError, ValueError, AttributeError, RuntimeError) as error:
            raise InputError(f"{folder} cannot be read: {one_line(error)}") from error
        digests = [describe_file(path)["sha256"] for path in (weights, config)]
        return cls(module.eval(), " ".join(digests))

    @property
    def _is_wan(self) -> bool:
        return type(self.module).__name__ == WAN

    def _scale_and_shift(self) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
        """What the decoder takes is latents · scale + shift; [C] each."""
        module = self.module
        if self._is_wan:
            pair = module.config.latents_std, module.config.latents_mean
        else:
            # Tensors, stored with the weights.
            pair = module.latents_std / module.config.scaling_factor, module.latents_mean
        return np.asarray(pair[0], np.float32), np.asarray(pair[1], np.float32)

    def encode(self, frames: NDArray[np.float32], fps: Fraction) -> Latents:
        """Latents of a clip, as the diffusion model would have denoised them.

        Args:
            frames: [n, H, W, 3] RGB, 0..255.
            fps: their rate.

        Raises:
            InputError: the frames do not fill whole latent frames, or but one.
        """
        torch = require("torch", extra=EXTRA)
        step, side = self.frames_per_latent, self.pixels_per_latent
        count, height, width, _ = frames.shape
        if count <= step or (count - 1) % step or height % side or width % side:
            raise InputError(
                f"{count} frames of {width}x{height} do not fit the autoencoder; it takes "
                f"{step + 1}, {2 * step + 1}, {3 * step + 1} ... frames of multiples of {side} px"
            )
        inputs = torch.from_numpy(np.ascontiguousarray(frames)).permute(3, 0, 1, 2)[None]
        with torch.inference_mode():
            mode = self.module.encode(inputs / 127.5 - 1).latent_dist.mode()[0].float().cpu()
        scale, shift = self._scale_and_shift()
        per_channel = (slice(None), None, None, None)
        return Latents(
            (mode.numpy() - shift[per_channel]) / scale[per_channel],
            scale,
            shift,
            fps,
            frames_per_latent=step,
            pixels_per_latent=side,
        )
