"""LFS and EQS: similarity of two streams in the features of a network."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from texvent.errors import ConfigError, InputError
from texvent.events import EventStream
from texvent.metrics.protocol import UNDEFINED, Metric, flat_index, occupied_windows, rate_of_window
from texvent.represent.array_ops import columns_of
from texvent.represent.histogram import BINS, CUTOFF, stacked_histogram, time_bins

Features: TypeAlias = NDArray[np.float32]
"""[C, H, W]."""
Backbone: TypeAlias = Callable[[Features], Sequence[Features]]
"""Stacked histogram [20, H, W] → feature maps [C, H', W'], one per stage."""

PATCH = 3
WHERE_FROM = (
    "the published files are rvt-t.ckpt, rvt-s.ckpt and rvt-b.ckpt, to which the project "
    "uzh-rpg/RVT on GitHub links; texvent train detection writes weights.pt for eqs (own RVT)"
)


def keep_input(histogram: Features) -> Sequence[Features]:
    """The identity backbone: the histogram is its own and only feature map."""
    return (histogram,)


@dataclass(frozen=True, kw_only=True)
class LatentSimilarity(Metric):
    """Mean cosine of the patch features of both streams, over patches, stages and 50 ms windows.

    A feature map is averaged over 3×3 patches (zero-padded to whole patches). A patch without
    features in both streams is left out; without features in one of them it counts 0.

    This is the arithmetic of the paper's EQS. It is called EQS only with RVT's weights in the
    backbone; the default, the histogram itself, misses a little noise (docs/metrics.md).
    """

    name = "lfs"
    better = "higher"
    range = (-1.0, 1.0)
    blind_to = "a little added noise; with a real backbone also small jitter"

    backbone: Backbone = keep_input
    """Feature maps of a stacked histogram."""
    window_us: int = 50_000
    """Length of a window, µs; windows start at multiples of it."""

    def _score(self, predicted: EventStream, reference: EventStream) -> float:
        scores = [
            self._score_window(window.predicted, window.reference)
            for window in occupied_windows(predicted, reference, rate_of_window(self.window_us))
        ]
        defined = [score for score in scores if not np.isnan(score)]
        return float(np.mean(defined)) if defined else UNDEFINED

    def _score_window(self, predicted: EventStream, reference: EventStream) -> float:
        if self.backbone is keep_input:
            return _cosine_of_means(_histogram_patches(predicted), _histogram_patches(reference))
        stages = zip(
            *(
                self.backbone(stacked_histogram(events).astype(np.float32))
                for events in (predicted, reference)
            ),
            strict=True,
        )
        cosines = [patch_cosine(a, b) for a, b in stages]
        return float(np.mean(cosines))


def patch_cosine(a: Features, b: Features) -> float:
    """Mean cosine between the averaged 3×3 patches of two feature maps.

    Args:
        a: [C, H, W].
        b: [C, H, W].

    Returns:
        −1..1, or NaN if every patch of both is zero.
    """
    return _cosine_of_means(_average_patches(a), _average_patches(b))


def _cosine_of_means(a: NDArray[np.float64], b: NDArray[np.float64]) -> float:
    """Mean cosine of averaged patches, [C, rows, columns]."""
    lengths = [np.linalg.norm(one, axis=0) for one in (a, b)]
    present = (lengths[0] > 0) | (lengths[1] > 0)
    if not present.any():
        return UNDEFINED
    product = (a * b).sum(axis=0)
    scale = lengths[0] * lengths[1]
    cosine = np.divide(product, scale, out=np.zeros_like(product), where=scale > 0)
    return float(cosine[present].mean())


def _average_patches(features: Features) -> NDArray[np.float64]:
    channels, height, width = features.shape
    rows, columns = -(-height // PATCH), -(-width // PATCH)
    total = np.zeros((channels, rows, columns))
    # One position in the patch after the other: a sum over axes of 3 is slower.
    for down in range(PATCH):
        for across in range(PATCH):
            part = features[:, down::PATCH, across::PATCH]
            total[:, : part.shape[1], : part.shape[2]] += part
    return total / PATCH**2


def _histogram_patches(events: EventStream) -> NDArray[np.float64]:
    """`_average_patches` of the stacked histogram, from its cells that hold events alone."""
    height, width = events.size.shape
    shape = (2 * BINS, -(-height // PATCH), -(-width // PATCH))
    bins = time_bins(columns_of(events), BINS)
    axes = ((events.p, 2), (bins, BINS), (events.y, height), (events.x, width))
    cells, counts = np.unique(flat_index(*axes), return_counts=True)
    channel, row, column = np.unravel_index(cells, (2 * BINS, height, width))
    patch = flat_index((channel, shape[0]), (row // PATCH, shape[1]), (column // PATCH, shape[2]))
    total = np.bincount(patch, np.minimum(counts, CUTOFF), minlength=math.prod(shape))
    return total.reshape(shape) / PATCH**2


@dataclass(frozen=True, kw_only=True)
class EventQualityScore(Metric):
    """Mean cosine of 3×3 patches of RVT's features, over stages 1-3 and windows of 50 ms.

    Never read it without the scores of its controls (`metrics.controls`): it barely sees
    time, and rewards noise.

    Source: K. Chanda et al., "Event quality score (EQS): assessing the realism of simulated event
        camera streams via distances in latent space" (CVPR workshops 2025).
    Deviation: the paper publishes neither code nor which RVT it used, does not state the layout of
        patches, and pads images without saying what becomes of the padding. Here patches do not
        overlap, and the padding's features are left out.
    """

    name = "eqs"
    better = "higher"
    range = (-1.0, 1.0)
    blind_to = "small time errors; added noise can improve it: see its controls"

    backbone: Backbone | None = None
    """RVT's backbone with published weights; see `load_eqs`."""

    def missing(self) -> str | None:
        """As `Metric.missing`."""
        if self.backbone is not None:
            return None
        return f"it needs RVT's weights, pass --rvt-weights FILE; {WHERE_FROM}"

    def _score(self, predicted: EventStream, reference: EventStream) -> float:
        if self.backbone is None:
            raise ConfigError(f"metric eqs cannot be computed: {self.missing()}")
        return LatentSimilarity(backbone=self.backbone)(predicted, reference)


@dataclass(frozen=True, kw_only=True)
class OwnEventQualityScore(EventQualityScore):
    """The same with a network trained here, on simulated events: its values are not the paper's."""

    name = "eqs (own RVT)"


def load_eqs(path: Path) -> EventQualityScore:
    """EQS with the weights of a published checkpoint, or of a detector trained here.

    Raises:
        InputError: there is no such file.
        FileFormatError: it does not hold RVT's backbone.
        MissingDependencyError: torch is not installed.
    """
    if not path.is_file():
        raise InputError(f"there is no weights file {path}; {WHERE_FROM}")
    from texvent.metrics.rvt_backbone import read_rvt  # needs torch

    backbone = read_rvt(path, WHERE_FROM)
    return (OwnEventQualityScore if backbone.is_own else EventQualityScore)(backbone=backbone)
