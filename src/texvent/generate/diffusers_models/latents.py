"""Latents of a generated video, and decoding them.

A video diffusion model denoises latents: small arrays that its decoder (VAE) turns into frames.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent._require import require
from texvent.errors import InputError

EXTRA = "generate"
WAN = "AutoencoderKLWan"
COGVIDEOX = "AutoencoderKLCogVideoX"
KNOWN_DECODERS = (WAN, COGVIDEOX)
"""Decoders whose scale and shift `read_latents` finds."""


@dataclass(frozen=True, eq=False)
class Latents:
    """Denoised latents before decoding; groundwork for events without frames (section 12).

    The decoder takes `values · scale + shift`.
    """

    values: NDArray[np.float32]
    """[C, T, h, w]: channels, latent frames, height, width."""
    scale: NDArray[np.float32]
    """[C], of the decoder's config."""
    shift: NDArray[np.float32]
    """[C], of the decoder's config."""
    fps: Fraction
    """Rate of the decoded frames."""
    frames_per_latent: int
    """Decoded frames per latent frame; the first latent frame gives one."""
    pixels_per_latent: int
    """Decoded pixels per latent pixel, along each side."""

    @property
    def decoder_input(self) -> NDArray[np.float32]:
        """Input of the decoder, [C, T, h, w]."""
        per_channel = (slice(None), None, None, None)
        return self.values * self.scale[per_channel] + self.shift[per_channel]


def read_latents(pipe: Any, output: Any, frames: int | None, fps: Fraction) -> Latents:
    """Latents from the output of a pipeline called with `output_type="latent"`.

    Args:
        pipe: the pipeline, with one of `KNOWN_DECODERS`.
        output: its tensor: [1, C, T, h, w], or [1, T, C, h, w] for CogVideoX.
        frames: number of frames asked for, None for the model's own; CogVideoX 1.5 pads at the
            start, which is removed.
        fps: rate of the decoded frames.

    Raises:
        InputError: the pipeline has another decoder.
    """
    name, config = type(pipe.vae).__name__, pipe.vae.config
    if name not in KNOWN_DECODERS:
        raise InputError(
            f"latents of {type(pipe).__name__} cannot be given: its decoder is {name}; known: "
            f"{', '.join(KNOWN_DECODERS)}"
        )
    values = output[0].float().cpu().numpy()
    frames_per_latent = int(pipe.vae_scale_factor_temporal)
    if name == COGVIDEOX:
        asked = frames or int(pipe.transformer.config.sample_frames)
        values = values[-((asked - 1) // frames_per_latent + 1) :]
        values = np.ascontiguousarray(values.transpose(1, 0, 2, 3))
        scale = np.full(len(values), 1 / pipe.vae_scaling_factor_image, np.float32)
        shift = np.zeros(len(values), np.float32)
    else:
        scale = np.asarray(config.latents_std, np.float32)
        shift = np.asarray(config.latents_mean, np.float32)
    return Latents(values, scale, shift, fps, frames_per_latent, int(pipe.vae_scale_factor_spatial))


def decode_latents(pipe: Any, latents: Latents) -> Iterator[NDArray[np.float32]]:
    """Frames of latents in time order, [H, W, 3] float32 RGB in 0..1.

    Args:
        pipe: the pipeline they came from.
        latents: denoised by it.
    """
    torch = require("torch", extra=EXTRA)
    # Not the device of its parameters: offloaded layer by layer, those have none.
    inputs = torch.from_numpy(latents.decoder_input)[None]
    with torch.no_grad():
        frames = pipe.vae.decode(inputs.to(pipe._execution_device, pipe.vae.dtype)).sample[0]
    pipe.maybe_free_model_hooks()
    pixels = (frames * 0.5 + 0.5).clamp(0, 1).permute(1, 2, 3, 0).cpu().float().numpy()
    return iter(pixels)
