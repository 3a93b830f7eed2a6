"""Simulation of a batch: frames of clips in, their events and arrays as tensors out."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent._require import require
from texvent.dataset.torch_samples import EventBatch
from texvent.represent.tensors import Tensor
from texvent.runtime.array_pool import ArrayPool
from texvent.sensor import SensorSize
from texvent.simulation.clips.pixels import ClipArrays, ClipOutputs, ClipPixels, byte_brightness
from texvent.training.draws import PhysicalRanges, Ranges

_torch: Any = require("torch", extra="torch")


def simulate_clips(
    frames: Tensor,
    times_us: NDArray[np.int64],
    ranges: Ranges,
    drawn: tuple[NDArray[np.float64], NDArray[np.uint64]],
    outputs: ClipOutputs,
    pool: ArrayPool,
    *,
    on_gpu: bool,
) -> ClipArrays:
    """Arrays of the clips, on the device of the frames.

    Args:
        frames: [B, T + 1, H, W] uint8.
        times_us: [B, T + 1] since the first frame of each clip.
        ranges: what was drawn from, which decides the pixel model.
        drawn: numbers and key of each clip, see `draws.ClipDraw`.
        outputs: what is made.
        pool: whose memory is taken on a CPU.
        on_gpu: whether the kernels of GPUs make it, or those of the CPU.

    Returns:
        Tensors.
    """
    if isinstance(ranges, PhysicalRanges):
        configs = [ranges.config(one) for one in drawn[0]]
        if on_gpu:
            from texvent.simulation.clips.physical_gpu import simulate_physical_on_gpu

            return simulate_physical_on_gpu(frames, times_us, configs, drawn[1], outputs)
        from texvent.simulation.clips.physical import simulate_physical

        made = simulate_physical(frames.numpy(), times_us, configs, drawn[1], outputs, pool)
        return _as_tensors(made)
    pixels = ClipPixels(*drawn, byte_brightness(ranges.gamma, ranges.log_eps))
    if on_gpu:
        from texvent.simulation.clips.scan_triton import simulate_on_gpu

        return simulate_on_gpu(frames, times_us, pixels, outputs)
    from texvent.simulation.clips.scan import simulate_on_cpu

    return _as_tensors(simulate_on_cpu(frames.numpy(), times_us, pixels, outputs, pool))


def _as_tensors(made: ClipArrays) -> ClipArrays:
    grids, counts, latest, words = (
        None if one is None else _torch.from_numpy(one) for one in made[:4]
    )
    return ClipArrays(grids, counts, latest, words, made.ends)


def events_of(made: ClipArrays, size: SensorSize) -> EventBatch:
    """The events of a batch; times count from the first frame."""
    area = size.width * size.height
    cell = made.words >> 1
    pixel, ends = (cell % area).int(), tuple(made.ends.tolist()) if made.ends is not None else ()
    return EventBatch(
        pixel % size.width, pixel // size.width, cell // area, (made.words & 1).to(_torch.int8),
        ends, (size,) * len(ends),
    )  # fmt: skip
