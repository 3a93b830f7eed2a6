"""Events of a batch of clips on the GPU: tensors in, tensors out, nothing copied to the host."""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from importlib import import_module
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray

from texvent._registry import SIMULATORS
from texvent._require import require
from texvent.config import check_whole
from texvent.errors import ConfigError, InputError, warn
from texvent.events import EventStream
from texvent.options.arrays import whole_numbers
from texvent.represent.tensors import EventTensors
from texvent.sensor import SensorSize, checked_size
from texvent.simulation.esim.config import EsimConfig
from texvent.simulation.gpu.intervals import Clock, Span
from texvent.simulation.gpu.kernel_types import Call, FrameLayout, Intervals, NoiseRules, Tensor
from texvent.simulation.gpu.launch import EXTRA, alignment, check_device, on_device, to_device
from texvent.simulation.gpu.ordering import order_events
from texvent.simulation.gpu.passes import GpuPixels, run_passes
from texvent.simulation.gpu.support import MODELS, find_model
from texvent.simulation.physical.config import PhysicalConfig
from texvent.simulation.random.draws import frame_keys
from texvent.simulation.texvent.config import TexventConfig
from texvent.simulation.texvent.gpu.noise import noise_rules


@dataclass(frozen=True, eq=False)
class ClipEvents:
    """The events of all clips, clip by clip, each sorted by (t, y, x, p, label)."""

    x: Tensor
    """Column, pixels, [n] int32."""
    y: Tensor
    """Row, pixels from the top, [n] int32."""
    t: Tensor
    """Time, µs, [n] int64."""
    p: Tensor
    """Polarity, [n] int8: 1 = ON, 0 = OFF."""
    label: Tensor
    """[n] int8: `events.SIGNAL` or `events.NOISE`."""
    clip_offsets: Tensor
    """[B + 1] int64: where the events of each clip begin, and n; on the same device."""
    size: SensorSize
    """Width and height of the sensor, pixels."""
    frame_ends: NDArray[np.int64] = field(repr=False)
    """[B, T + 1] on the host: where the events of each interval begin, and where the last ends."""

    def __len__(self) -> int:
        return len(self.t)

    @property
    def clips(self) -> int:
        """B."""
        return len(self.frame_ends)

    def clip(self, index: int) -> EventTensors:
        """The events of one clip, without a copy; every representation takes them.

        `EventTensors` checks what it is given, which waits for the device.
        """
        part = self._part(index)
        return EventTensors(self.x[part], self.y[part], self.t[part], self.p[part], self.size)

    def stream(self, index: int) -> EventStream:
        """The events of one clip, copied to the host."""
        return self._stream(self._copied(self._part(index)))

    def packets(self, index: int) -> Iterator[EventStream]:
        """The events of one clip on the host, those of each interval as a packet."""
        ends = self.frame_ends[index]
        if len(ends) == 1:  # only the first frame was seen: nothing to wait for
            return
        columns = self._copied(self._part(index))
        for first, last in itertools.pairwise((ends - ends[0]).tolist()):
            yield self._stream([column[first:last] for column in columns])

    def _stream(self, columns: Sequence[NDArray[Any]]) -> EventStream:
        t, x, y, p, label = columns
        return EventStream.unchecked(x, y, t, p, size=self.size, label=label)

    def _copied(self, part: slice) -> list[NDArray[Any]]:
        """t, x, y, p, label on the host, as an `EventStream` has them."""
        torch = require("torch", extra=EXTRA)
        kinds = (torch.int64, torch.int16, torch.int16, torch.int8, torch.int8)
        columns = (self.t, self.x, self.y, self.p, self.label)
        narrow = [
            column[part].to(kind).contiguous().view(torch.uint8)
            for column, kind in zip(columns, kinds, strict=True)
        ]
        # In one piece: the host waits once.
        together = torch.cat(narrow).cpu().numpy()
        ends = np.cumsum([len(one) for one in narrow])[:-1]
        t, x, y, p, label = np.split(together, ends)
        return [t.view(np.int64), x.view(np.uint16), y.view(np.uint16), p, label]

    def _part(self, index: int) -> slice:
        ends = self.frame_ends[index]
        return slice(int(ends[0]), int(ends[-1]))


_MAX_AREA = 2**31
_MAX_WORD = 2**63


@dataclass(eq=False)
class _ClipStates:
    """State of a batch of clips from one call to the next."""

    size: SensorSize
    clock: Clock
    seeds: tuple[int, ...]
    pixels: GpuPixels[Any]
    previous: Tensor
    """[B, H, W] the last frame of every clip; None before the first."""


class GpuSimulator:
    """A pixel model on a batch of clips of one size, a chunk of frames at a time.

    Clip b of a batch gives the events that the same model gives on the CPU with clip b's seed: bit
    for bit from 8-bit frames; from float32 frames wherever no change is within rounding, about
    10⁻¹⁵ log units, of the threshold. How a clip is cut into chunks changes nothing.
    """

    def __init__(
        self,
        config: TexventConfig
        | EsimConfig
        | PhysicalConfig
        | Sequence[PhysicalConfig]
        | None = None,
        *,
        seed: int | Sequence[int] = 0,
        is_scale_known: bool = False,
    ) -> None:
        """Prepare a simulator that has seen no frame.

        Args:
            config: options of the model, whose type says which it is; of `physical` also one per
                clip, alike in noise curve, `gamma` 1 or not, `cutoff_hz` 0 or not.
                Default: Texvent's default preset.
            seed: one per clip; or one number, and clip b has `seed + b`. 0..2⁶³−1.
            is_scale_known: False: a warning where float frames are probably 0..1, for which the
                host waits once.

        Raises:
            ConfigError: an option or a model that only the CPU has, or a seed out of range.
            InputError: a list of seeds holds something else than whole numbers.
        """
        self.config = config if config is not None else TexventConfig()
        self._seed, self._is_scale_known = seed, is_scale_known
        _seeds_of(seed, None)  # refuses what is out of range
        each = self.config if isinstance(self.config, Sequence) else (self.config,)
        names = [find_model(one) for one in each]
        if isinstance(self.config, Sequence) and set(names) != {"physical"}:
            raise ConfigError("a list of options must be of physical, one per clip")
        self._name, self._model = names[0], SIMULATORS.load(names[0])(each[0])
        self.reset()

    @property
    def contrast_threshold(self) -> float:
        """δ that Eq. 4 should count with, log units; as `protocol.Simulator` has it."""
        return float(self._model.contrast_threshold)

    @property
    def balance(self) -> float:
        """α that Eq. 4 should count with, on the 0..255 scale; as `protocol.Simulator` has it."""
        return float(self._model.balance)

    def reset(self) -> None:
        """Forget all frames: the next ones begin new clips."""
        self._clips: _ClipStates | None = None
        self._is_broken = False

    def step(self, frames: Tensor, times_us: Any, is_source: Any = None) -> ClipEvents:
        """Events between the last frame of the call before and the last of these.

        The host waits for the device once, for the number of events.

        Args:
            frames: [B, T, H, W] intensity, 0..255 scale, uint8 or float32.
            times_us: [T] or [B, T] whole µs, strictly increasing, also across calls; best on the
                host, where they are needed.
            is_source: [T] or [B, T], False for frames made by interpolation; None: all are source
                frames. Texvent's cache looks at it.

        Returns:
            The events of every clip in `[its last frame before, its last frame now)`.

        Raises:
            InputError: another shape, type or device than allowed or before, times that do not
                increase, or an intensity that is NaN, negative or too high: the state is then as
                it was. Or a call before broke off, such as for want of memory.
            ConfigError: the frames are not on a GPU.
        """
        torch = require("torch", extra=EXTRA)
        _check_frames(torch, frames)
        clips = self._clips or self._begin(frames)
        _check_alike(clips, frames)
        if self._is_broken:
            raise InputError(
                "a call before broke off and left the clips between two frames; call reset() and "
                "give them again from their first"
            )
        span = clips.clock.read(frames.shape[1], times_us, is_source)
        self._is_broken = True
        try:
            with on_device(frames.device), torch.no_grad():
                events = self._advance(clips, frames, span)
        except InputError:  # nothing has moved
            self._is_broken = False
            raise
        self._is_broken = False
        clips.pixels.advance(span)
        clips.clock.advance()
        if self._clips is None and not self._is_scale_known:
            _check_scale(frames)
        self._clips = clips
        return events

    def _begin(self, frames: Tensor) -> _ClipStates:
        """State of clips like these, before their first frame."""
        check_device(frames.device)
        count, _, height, width = frames.shape
        seeds = _seeds_of(self._seed, count)
        if isinstance(self.config, Sequence) and len(self.config) != count:
            raise ConfigError(
                f"config lists options of {len(self.config)} clips, and there are {count}"
            )
        pixels = _make_pixels(self._name, self.config, seeds)
        pixels.begin(frames[:, 0])
        return _ClipStates(checked_size(width, height), Clock(count), seeds, pixels, None)

    def _advance(self, clips: _ClipStates, frames: Tensor, span: Span) -> ClipEvents:
        frames = _rows_in_place(frames)
        if clips.previous is None:
            first, frames = frames[:, 0].clone(), frames[:, 1:]
        else:
            first = clips.previous
        if not frames.shape[1]:
            clips.previous = first
            return _no_events(clips, frames)
        first, frames = _of_one_type(first, frames)
        call, noise = self._call(clips, first, frames, span)
        clips.pixels.prepare(call, span)
        is_adaptive = isinstance(self.config, TexventConfig) and self.config.noise == "adaptive"
        found = run_passes(clips.pixels, call, noise, on_resting=is_adaptive)
        count, intervals = frames.shape[:2]
        clip_offsets = found.ends[::intervals]
        x, y, t, p, label = order_events(
            found.words,
            clip_offsets.contiguous(),
            call.intervals.origin_us[::intervals].contiguous(),
            area=call.frames.area,
            width=call.frames.width,
        )
        clips.previous = frames[:, -1].clone()
        rows = np.arange(count)[:, None] * intervals + np.arange(intervals + 1)
        return ClipEvents(x, y, t, p, label, clip_offsets, clips.size, found.host_ends[rows])

    def _call(
        self, clips: _ClipStates, first: Tensor, frames: Tensor, span: Span
    ) -> tuple[Call, NoiseRules | None]:
        """The call as the kernels see it, and its noise."""
        size, strides = clips.size, frames.stride()
        area = size.width * size.height
        if area >= _MAX_AREA or span.axis_us * area * 4 >= _MAX_WORD:
            raise InputError(
                f"{span.axis_us} µs of frames of {size} in one call are too many to order; "
                "give fewer frames at a time"
            )
        rules, table = None, np.zeros_like(span.start_us)
        if isinstance(self.config, TexventConfig) and self.config.has_added_noise:
            rules, table = noise_rules(self.config, span, frames)
        keys = [
            frame_keys(seed, since_us)
            for seed, since_us in zip(clips.seeds, span.stop_us - span.first_us, strict=True)
        ]
        columns = (
            span.start_us,
            span.duration_us,
            np.stack(keys).view(np.int64),
            clips.pixels.shares(span).view(np.int64),
            np.broadcast_to(span.origins_us[:, None], span.start_us.shape),
            table,
        )
        plan = to_device(np.stack(columns).reshape(len(columns), -1), frames.device)
        layout = FrameLayout(
            frames, first, strides[0], strides[1], frames.shape[1], area, size.width
        )
        return Call(layout, Intervals(*plan), alignment(area, strides[0], strides[1])), rules


def _make_pixels(name: str, config: object, seeds: Sequence[int]) -> GpuPixels[Any]:
    module = import_module(f"texvent.simulation.{name}.gpu.pixels")
    return cast("GpuPixels[Any]", getattr(module, MODELS[name].pixels)(config, seeds))


def _seeds_of(seed: int | Sequence[int], clips: int | None) -> tuple[int, ...]:
    """A seed per clip; `clips` None: as many as are given."""
    if np.ndim(seed) == 0:
        check_whole("seed", seed, 0, 2**63 - 1)
        first = int(cast("int", seed))
        seeds = tuple(range(first, first + (clips or 1)))
    else:
        given = whole_numbers(seed, "seed", "one whole number per clip")
        seeds = tuple(given.ravel().tolist())
        if given.ndim > 1 or (clips is not None and len(seeds) != clips):
            shape = " x ".join(map(str, given.shape))
            count = "" if clips is None else f" for {clips} clips"
            raise ConfigError(f"there are {shape} seeds{count}; give one per clip")
    for one in seeds:
        check_whole("seed", one, 0, 2**63 - 1)
    return seeds


def _check_frames(torch: Any, frames: Any) -> None:
    if not isinstance(frames, torch.Tensor):
        raise InputError(f"frames must be a torch tensor; got {type(frames).__name__}")
    if frames.ndim != 4 or 0 in frames.shape:
        raise InputError(
            f"frames must be [B, T, H, W] with at least one of each; got shape {list(frames.shape)}"
        )
    if frames.dtype not in (torch.uint8, torch.float32):
        raise InputError(f"frames must be uint8 or float32; got {frames.dtype}")


def _check_scale(frames: Tensor) -> None:
    """Warn of frames that are probably 0..1."""
    if frames.is_floating_point() and 0 < (highest := float(frames.max())) <= 1:
        warn(
            f"no pixel of the frames is above {highest:g}, while 255 is white: give frames * 255 "
            "if 1 means white, or is_scale_known=True if they really are that dark"
        )


def _check_alike(clips: _ClipStates, frames: Tensor) -> None:
    """Refuse frames of other clips than those seen."""
    if clips.previous is None:
        return
    seen, now = clips.previous, frames[:, 0]
    if (seen.shape, seen.device) != (now.shape, now.device):
        raise InputError(
            f"frames are {list(now.shape)} (clips, height, width) on {now.device}, those before "
            f"were {list(seen.shape)} on {seen.device}; call reset() before other clips"
        )


def _rows_in_place(frames: Tensor) -> Tensor:
    """The frames, copied only if their pixels are not contiguous."""
    width = frames.shape[3]
    return frames if frames.stride()[2:] == (width, 1) else frames.contiguous()


def _of_one_type(first: Tensor, frames: Tensor) -> tuple[Tensor, Tensor]:
    """Both in the type that holds both exactly."""
    if first.is_floating_point() or frames.is_floating_point():
        return first.float(), frames.float()
    return first, frames


def _no_events(clips: _ClipStates, frames: Tensor) -> ClipEvents:
    """The empty batch of the first frame of clips."""
    torch = require("torch", extra=EXTRA)
    count, device = len(frames), frames.device
    columns = order_events(
        torch.empty(0, dtype=torch.int64, device=device), None, None, area=1, width=1
    )
    offsets = torch.zeros(count + 1, dtype=torch.int64, device=device)
    return ClipEvents(*columns, offsets, clips.size, np.zeros((count, 1), np.int64))
