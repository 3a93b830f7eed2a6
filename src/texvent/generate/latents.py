"""Latents of a generated video, and decoding them a few frames at a time.

A video diffusion model denoises latents: small arrays that its decoder (VAE) turns into frames.
Decoding is where memory peaks, because the pipeline decodes the whole clip at once. The decoders
of Wan and CogVideoX are causal in time and keep what they need of earlier frames, so going
through the latents one after another gives exactly the frames of decoding them together.
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
WAN_DECODER = "AutoencoderKLWan"
COG_DECODER = "AutoencoderKLCogVideoX"
STREAMED_DECODERS = (WAN_DECODER, COG_DECODER)
"""Decoders that this file can run step by step."""


@dataclass(frozen=True, eq=False)
class Latents:
    """What a model denoised, before decoding; groundwork for events without frames (section 12).

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
        """What the decoder takes, [C, T, h, w]."""
        per_channel = (slice(None), None, None, None)
        return self.values * self.scale[per_channel] + self.shift[per_channel]


def can_stream(pipe: Any) -> bool:
    """True if the decoder of a pipeline can be run step by step."""
    decoder = getattr(pipe, "vae", None)
    return type(decoder).__name__ in STREAMED_DECODERS and not getattr(decoder, "use_tiling", False)


def read_latents(pipe: Any, output: Any, frames: int | None, fps: Fraction) -> Latents:
    """Latents from what a pipeline returns with `output_type="latent"`.

    Args:
        pipe: the pipeline, with one of `STREAMED_DECODERS`.
        output: its tensor: [1, C, T, h, w], or [1, T, C, h, w] for CogVideoX.
        frames: number of frames asked for; CogVideoX 1.5 pads at the start, which is removed.
        fps: rate of the decoded frames.

    Raises:
        InputError: the pipeline has another decoder.
    """
    name, config = type(pipe.vae).__name__, pipe.vae.config
    if name not in STREAMED_DECODERS:
        raise InputError(
            f"latents of {type(pipe).__name__} cannot be given: its decoder is {name}; known: "
            f"{', '.join(STREAMED_DECODERS)}"
        )
    values = output[0].float().cpu().numpy()
    if name == COG_DECODER:
        frames_per_latent = int(pipe.vae_scale_factor_temporal)
        if frames is not None:
            values = values[-((frames - 1) // frames_per_latent + 1) :]
        values = np.ascontiguousarray(values.transpose(1, 0, 2, 3))
        scale = np.full(len(values), 1 / pipe.vae_scaling_factor_image, np.float32)
        shift = np.zeros(len(values), np.float32)
    else:
        frames_per_latent = int(pipe.vae_scale_factor_temporal)
        scale = np.asarray(config.latents_std, np.float32)
        shift = np.asarray(config.latents_mean, np.float32)
    return Latents(values, scale, shift, fps, frames_per_latent, int(pipe.vae_scale_factor_spatial))


def decode_frames(pipe: Any, latents: Latents) -> Iterator[NDArray[np.float32]]:
    """Frames of latents, a few at a time in memory.

    Args:
        pipe: the pipeline they came from.
        latents: what it denoised.

    Yields:
        Frames in time order, [H, W, 3] float32 RGB, 0..1.
    """
    torch = require("torch", extra=EXTRA)
    decoder = pipe.vae
    _wake(decoder)
    # Not the device of its parameters: offloaded layer by layer, those have none.
    inputs = torch.from_numpy(latents.decoder_input)[None]
    inputs = inputs.to(pipe._execution_device, decoder.dtype)
    steps = _decode_wan if type(decoder).__name__ == WAN_DECODER else _decode_cog
    chunks = steps(decoder, inputs)
    while True:
        # Gradients are switched off around every step, not around the generator, which would
        # leave them off in the code that consumes it.
        with torch.no_grad():
            chunk = next(chunks, None)
        if chunk is None:
            return
        pixels = (chunk * 0.5 + 0.5).clamp(0, 1)[0].permute(1, 2, 3, 0).cpu().float().numpy()
        yield from pixels


def _decode_wan(decoder: Any, inputs: Any) -> Iterator[Any]:
    """Chunks [1, 3, n, H, W] in -1..1: the loop of `AutoencoderKLWan._decode`, step by step."""
    unpatchify = require("diffusers.models.autoencoders.autoencoder_kl_wan", extra=EXTRA).unpatchify
    decoder.clear_cache()
    try:
        prepared = decoder.post_quant_conv(inputs)
        memory = decoder._feat_map
        for index in range(prepared.shape[2]):
            first = {"first_chunk": True} if index == 0 else {}
            chunk = decoder.decoder(
                prepared[:, :, index : index + 1], feat_cache=memory, feat_idx=[0], **first
            )
            if decoder.config.patch_size is not None:
                chunk = unpatchify(chunk, patch_size=decoder.config.patch_size)
            yield chunk.clamp(-1.0, 1.0)
    finally:
        decoder.clear_cache()


def _decode_cog(decoder: Any, inputs: Any) -> Iterator[Any]:
    """Chunks [1, 3, n, H, W] in -1..1, in the same batches as `AutoencoderKLCogVideoX`."""
    batch, total = decoder.num_latent_frames_batch_size, inputs.shape[2]
    rest = total % batch
    memory = None
    start = 0
    for index in range(max(total // batch, 1)):
        stop = batch * (index + 1) + rest
        chunk = inputs[:, :, start:stop]
        if decoder.post_quant_conv is not None:
            chunk = decoder.post_quant_conv(chunk)
        chunk, memory = decoder.decoder(chunk, conv_cache=memory)
        start = stop
        yield chunk


def _wake(decoder: Any) -> None:
    """Bring a decoder that is offloaded as a whole to its device, as calling it would."""
    hook = getattr(decoder, "_hf_hook", None)
    if hook is not None and hasattr(hook, "pre_forward"):
        hook.pre_forward(decoder)
