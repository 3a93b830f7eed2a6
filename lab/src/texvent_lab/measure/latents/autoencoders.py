"""A video autoencoder of LTX-Video's published class, and a tiny decoder of its latents, trained.

No published weights of a video autoencoder can be had from a package registry. This one has
LTX-Video's class, causal in time, with fewer levels and channels: a latent frame for two frames, 32
channels for 8x8 px. LTX-Video compresses 16 times more. This one learns in minutes on a CPU.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from texvent.dataset.simulated_clips import SimulatedClips
from texvent.extending import require
from texvent.runtime.progress import Progress

torch: Any = require("torch", extra="generate")
WIDTH, TINY_WIDTH = 32, 8
CHANNELS = 32
LAYOUT = {
    "latent_channels": CHANNELS,
    "patch_size": 4,
    "layers_per_block": (1, 1, 1),
    "decoder_layers_per_block": (1, 1, 1),
    "spatio_temporal_scaling": (True, False),
    "decoder_spatio_temporal_scaling": (True, False),
    "decoder_inject_noise": (False, False, False),
    "decoder_causal": True,
}
SCALE = ("latents_mean", "latents_std")
WINDOW, BATCH = 9, 2
"""Frames of a training window, five latent frames; windows of a step. Windows are whole frames:
most of a crop of 32 px is within the reach of its own border."""
PEAK_RATE = 3e-3
REPORT = 100
"""Steps between two lines about the loss."""


def make_autoencoder(decoder_width: int = WIDTH, seed: int = 0) -> Any:
    """An untrained autoencoder of diffusers' class for LTX-Video."""
    diffusers = require("diffusers", extra="generate")
    torch.manual_seed(seed)
    return diffusers.AutoencoderKLLTXVideo(
        block_out_channels=(WIDTH, 2 * WIDTH),
        decoder_block_out_channels=(decoder_width, 2 * decoder_width),
        **LAYOUT,
    )


def read_frames(specification: Path, split: str) -> Any:
    """The source frames of a split's clips, tensor [clips, 3, frames, H, W] in -1..1."""
    clips = SimulatedClips(specification, split=split)
    return torch.stack([as_input(clips.simulation(number).video) for number in range(len(clips))])


def as_input(video: Any) -> Any:
    """Frames as an autoencoder takes them, [3, frames, H, W] in -1..1."""
    pixels: NDArray[np.float32] = np.stack([frame.pixels for frame in video])
    return torch.from_numpy(pixels).permute(3, 0, 1, 2) / 127.5 - 1


def train_autoencoder(frames: Any, steps: int, progress: Progress, seed: int = 0) -> Any:
    """An autoencoder fitted to windows of the frames by the mean absolute error.

    The latents are the means: nothing is drawn, and no KL divergence is added.

    Args:
        frames: [clips, 3, frames, H, W] in -1..1.
        steps: of Adam; the rate rises over a twentieth of them and falls to 0.
        progress: told of the steps.
        seed: of weights and draws.
    """
    vae = make_autoencoder(seed=seed)

    def loss(windows: Any) -> Any:
        return (vae.decode(vae.encode(windows).latent_dist.mode()).sample - windows).abs().mean()

    _fit(vae.parameters(), loss, frames, steps, Stage("autoencoder", progress, seed))
    _set_scale(vae, frames)
    return vae.eval()


def train_tiny_decoder(vae: Any, frames: Any, steps: int, progress: Progress, seed: int = 0) -> Any:
    """A narrow decoder of an autoencoder's latents, fitted to what the full decoder gives.

    Returns:
        An autoencoder with the same encoder and `TINY_WIDTH` channels in its decoder.
    """
    tiny = make_autoencoder(TINY_WIDTH, seed)
    tiny.encoder.load_state_dict(vae.encoder.state_dict())
    for name in SCALE:
        getattr(tiny, name).copy_(getattr(vae, name))

    def loss(windows: Any) -> Any:
        with torch.no_grad():
            latents = vae.encode(windows).latent_dist.mode()
            wanted = vae.decode(latents).sample
        return (tiny.decode(latents).sample - wanted).abs().mean()

    _fit(tiny.decoder.parameters(), loss, frames, steps, Stage("tiny decoder", progress, seed))
    return tiny.eval()


class Stage(NamedTuple):
    """What a fit is called, who is told of it, and the seed of its draws."""

    name: str
    progress: Progress
    seed: int


def _fit(
    parameters: Iterable[Any], loss: Callable[[Any], Any], frames: Any, steps: int, stage: Stage
) -> None:
    """Adam on random windows of the frames, turned and mirrored."""
    trained = list(parameters)
    optimizer = torch.optim.Adam(trained, lr=PEAK_RATE, betas=(0.9, 0.95))
    schedule = torch.optim.lr_scheduler.OneCycleLR(optimizer, PEAK_RATE, steps, pct_start=0.05)
    chance = np.random.default_rng(stage.seed)
    mean = 0.0
    for step in range(steps):
        error = loss(torch.stack([_draw_window(frames, chance) for _ in range(BATCH)]))
        optimizer.zero_grad()
        error.backward()
        torch.nn.utils.clip_grad_norm_(trained, 1.0)
        optimizer.step()
        schedule.step()
        mean += float(error.detach())
        stage.progress.advance(stage.name, step + 1, steps)
        if (step + 1) % REPORT == 0:
            stage.progress.announce(f"{stage.name}: step {step + 1}, loss {mean / REPORT:.4f}")
            mean = 0.0


def _draw_window(frames: Any, chance: np.random.Generator) -> Any:
    """A window of a random clip, [3, `WINDOW`, H, W], maybe reversed and mirrored."""
    clip = frames[int(chance.integers(len(frames)))]
    start = int(chance.integers(clip.shape[1] - WINDOW + 1))
    window = clip.narrow(1, start, WINDOW).float()
    return window.flip([axis for axis in (1, 3) if chance.random() < 0.5])


def _set_scale(vae: Any, frames: Any) -> None:
    """Note mean and standard deviation of each channel of the latents, as LTX-Video's files do."""
    with torch.no_grad():
        latents = torch.cat([vae.encode(one[None].float()).latent_dist.mode() for one in frames])
        over = (0, 2, 3, 4)
        for name, statistic in zip(SCALE, (latents.mean(over), latents.std(over)), strict=True):
            getattr(vae, name).copy_(statistic)
