"""The paper's simulator: frames → event frames → noise → time stamps (section 3.2.2)."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, ClassVar

import numpy as np

from texvent.brightness import check_intensity
from texvent.config import check_range
from texvent.events import EventStream
from texvent.frames import Frame, StreamChecker
from texvent.pairs.frame_pair import FramePair
from texvent.simulation.packets import FrameInterval, UnsortedEvents
from texvent.simulation.random.draws import frame_key
from texvent.simulation.streaming import SteppingSimulator, make_packet
from texvent.simulation.texvent.config import PRESETS, TexventConfig

if TYPE_CHECKING:
    from texvent.simulation.texvent.fused import FusedPass
    from texvent.simulation.texvent.pixels import GaussianPixels, SparsePixels

__all__ = ["TexventConfig", "TexventSimulator"]


class TexventSimulator(SteppingSimulator):
    """Texvent's pixel model (Eqs. 5-7); see `simulation.protocol.Simulator`.

    A pair whose intermediate frames would be moved by optical flow is computed without drawing
    them where few pixels may fire; the events are the same.

    Example:
        >>> import numpy as np
        >>> from texvent import Frame
        >>> from texvent.pixel_models import TexventConfig, TexventSimulator
        >>> simulator = TexventSimulator(TexventConfig(noise="none"), seed=1)
        >>> dark, bright = np.full((1, 2), 50, np.uint8), np.array([[50, 90]], np.uint8)
        >>> len(simulator.step(Frame(dark, t_us=0)))  # nothing to compare with yet
        0
        >>> events = simulator.step(Frame(bright, t_us=1000))
        >>> events.x.tolist(), events.t.tolist(), events.polarity.tolist()
        ([1, 1], [442, 884], [1, 1])
    """

    config_type: ClassVar[type] = TexventConfig
    bytes_per_pixel: ClassVar[int] = 30
    presets: ClassVar[Mapping[str, TexventConfig]] = PRESETS
    frame_bound_presets: ClassVar[frozenset[str]] = frozenset({"paper"})
    reference_fill_factor: ClassVar[float] = 0.22
    """That of the DAVIS346, whose background activity the default rates are."""

    def __init__(self, config: TexventConfig | None = None, *, seed: int = 0) -> None:
        """Prepare a simulator that has seen no frame.

        Args:
            config: options; default: the preset "accurate".
            seed: of noise and random times, 0..2⁶³−1.

        Raises:
            ConfigError: the seed is out of range.
        """
        check_range("seed", seed, 0, 2**63 - 1)
        self.config = config or TexventConfig()
        self._seed = int(seed)
        self._forgets = self.config.cache in ("local", "none")
        self.reset()

    @property
    def contrast_threshold(self) -> float:
        """δ, log units."""
        return self.config.contrast_threshold

    @property
    def balance(self) -> float:
        """α, on the 0..255 scale."""
        return self.config.balance

    @property
    def benefits_from_denser_frames(self) -> bool:
        """Whether a pixel may fire several times per frame; else more frames are more events."""
        return self.config.multi_event

    @property
    def slow_change(self) -> str | None:
        """Why slow change may fire nothing, and the options that help."""
        if self._forgets:
            return (
                f"cache='{self.config.cache}' forgets earlier frames, so slow change never adds "
                "up; give cache='global'"
            )
        if self.config.residual_decay_hz > 1:
            return "references decay faster than the video changes; lower residual_decay_hz"
        return None

    def reset(self) -> None:
        """Forget all frames: the next one is the first."""
        self._checker = StreamChecker()
        self._pixels: GaussianPixels | SparsePixels | None = None
        self._last: Frame | None = None
        self._first_us = 0
        self._fused: FusedPass | None = None

    def advance(self, pair: FramePair) -> Iterator[tuple[Frame, EventStream]]:
        """Events between two frames; see `simulation.protocol.Simulator.advance`."""
        is_drawn = pair.first is None or not self.config.is_fusible or pair.motion.flows is None
        if is_drawn:
            yield from super().advance(pair)
            return
        from texvent.simulation.texvent.fused import FusedPass  # brings Numba
        from texvent.simulation.texvent.pixels import SparsePixels

        self._fused = self._fused or FusedPass(self.config, self._seed)
        # The pixels' references; those of a cache that forgets are the earlier frame's.
        pixels = self._pixels
        if self._forgets or not isinstance(pixels, SparsePixels):
            pixels = None
        memory = None if pixels is None else pixels.ensure_reference()
        packets = self._fused.packets(pair, memory, self._first_us)
        self._leave_pair(pair, pixels)
        yield from packets

    def _leave_pair(self, pair: FramePair, pixels: SparsePixels | None) -> None:
        """Note that the pixels have seen the later frame of a pair, though no frame was stepped."""
        where = self._checker.check_order(pair.second)
        check_intensity(pair.second.pixels, where)
        if pixels is not None:
            pixels.advance_to(pair.second)
        # Without them, they are made again from the last frame when one is stepped.
        self._pixels = pixels
        self._checker.accept(pair.second)
        self._last = pair.second

    def step(self, frame: Frame) -> EventStream:
        """Events in `[t of the frame before, t of this frame)`, sorted; none for the first frame.

        Raises:
            InputError: another size than before, a time that does not increase, an intensity that
                is NaN, infinite or negative, or Gaussian noise of one event per frame or more.
        """
        where = self._checker.check_order(frame)
        if self._last is None:
            self._first_us = frame.t_us
            self._pixels = self._begin(frame, where)
            span = FrameInterval(frame.t_us, frame.t_us, np.uint64(0))
            packet = make_packet(UnsortedEvents.none(), span, frame.size)
        else:
            pixels = self._pixels or self._begin(self._last, where)
            key = frame_key(self._seed, frame.t_us - self._first_us)
            span = FrameInterval(self._last.t_us, frame.t_us, key)
            packet = pixels.advance(frame, span, where)
            self._pixels = pixels
        self._checker.accept(frame)
        self._last = frame
        return packet

    def _begin(self, frame: Frame, where: str) -> GaussianPixels | SparsePixels:
        """Pixels whose references are those of a frame."""
        from texvent.simulation.texvent.pixels import GaussianPixels, SparsePixels  # brings Numba

        kind = GaussianPixels if self.config.noise == "gaussian" else SparsePixels
        return kind(self.config, frame, where)
