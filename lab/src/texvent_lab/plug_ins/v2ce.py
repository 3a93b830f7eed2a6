"""V2CE: a 3-D U-Net turns pairs of frames into voxel grids, and LDATI those into events.

Source: Z. Zhang et al., "V2CE: Video to Continuous Events Simulator", ICRA 2024. Steps, and where
they depart from the program (V2CE-Toolbox), are in docs/simulators/v2ce.md.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, ClassVar, TypeAlias

import numpy as np
from numpy.typing import NDArray

from texvent.errors import FileFormatError
from texvent.events import EventStream
from texvent.extending import require
from texvent.frames import Frame
from texvent.networks import describe_file, read_mapping
from texvent.pairs.frame_pair import FramePair
from texvent.runtime.memory import explain_memory
from texvent.simulation.packets import FrameInterval, UnsortedEvents, check_event_number
from texvent.simulation.random.draws import Purpose, draw_uniforms
from texvent.simulation.streaming import IntensityArray, StreamingSimulator, make_packet
from texvent_lab.networks import EXTRA, locate_weights

Array: TypeAlias = NDArray[np.float64]
FILE = "v2ce_3d.pt"
WHERE_FROM = f"the project ucsd-hdsi-dvs/V2CE-Toolbox on GitHub links to the published {FILE}"
SEQUENCE = 16
"""Pairs of frames that the network sees at once, as in its training."""
WHITE, MEAN, SPREAD = 255.0, 0.153, 0.165
"""Level of full scale; mean and standard deviation of the training frames, of full scale."""
TOLERANCE = 1e-6
"""Part of an event below which a sum counts as whole."""
MOST_PER_PLACE = 2**23
"""Draws that each polarity and sub-interval of a pixel has."""


@dataclass(frozen=True, kw_only=True)
class V2ceConfig:
    """Options of V2CE."""

    weights: Path | None = None
    """File of V2CE's published weights, v2ce_3d.pt. Without it, that in the weights folder."""


class V2ceSimulator(StreamingSimulator[V2ceConfig]):
    """V2CE on video frames; see `texvent.simulation.protocol.Simulator`.

    `advance` gives the network whole sequences, as its program does. `step` cannot wait: it answers
    from the last `SEQUENCE` pairs, so its events differ a little, and each costs a sequence.
    """

    config_type: ClassVar[type] = V2ceConfig
    presets: ClassVar[Mapping[str, V2ceConfig]] = {"default": V2ceConfig()}
    default_interpolate: ClassVar[str] = "none"
    contrast_threshold: ClassVar[float] = 0.2
    balance: ClassVar[float] = 30.0
    """The Texvent model's: the network has none, but intermediate frames may be asked for."""
    bytes_per_pixel: ClassVar[int] = 28_000

    def __init__(self, config: V2ceConfig | None = None, *, seed: int = 0) -> None:
        """Load the network.

        Raises:
            InputError, FileFormatError: weights that are missing, damaged or of another network.
            MissingDependencyError: torch is not installed.
        """
        super().__init__(config, seed=seed)
        self._path = _find_weights(self.config)
        torch = require("torch", extra=EXTRA)
        from texvent_lab.plug_ins.v2ce_network import V2ce  # needs torch

        with torch.device("meta"):
            self._network: Any = V2ce()
        content = read_mapping(self._path, WHERE_FROM, extra=EXTRA)
        self._network.read(content, self._path, WHERE_FROM)
        self._device = "cuda" if torch.cuda.is_available() else "cpu"
        self._network.to(self._device).eval()

    @staticmethod
    def provenance(config: V2ceConfig) -> dict[str, str]:
        """Name and sha256 of the weights file; stored with the events."""
        return describe_file(_find_weights(config))

    def reset(self) -> None:
        """Forget all frames: the next one is the first."""
        super().reset()
        self._waiting: list[tuple[Frame, FrameInterval]] = []

    def advance(self, pair: FramePair) -> Iterator[tuple[Frame, EventStream]]:
        """Frames with their packets, a sequence at a time.

        Only the last sequence reaches back into the one before it, to be as long.
        """
        for frame in pair.frames:
            if self._first_us is None:
                yield frame, self.step(frame)
                continue
            self._waiting.append((frame, self._enter(frame)))
            self._recent.append(_normalise(frame.luma))
            if len(self._waiting) == SEQUENCE:
                yield from self.finish()

    def finish(self) -> Iterator[tuple[Frame, EventStream]]:
        """The frames that wait for a sequence to be complete, with their packets."""
        waiting, self._waiting = self._waiting, []
        grids = self._predict()[-len(waiting) :] if waiting else ()
        for (frame, interval), grid in zip(waiting, grids, strict=True):
            yield frame, make_packet(sample_events(grid, interval), interval, frame.size)

    def _begin(self, intensity: IntensityArray) -> None:
        self._recent = deque([_normalise(intensity)], maxlen=SEQUENCE + 1)

    def _advance(self, intensity: IntensityArray, interval: FrameInterval) -> UnsortedEvents:
        self._recent.append(_normalise(intensity))
        return sample_events(self._predict()[-1], interval)

    def _predict(self) -> NDArray[np.float32]:
        """Voxel grids of the recent pairs, [n, 2, 10, H, W]."""
        torch, recent = require("torch", extra=EXTRA), np.stack(self._recent)
        what = (
            f"these frames do not fit into device {self._device} with v2ce; give a smaller sensor"
        )
        with explain_memory(what), torch.inference_mode():
            pairs = torch.from_numpy(np.stack([recent[:-1], recent[1:]], axis=1))
            grids: NDArray[np.float32] = self._network(pairs.to(self._device)).cpu().numpy()
        if not np.isfinite(grids).all():
            raise FileFormatError(f"{self._path}: the network's output is NaN or infinite")
        return grids


def _find_weights(config: V2ceConfig) -> Path:
    return locate_weights("simulator v2ce", FILE, WHERE_FROM, config.weights)


def _normalise(intensity: IntensityArray) -> NDArray[np.float32]:
    """Intensity in the network's unit, [H, W] float32."""
    return np.asarray((intensity.astype(np.float64) / WHITE - MEAN) / SPREAD, np.float32)


def sample_events(voxel: NDArray[Any], interval: FrameInterval) -> UnsortedEvents:
    """Events of a voxel grid by LDATI, V2CE's local dynamic-aware timestamp inference.

    A lone event of a sub-interval gets exactly the time that made the grid; times of several are
    drawn from a density that rises or falls as the neighbours' counts do.

    Args:
        voxel: events per node, at least 0, [2, nodes, H, W], ON first.
        interval: time from the first node to the last; its key decides the draws.

    Raises:
        InputError: there are more events than memory holds.
    """
    check_event_number(float(np.sum(voxel, dtype=np.float64)))
    counts, fraction = _infer_counts(np.asarray(voxel, np.float64))
    parts, slope = counts.shape[1], np.zeros(counts.shape)
    # Of the line through the counts of three neighbours, in units of the middle one.
    slope[:, 1:-1] = (counts[:, 2:] - counts[:, :-2]) / (2.0 * np.maximum(counts[:, 1:-1], 1))
    place = np.nonzero(counts)
    number = counts[place]
    rows = np.repeat(np.arange(len(number)), number)
    order = np.arange(len(rows)) - np.repeat(np.cumsum(number) - number, number)
    polarity, part, y, x = (index[rows] for index in place)
    draw = Purpose.TIMESTAMP.draw((polarity * parts + part) * MOST_PER_PLACE + order)
    drawn = sample_density(slope[place][rows], draw_uniforms(interval.key, y, x, draw))
    within = np.where(number[rows] == 1, fraction[place][rows], drawn)
    since_us = ((part + within) / parts * interval.duration_us).astype(np.int64)
    t = interval.start_us + np.minimum(since_us, interval.duration_us - 1)
    return UnsortedEvents.signal(y * voxel.shape[3] + x, t, (polarity == 0).astype(np.uint8))


def _infer_counts(nodes: Array) -> tuple[NDArray[np.int64], Array]:
    """Events per sub-interval, and the fraction τ of a lone one, [2, nodes − 1, H, W] each.

    An event between nodes i and i + 1 adds 1 − τ to the one and τ to the other. A node, less what
    the events before it have added, is what those after it add; the next whole number is their
    count, and the difference they add to the next node. What is left at the last node falls into
    the last sub-interval.
    """
    parts = nodes.shape[1] - 1
    counts = np.zeros((nodes.shape[0], parts, *nodes.shape[2:]), np.int64)
    fraction = np.zeros(counts.shape)
    carry = np.zeros_like(nodes[:, 0])
    for i in range(parts):
        left = nodes[:, i] - carry
        counts[:, i] = np.maximum(np.ceil(left - TOLERANCE), 0.0)
        fraction[:, i] = carry = counts[:, i] - left
    rest = np.floor(nodes[:, parts] - carry + TOLERANCE)
    counts[:, -1] += np.maximum(rest, 0.0).astype(np.int64)
    return counts, np.clip(fraction, 0.0, 1.0)


def sample_density(slope: Array, chance: Array) -> Array:
    """Fractions τ with `(1 − s/2) τ + s τ²/2 = chance`: the density 1 + s (τ − ½), inverted.

    A line steeper than 2 would be negative at its low end. Times then come from that part at its
    high end whose area is 1.

    Example:
        >>> sample_density(np.array([0.0, 2.0, -2.0]), np.array([0.25, 0.25, 0.75])).tolist()
        [0.25, 0.5, 0.5]
    """
    start = 1.0 - slope / 2.0
    root = np.sqrt(np.maximum(start * start + 2.0 * slope * chance, 0.0))
    # Two forms of the quadratic's root, each where it subtracts nothing from its like.
    is_steep = start < 0.0
    flat = 2.0 * chance / np.maximum(start + root, np.finfo(np.float64).tiny)
    return np.where(is_steep, (root - start) / np.where(is_steep, slope, 1.0), flat)
