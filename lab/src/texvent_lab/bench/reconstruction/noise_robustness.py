"""Robustness of reconstructed images to noise in the events: the paper's Table 7."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from texvent.represent.slices import slice_between
from texvent_lab.bench.real.recording import FrameRecording
from texvent_lab.bench.reconstruction.run import ReconstructionScorer
from texvent_lab.bench.reconstruction.scores import ImageScores, true_image
from texvent_lab.bench.selftest.run import scatter

PAPER_SHARES = (0.01, 0.05, 0.1, 0.2, 0.3)
"""ρ of the paper's Table 7."""


@dataclass(frozen=True, kw_only=True)
class NoiseScore:
    """Images from the recorded events of one recording, a share of them at random places."""

    recording: str
    share: float
    """Share of the events that is moved, 0..1."""
    against_clean: ImageScores
    """Compared with the images from the unperturbed events."""
    against_frames: ImageScores
    """Compared with the true frames."""


def noise_curve(
    recording: FrameRecording,
    scorer: ReconstructionScorer,
    shares: Sequence[float] = PAPER_SHARES,
) -> list[NoiseScore]:
    """Score the recorded events at every level of noise.

    The paper does not say what Table 7 compares with. Its SSIM of 0.90 at 1 % is far above what
    E2VID reaches against true frames, so it must be images of the unperturbed events. Both are
    given.

    Args:
        recording: frames and events.
        scorer: network, measures and what counts.
        shares: of the events; all are reconstructed side by side, in one pass.

    Raises:
        InputError: no image counts.
    """
    clean = scorer.reconstructor.twin()
    networks = [scorer.reconstructor.twin() for _ in shares]
    to_clean, to_frames = ([scorer.new_collector(recording) for _ in shares] for _ in range(2))
    frames = iter(recording.frames)
    start_us = next(frames).t_us
    times_us = scorer.plan.frame_times_us(recording)
    slices = slice_between(recording.events, times_us, size=recording.frames.size)
    for (stop_us, events), frame in zip(slices, frames, strict=False):
        image, true = clean.reconstruct(events), true_image(frame)
        for number, share in enumerate(shares):
            # The same draws at each share: noise of a larger one includes that of a smaller one.
            chance = np.random.default_rng([scorer.plan.seed, start_us % 2**63])
            noisy = networks[number].reconstruct(scatter(events, chance, share=share))
            to_clean[number].add(stop_us, noisy, image)
            to_frames[number].add(stop_us, noisy, true)
        start_us = stop_us
    return [
        NoiseScore(
            recording=recording.name,
            share=share,
            against_clean=to_clean[number].scores(),
            against_frames=to_frames[number].scores(),
        )
        for number, share in enumerate(shares)
    ]
