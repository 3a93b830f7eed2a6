"""Tiny random autoencoders of diffusers' classes, stored as diffusers stores them."""

from __future__ import annotations

from pathlib import Path

import pytest

FRAMES_PER_LATENT, PIXELS_PER_LATENT, CHANNELS = 2, 4, 4


def write_autoencoder(folder: Path) -> Path:
    diffusers, torch = pytest.importorskip("diffusers"), pytest.importorskip("torch")
    torch.manual_seed(0)
    vae = diffusers.AutoencoderKLWan(
        base_dim=4,
        z_dim=CHANNELS,
        dim_mult=[1, 1],
        num_res_blocks=1,
        temperal_downsample=[True],
        patch_size=2,
        in_channels=12,
        out_channels=12,
        latents_mean=[0.1, 0.0, -0.1, 0.2],
        latents_std=[0.5, 1.0, 2.0, 1.0],
    )
    vae.save_pretrained(folder)
    return folder


def write_ltx_autoencoder(folder: Path) -> Path:
    diffusers, torch = pytest.importorskip("diffusers"), pytest.importorskip("torch")
    torch.manual_seed(0)
    vae = diffusers.AutoencoderKLLTXVideo(
        latent_channels=CHANNELS,
        patch_size=2,
        block_out_channels=(4, 8),
        decoder_block_out_channels=(4, 8),
        layers_per_block=(1, 1, 1),
        decoder_layers_per_block=(1, 1, 1),
        spatio_temporal_scaling=(True, False),
        decoder_spatio_temporal_scaling=(True, False),
        decoder_inject_noise=(False, False, False),
        scaling_factor=0.5,
    )
    vae.latents_mean.copy_(torch.tensor([0.1, 0.0, -0.1, 0.2]))
    vae.latents_std.copy_(torch.tensor([0.5, 1.0, 2.0, 1.0]))
    vae.save_pretrained(folder)
    return folder
