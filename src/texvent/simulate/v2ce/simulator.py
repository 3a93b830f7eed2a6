"""V2CE: a 3-D U-Net turns pairs of frames into voxel grids, and LDATI those into events.

Source: Z. Zhang et al., "V2CE: Video to Continuous Events Simulator", ICRA 2024.
docs/simulators/v2ce.md gives the steps, and where they depart from the program (V2CE-Toolbox).
"""

from __future__ import annotations

from collections import deque
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, ClassVar, TypeAlias

import numpy as np
from numpy.typing import NDArray

from texvent._require import require
from texvent.config import check_range
from texvent.errors import ConfigError, InputError
from texvent.events import EventStream
from texvent.networks.weight_files import describe_file
from texvent.pairs.frame_pair import FramePair
from texvent.simulate.packets import FrameInterval, UnsortedEvents, make_packet
from texvent.simulate.streaming import IntensityArray, StreamingSimulator
from texvent.simulate.v2ce.ldati import sample_events
from texvent.video import Frame

Float32Array: TypeAlias = NDArray[np.float32]
WHERE_FROM = (
    "the published file is v2ce_3d.pt; its authors' project V2CE-Toolbox "
    "(github.com/ucsd-hdsi-dvs/V2CE-Toolbox) links to it"
)


@dataclass(frozen=True, kw_only=True)
class V2ceConfig:
    """Options of V2CE; the defaults are those of its program.

    Raises:
        ConfigError: an option is out of range.
    """

    weights: Path | None = None
    """File with the network's weights, v2ce_3d.pt; it is never downloaded."""
    sequence_length: int = 16
    """Frame pairs that the network sees at once; it was trained on 16."""

    def __post_init__(self) -> None:
        check_range("sequence_length", self.sequence_length, 1, 1024)


WHITE = 255.0
MEAN, SPREAD = 0.153, 0.165
"""Mean and standard deviation of the training frames, of full scale: the network's unit."""


class V2ceSimulator(StreamingSimulator[V2ceConfig]):
    """V2CE on video frames; see `simulate.protocol.Simulator`.

    The network answers for a pair of frames by those before and after it. `advance` gives it whole
    sequences, as its authors do, and is what a run uses. `step` cannot wait: it answers from
    the last `sequence_length` pairs, so its events differ a little, and each costs a sequence.
    """

    config_type: ClassVar[type] = V2ceConfig
    presets: ClassVar[Mapping[str, V2ceConfig]] = {"default": V2ceConfig()}
    frame_bound_presets: ClassVar[frozenset[str]] = frozenset(presets)
    default_interpolate: ClassVar[str] = "none"
    """The network was made for the frames of the video itself."""

    def __init__(self, config: V2ceConfig | None = None, *, seed: int = 0) -> None:
        """Load the network; no frame is seen yet.

        Args:
            config: options; its `weights` must be given.
            seed: of the times that are drawn, 0..2⁶³−1.

        Raises:
            ConfigError: no weights, or the seed out of range.
            InputError: there is no such file, or it does not hold this network.
            MissingDependencyError: torch is not installed.
        """
        super().__init__(config, seed=seed)
        path = check_weights_path(self.config.weights)
        self._network = load_network(path)

    @staticmethod
    def provenance(config: V2ceConfig) -> dict[str, str]:
        """Name and sha256 of the weights file; stored with the events.

        Raises:
            ConfigError: no file was named.
            InputError: there is no such file.
        """
        return describe_file(check_weights_path(config.weights))

    @property
    def contrast_threshold(self) -> float:
        """The Texvent model's: the network has none, but intermediate frames may be asked for."""
        return 0.2

    @property
    def balance(self) -> float:
        """The Texvent model's, likewise."""
        return 30.0

    def reset(self) -> None:
        """Forget all frames: the next one is the first."""
        super().reset()
        self._waiting: list[tuple[Frame, FrameInterval]] = []

    def advance(self, pair: FramePair) -> Iterator[tuple[Frame, EventStream]]:
        """Frames with their packets, a sequence at a time; see `simulate.protocol.Simulator`.

        Sequences follow one another without overlap; only the last reaches back into the one
        before it, to be as long. Up to `sequence_length` + 1 frames are held.
        """
        for frame in pair.frames:
            interval = self._enter(frame)
            if interval.duration_us == 0:
                self._begin(frame.luma)
                yield frame, make_packet(UnsortedEvents.none(), interval, frame.size)
                continue
            self._recent.append(normalise(frame.luma))
            self._waiting.append((frame, interval))
            if len(self._waiting) == self.config.sequence_length:
                yield from self.finish()

    def finish(self) -> Iterator[tuple[Frame, EventStream]]:
        """The frames that wait for a sequence to be complete, with their packets."""
        waiting, self._waiting = self._waiting, []
        if waiting:
            yield from self._answer(waiting)

    def _answer(
        self, waiting: list[tuple[Frame, FrameInterval]]
    ) -> Iterator[tuple[Frame, EventStream]]:
        grids = self._predict()[-len(waiting) :]
        for (frame, interval), grid in zip(waiting, grids, strict=True):
            yield frame, make_packet(sample_events(grid, interval), interval, frame.size)

    def _begin(self, intensity: IntensityArray) -> None:
        self._recent: deque[Float32Array] = deque(
            [normalise(intensity)], maxlen=self.config.sequence_length + 1
        )

    def _advance(self, intensity: IntensityArray, interval: FrameInterval) -> UnsortedEvents:
        self._recent.append(normalise(intensity))
        return sample_events(self._predict()[-1], interval)

    def _predict(self) -> Float32Array:
        """Voxel grids of the recent pairs, [N, 2, 10, H, W]."""
        recent = np.stack(self._recent)
        pairs = np.stack([recent[:-1], recent[1:]], axis=1)
        grids: Float32Array = self._network.predict(pairs)
        return grids


def check_weights_path(path: Path | None) -> Path:
    """The path of a weights file that exists.

    Raises:
        ConfigError: no file was named.
        InputError: there is no such file.
    """
    if path is None:
        raise ConfigError(
            f"simulator v2ce needs its network's weights and downloads nothing; {WHERE_FROM}. "
            "Then pass weights=PATH"
        )
    if not path.is_file():
        raise InputError(f"there is no weights file {path}; {WHERE_FROM}")
    return path


def load_network(path: Path) -> Any:
    """The `network.V2ceNetwork` of a weights file; it brings torch.

    Raises:
        FileFormatError: the file does not hold this network.
        MissingDependencyError: torch is not installed.
    """
    require("torch", extra="v2ce")
    from texvent.simulate.v2ce.network import V2ceNetwork

    return V2ceNetwork(path, WHERE_FROM)


def normalise(intensity: IntensityArray) -> Float32Array:
    """Intensity in the network's unit, [H, W] float32.

    Example:
        >>> normalise(np.array([[39.015, 81.09]])).round(3).tolist()
        [[0.0, 1.0]]
    """
    exact = intensity.astype(np.float64) / WHITE
    return np.asarray((exact - MEAN) / SPREAD, np.float32)
