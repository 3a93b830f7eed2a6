"""Latents of a generated video.

A video diffusion model denoises latents: small arrays that its decoder (VAE) turns into frames.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

import numpy as np
from numpy.typing import NDArray

WAN = "AutoencoderKLWan"


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
