"""Frames on a GPU: each source frame goes up once, and what is between is made there.

Frames keep their copy on the device as long as they live. Nothing here waits for the device but
`DeviceFrame.pixels`, and `measure_pair` once for each pair.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Iterator, Sequence
from itertools import islice
from typing import Any, NamedTuple, Protocol, runtime_checkable

import numpy as np

from texvent._require import require
from texvent.brightness import LUMA_WEIGHTS
from texvent.frames import UINT16_PER_LEVEL, Frame
from texvent.pairs.frame_pair import FramePair
from texvent.pairs.motion_interpolation import MotionInterpolation
from texvent.pairs.scene_change import CELL_SUMS, cell_px
from texvent.runtime.devices import EXTRA, Device, Tensor, to_device
from texvent.sensor import SensorSize
from texvent.transfer import WHITE, Transfer

FLOAT64_ERROR = 1e-12
"""Largest difference of a change of brightness on a device from the host's."""


class PairMeasures(NamedTuple):
    """Bounds of the largest |ΔL| of a pair, log units; the thumbnails are kept with the frames."""

    low: float
    high: float


def measure_pair(first: Frame, second: Frame, balance: float, device: Device) -> PairMeasures:
    """The largest change of brightness, and the thumbnails by which scene changes are found.

    Args:
        first: the earlier frame.
        second: the later frame, same size.
        balance: α, on the 0..255 scale.
        device: where their luma is.
    """
    torch = require("torch", extra=EXTRA)
    frames = (first, second)
    earlier, later = (luma_on(one, device) for one in frames)
    change = ((later.double() + balance).log() - (earlier.double() + balance).log()).abs().max()
    new = [one for one in frames if CELL_SUMS not in vars(one) and _has_thumbnail(one)]
    sums = [_cell_sums(luma_on(one, device), cell_px(*one.size)) for one in new]
    # The host waits for the device here.
    found = torch.cat([change[None], *(one.flatten() for one in sums)]).cpu().numpy()
    parts = np.split(found[1:], np.cumsum([one.numel() for one in sums])[:-1])
    for frame, one, part in zip(new, sums, parts, strict=False):
        vars(frame)[CELL_SUMS] = part.reshape(tuple(one.shape))
    largest = float(found[0])
    largest = math.inf if math.isnan(largest) else largest
    return PairMeasures(largest - FLOAT64_ERROR, largest + FLOAT64_ERROR)


def _has_thumbnail(frame: Frame) -> bool:
    """Whether a scene change is looked for in it, in levels that need no curve of the host's."""
    return cell_px(*frame.size) > 0 and frame.transfer is Transfer.GAMMA


def _cell_sums(luma: Tensor, cell: int) -> Tensor:
    """Sums of `matching_levels` over the cells of a thumbnail, float64."""
    torch = require("torch", extra=EXTRA)
    if luma.is_floating_point():
        bright = luma.clamp(min=WHITE)
        luma = torch.where(luma > WHITE, WHITE * (1 + torch.log(bright / WHITE)), luma)
    rows, columns = luma.shape[0] // cell, luma.shape[1] // cell
    cells = luma[: rows * cell, : columns * cell].double()
    return cells.reshape(rows, cell, columns, cell).sum((1, 3))


BATCH_BYTES = 256 << 20
"""Intermediate frames that are simulated in one call, float32: at most so many bytes of them."""
_PIXELS, _LUMA = "_device_pixels", "_device_luma"


class DeviceFrame(Frame):
    """A frame on a device, copied to the host when its pixels are read."""

    def __init__(
        self,
        tensor: Tensor,
        t_us: int,
        *,
        is_source: bool = False,
        transfer: Transfer = Transfer.GAMMA,
    ) -> None:
        """A frame that shares its memory with a tensor.

        Args:
            tensor: [H, W] or [H, W, 3], uint8 or float32, 0..255 scale.
            t_us: its time, µs.
            is_source: False for a frame made by interpolation.
            transfer: what its levels are.
        """
        # A frozen dataclass takes no assignments.
        vars(self).update(t_us=t_us, is_source=is_source, transfer=transfer)
        vars(self).update({_PIXELS: _Copy(tensor, None)})

    @functools.cached_property
    def pixels(self) -> Any:
        """[H, W] or [H, W, 3] on the host."""
        return vars(self)[_PIXELS].tensor.cpu().numpy()

    def sampled_luma(self, step: int) -> Any:
        """See `Frame.sampled_luma`; only these pixels come to the host."""
        return DeviceFrame(vars(self)[_PIXELS].tensor[::step, ::step], self.t_us).luma

    @property
    def size(self) -> SensorSize:
        """Width and height, pixels."""
        height, width = vars(self)[_PIXELS].tensor.shape[:2]
        return SensorSize(width, height)


@runtime_checkable
class DrawnOnDevice(Protocol):
    """Intermediate frames of a pair that are drawn where the simulator wants them."""

    times_us: Sequence[int]
    """Times of the intermediate frames, µs."""
    at_once: int
    """Frames to draw in one call, at most."""

    def draw(self, start: int, stop: int) -> Tensor:
        """Luma of some of the frames, [stop − start, H, W] float32, 0..255 scale."""
        ...

    def __iter__(self) -> Iterator[Frame]:
        """The frames on the host, checked."""
        ...


class _Copy(NamedTuple):
    tensor: Tensor
    copied: Any
    """Event of the stream that copies; None where nothing has to be waited for."""


def pixels_on(frame: Frame, device: Device) -> Tensor:
    """Pixels of a frame as they are; 16 bits as int16 with the same bits.

    The copy is begun at the first call, in a stream of its own, so that a thread may call it ahead.
    """
    kept = vars(frame).get(_PIXELS)
    if kept is None or kept.tensor.device != device:
        kept = vars(frame)[_PIXELS] = _begin_copy(frame, device)
    if kept.copied is not None:
        now = require("torch", extra=EXTRA).cuda.current_stream(device)
        now.wait_event(kept.copied)
        kept.tensor.record_stream(now)
    return kept.tensor


def keep_on_device(frame: Frame, tensor: Tensor) -> Frame:
    """The frame, whose pixels are on a device already, as `pixels_on` gives them."""
    vars(frame)[_PIXELS] = _Copy(tensor, None)
    return frame


def _begin_copy(frame: Frame, device: Device) -> _Copy:
    if isinstance(frame, DeviceFrame):
        return _Copy(vars(frame)[_PIXELS].tensor.to(device), None)
    pixels = frame.pixels.view(np.int16) if frame.pixels.dtype == np.uint16 else frame.pixels
    stream = _copying(device)
    if stream is None:
        return _Copy(to_device(pixels, device), None)
    with require("torch", extra=EXTRA).cuda.stream(stream):
        return _Copy(to_device(pixels, device), stream.record_event())


@functools.cache
def _copying(device: Device) -> Any:
    """The stream of copies to a device; None on a CPU."""
    if device.type != "cuda":
        return None
    return require("torch", extra=EXTRA).cuda.Stream(device)


def luma_on(frame: Frame, device: Device) -> Tensor:
    """`Frame.luma` on a device, [H, W] uint8 or float32: the same bits."""
    kept = vars(frame).get(_LUMA)
    if kept is None or kept.device != device:
        kept = vars(frame)[_LUMA] = _luma(pixels_on(frame, device))
    return kept


def levels_on(frame: Frame, device: Device) -> Tensor:
    """Pixels of a frame on the 0..255 scale, [H, W] or [H, W, 3] float32."""
    return _scaled(pixels_on(frame, device), _unscaled(pixels_on(frame, device)).float())


def _luma(pixels: Tensor) -> Tensor:
    levels = _unscaled(pixels)
    if levels.ndim == 3:
        levels = levels if levels.is_floating_point() else levels.float()
        red, green, blue = (float(np.float32(weight)) for weight in LUMA_WEIGHTS)
        luma = levels[..., 0] * red
        luma += levels[..., 1] * green
        luma += levels[..., 2] * blue
        levels = luma
    is_byte = levels.dtype == require("torch", extra=EXTRA).uint8
    return levels if is_byte else _scaled(pixels, levels.float())


def _unscaled(pixels: Tensor) -> Tensor:
    torch = require("torch", extra=EXTRA)
    if pixels.dtype != torch.int16:
        return pixels
    return pixels.to(torch.int32).bitwise_and(0xFFFF).float()


def _scaled(pixels: Tensor, levels: Tensor) -> Tensor:
    """Float levels of pixels on the 0..255 scale."""
    torch = require("torch", extra=EXTRA)
    if pixels.dtype != torch.int16:
        return levels
    # By a tensor: by a number, a GPU multiplies with its rounded inverse.
    return levels / torch.full((), UINT16_PER_LEVEL, device=levels.device)


def batches_on(pair: FramePair, device: Device) -> Iterator[tuple[list[Frame], Tensor]]:
    """The intermediate frames of a pair and its later frame, as many at once as `BATCH_BYTES` hold.

    Yields:
        k frames, and their luma on the device, [k, H, W] uint8 or float32.
    """
    second = luma_on(pair.second, device)[None]
    ready: tuple[list[Frame], Tensor] | None = None
    for batch in _drawn_on(pair, device, max(1, BATCH_BYTES // (4 * second.numel()))):
        if ready is not None:
            yield ready
        ready = batch
    if ready is None:
        yield [pair.second], second
        return
    torch = require("torch", extra=EXTRA)
    yield [*ready[0], pair.second], torch.cat((ready[1], second.float()))


def _drawn_on(pair: FramePair, device: Device, most: int) -> Iterator[tuple[list[Frame], Tensor]]:
    torch, between = require("torch", extra=EXTRA), pair.between
    if isinstance(between, MotionInterpolation) and between.flows is None and between.times_us:
        between = _Blend(pair, between, device)
    if not isinstance(between, DrawnOnDevice):
        frames = iter(between)
        while batch := list(islice(frames, most)):
            yield batch, torch.stack([luma_on(one, device) for one in batch])
        return
    for start in range(0, len(between.times_us), most):
        times_us = between.times_us[start : start + most]
        stop, step = start + len(times_us), min(most, between.at_once)
        parts = [between.draw(at, min(at + step, stop)) for at in range(start, stop, step)]
        levels = parts[0] if len(parts) == 1 else torch.cat(parts)
        transfer = pair.second.transfer
        yield (
            [DeviceFrame(*one, transfer=transfer) for one in zip(levels, times_us, strict=True)],
            levels,
        )


class _Blend:
    """Frames of which none moves, on the device; see `MotionInterpolation.image`."""

    def __init__(self, pair: FramePair, blend: MotionInterpolation, device: Device) -> None:
        self.times_us, self.at_once = blend.times_us, len(blend)
        self._ends = [luma_on(one, device).float() for one in (pair.earlier, pair.second)]
        self._positions, self._blend = blend.positions, blend

    def draw(self, start: int, stop: int) -> Tensor:
        earlier, later = self._ends
        positions = np.array(self._positions[start:stop], np.float32)[:, None, None]
        return earlier + to_device(positions, earlier.device) * (later - earlier)

    def __iter__(self) -> Iterator[Frame]:
        return iter(self._blend)
