"""Clips of the `physical` pixel model on a GPU: its kernels, and their events as arrays.

The twin of `physical`. Every clip has options of its own in one launch. Whole numbers are
added, so that the order in which a GPU adds them changes nothing.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent._require import require
from texvent.simulation.clips.physical import seed_of
from texvent.simulation.clips.pixels import ClipArrays, ClipOutputs
from texvent.simulation.gpu.engine import ClipEvents, GpuSimulator
from texvent.simulation.gpu.launch import EXTRA, to_device
from texvent.simulation.physical.config import PhysicalConfig


def simulate_physical_on_gpu(
    frames: Any,
    times_us: NDArray[np.int64],
    configs: Sequence[PhysicalConfig],
    keys: NDArray[np.uint64],
    outputs: ClipOutputs,
) -> ClipArrays:
    """As `physical.simulate_physical`, of a tensor on a GPU, or in Triton's interpreter.

    The host waits once, for the number of events.

    Raises:
        ConfigError: the frames are not on a GPU.
        InputError: the clips are too long together for one launch.
    """
    torch = require("torch", extra=EXTRA)
    simulator = GpuSimulator(list(configs), seed=[seed_of(one) for one in keys])
    with torch.no_grad():
        events = simulator.step(frames, times_us)
        return _as_arrays(torch, events, times_us, outputs)


def _as_arrays(
    torch: Any, events: ClipEvents, times_us: NDArray[np.int64], outputs: ClipOutputs
) -> ClipArrays:
    """Arrays of the events of all windows, which follow each other."""
    device, per = events.t.device, outputs.intervals_per_window
    (count, frames), size = times_us.shape, events.size
    windows, area = (frames - 1) // per, size.width * size.height
    starts, stops = events.frame_ends[:, :-1:per].ravel(), events.frame_ends[:, per::per].ravel()
    of_window = torch.repeat_interleave(
        torch.arange(count * windows, device=device),
        to_device(stops - starts, device),
        output_size=len(events),
    )
    pixel = events.y.long() * size.width + events.x
    cell = (of_window * 2 + events.p) * area + pixel
    pairs = (count, windows, 2, size.height, size.width)
    grids = counts = latest = words = ends = None
    if outputs.grids:
        grids = _voxels(torch, events, (starts, stops), (of_window, pixel), outputs.bins)
        grids = grids.view(count, windows, outputs.bins, size.height, size.width)
    if outputs.counts:
        counts = torch.zeros(count * windows * 2 * area, dtype=torch.int32, device=device)
        counts = counts.index_add_(0, cell, torch.ones_like(cell, dtype=torch.int32)).view(pairs)
    if outputs.latest:
        opened_us = to_device(np.ascontiguousarray(times_us[:, :-1:per]).ravel(), device)
        since_us = (events.t - opened_us[of_window]).int()
        latest = torch.full((count * windows * 2 * area,), -1, dtype=torch.int32, device=device)
        latest = latest.scatter_reduce_(0, cell, since_us, "amax").view(pairs)
    if outputs.events:
        words, ends = ((events.t * area + pixel) << 1) | events.p, events.frame_ends[:, -1]
    return ClipArrays(grids, counts, latest, words, ends)


def _voxels(
    torch: Any,
    events: ClipEvents,
    edges: tuple[NDArray[np.int64], NDArray[np.int64]],
    place: tuple[Any, Any],
    bins: int,
) -> Any:
    """[W, bins, area] grids, as `scan.spread_events` makes them.

    Args:
        torch: the module.
        events: in order.
        edges: [W] where the events of each window begin and end, on the host.
        place: window and pixel of each event.
        bins: of a grid.
    """
    (starts, stops), (of_window, pixel), t_us = edges, place, events.t
    windows, area, device = len(starts), events.size.width * events.size.height, t_us.device
    sums = torch.zeros(windows * (bins + 1) * area, dtype=torch.int64, device=device)
    span = torch.ones(windows, dtype=torch.int64, device=device)
    if len(events):
        # Of windows without events any two: no event looks at them.
        last = len(events) - 1
        first_us = t_us[to_device(np.minimum(starts, last), device)]
        span = (t_us[to_device(np.clip(stops - 1, 0, last), device)] - first_us).clamp(min=1)
        placed = (t_us - first_us[of_window]) * (bins - 1)
        own = span[of_window]
        time_bin, after = placed // own, placed % own
        cell = (of_window * (bins + 1) + time_bin) * area + pixel
        sign = events.p.long() * 2 - 1
        sums.index_add_(0, cell, sign * (own - after))
        sums.index_add_(0, cell + area, sign * after)
    sums = sums.view(windows, bins + 1, area)[:, :-1]
    return (sums.double() / span[:, None, None]).float()
