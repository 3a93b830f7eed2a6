"""How noise in the events degrades reconstructed images: the paper's Table 7."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Literal, TypeAlias

import numpy as np

from texvent.config import check_range
from texvent.events import EventStream
from texvent.represent.slices import slice_between
from texvent_lab.bench.real.recording import FrameRecording
from texvent_lab.bench.reconstruction.run import ReconstructionPlan, ReconstructionScorer
from texvent_lab.bench.reconstruction.scores import GreyImage, ImageScores, true_image
from texvent_lab.bench.selftest.run import add_background, scatter

NoiseKind: TypeAlias = Literal["scattered", "background"]
"""A share of the events moved to random places, or background activity at a rate per pixel."""


PAPER_SHARES = (0.01, 0.05, 0.1, 0.2, 0.3)
"""ρ of the paper's Table 7."""


BACKGROUND_HZ = (0.1, 0.3, 1.0, 3.0, 10.0)
"""Background activity per pixel; sensors show about 0.1 Hz in light and 10 Hz in the dark."""


@dataclass(frozen=True)
class NoiseLevel:
    """One point of the curve.

    Raises:
        ConfigError: the amount is below 0, or a share above 1.
    """

    kind: NoiseKind
    amount: float
    """Share of the events, 0..1, or events per second and pixel."""

    def __post_init__(self) -> None:
        check_range(self.kind, self.amount, 0.0, 1.0 if self.kind == "scattered" else 1e6)

    def apply(self, events: EventStream, start_us: int, stop_us: int, *, seed: int) -> EventStream:
        """The events of `[start_us, stop_us)` with that much noise; the same each time."""
        rng = np.random.default_rng([seed, start_us % 2**63])
        if self.kind == "scattered":
            return scatter(events, rng, share=self.amount)
        return add_background(events, rng, rate_hz=self.amount, span_us=(start_us, stop_us))


PAPER_LEVELS = tuple(NoiseLevel("scattered", share) for share in PAPER_SHARES)


BACKGROUND_LEVELS = tuple(NoiseLevel("background", rate_hz) for rate_hz in BACKGROUND_HZ)


@dataclass(frozen=True, kw_only=True)
class NoiseScore:
    """Images from the recorded events of one recording, with one level of noise added."""

    recording: str
    level: NoiseLevel
    against_clean: ImageScores
    """Compared with the images from the unperturbed events."""
    against_frames: ImageScores
    """Compared with the true frames."""


class _Point:
    """One level while the curve is being measured."""

    def __init__(
        self, level: NoiseLevel, scorer: ReconstructionScorer, recording: FrameRecording
    ) -> None:
        self.level = level
        self.network = scorer.reconstructor.twin()
        self.clean = scorer.new_collector(recording)
        self.frames = scorer.new_collector(recording)


def noise_curve(
    recording: FrameRecording,
    scorer: ReconstructionScorer,
    levels: Sequence[NoiseLevel] = (*PAPER_LEVELS, *BACKGROUND_LEVELS),
) -> list[NoiseScore]:
    """Score the recorded events at every level of noise.

    The paper does not say what Table 7 compares with. Its SSIM of 0.90 at 1 % is far above what
    E2VID reaches against true frames, so it must be images of the unperturbed events. Both are
    given.

    Args:
        recording: frames and events.
        scorer: network, measures and what counts.
        levels: the points of the curve; all are reconstructed side by side, in one pass.

    Raises:
        InputError: no image counts.
    """
    clean = scorer.reconstructor.twin()
    points = [_Point(level, scorer, recording) for level in levels]
    for start_us, stop_us, events, true in _slices(recording, scorer.plan):
        image = clean.reconstruct(events)
        for point in points:
            noisy_events = point.level.apply(events, start_us, stop_us, seed=scorer.plan.seed)
            noisy = point.network.reconstruct(noisy_events)
            point.clean.add(stop_us, noisy, image)
            point.frames.add(stop_us, noisy, true)
    return [
        NoiseScore(
            recording=recording.name,
            level=point.level,
            against_clean=point.clean.scores(),
            against_frames=point.frames.scores(),
        )
        for point in points
    ]


def _slices(
    recording: FrameRecording, plan: ReconstructionPlan
) -> Iterator[tuple[int, int, EventStream, GreyImage]]:
    """(time of the frame before, of the frame, events between them, the frame) of every frame."""
    frames = iter(recording.frames)
    start_us = next(frames).t_us
    times_us = plan.frame_times_us(recording)
    slices = slice_between(recording.events, times_us, size=recording.frames.size)
    for (stop_us, events), frame in zip(slices, frames, strict=False):
        yield start_us, stop_us, events, true_image(frame)
        start_us = stop_us
