"""Events from changes of brightness: counted by thresholds, timed by V2CE's LDATI. Experimental.

A pixel keeps how far its brightness is from that of its last event. In a bin that moves it past n
thresholds of size δ, n events happen: ON if it rises, OFF if it falls. As if it moved evenly, the
k-th one is at the fraction

    τ[k] = (k · δ − r) / |c|,    k = 1 .. n

of the bin, where c is the bin's change and r the distance at its start, counted along c. An event
adds 1 − τ to the node at the start of its bin and τ to the one at its end: the grid from which
LDATI infers times. A lone event gets its time back; of several in a bin, LDATI draws them.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from texvent.config import check_range
from texvent.events import EventStream
from texvent.simulate.packets import FrameInterval, make_packet
from texvent.simulate.random.draws import frame_key
from texvent.simulate.v2ce.ldati import sample_events
from texvent_lab.latents.change import BrightnessChange

Float64Array = NDArray[np.float64]


def sample_packets(
    change: BrightnessChange, *, contrast_threshold: float = 0.2, seed: int = 0
) -> Iterator[EventStream]:
    """Events of each interval.

    Args:
        change: what the pixels see.
        contrast_threshold: δ, log units.
        seed: of the random draws, 0..2⁶³−1.

    Yields:
        Packets in time order, a packet per latent frame after the first.

    Raises:
        ConfigError: the threshold or the seed is out of range.
    """
    check_range("contrast_threshold", contrast_threshold, 0.01, 10.0)
    check_range("seed", seed, 0, 2**63 - 1)
    bounds_us = change.edges_us[:: change.voxels.shape[1]].tolist()
    distance = np.zeros(change.voxels.shape[2:])
    for number, voxels in enumerate(change.voxels):
        start_us, stop_us = bounds_us[number : number + 2]
        interval = FrameInterval(start_us, stop_us, frame_key(seed, stop_us))
        grid, distance = node_grid(voxels, distance, contrast_threshold)
        yield make_packet(sample_events(grid, interval), interval, change.size)


def node_grid(
    voxels: NDArray[np.float32], distance: Float64Array, contrast_threshold: float
) -> tuple[Float64Array, Float64Array]:
    """The grid that LDATI takes, from the changes of one interval.

    Args:
        voxels: changes, [B, H, W], log units.
        distance: from the brightness at each pixel's last event, [H, W], within ± δ.
        contrast_threshold: δ, log units.

    Returns:
        Events per node, ON first, then OFF, [2, B + 1, H, W], and the distance at the end.
    """
    grid = np.zeros((2, len(voxels) + 1, *voxels.shape[1:]))
    # In units of δ: n events move the reference by n.
    distance = distance / contrast_threshold
    for node, change in enumerate(voxels / np.float64(contrast_threshold)):
        counts = np.trunc(distance + change)
        n, along = np.abs(counts), distance * np.sign(change)
        with np.errstate(divide="ignore", invalid="ignore"):
            late = np.where(n > 0, (n * (n + 1) / 2 - n * along) / np.abs(change), 0.0)
        for polarity, fired in enumerate((counts > 0, counts < 0)):
            grid[polarity, node] += np.where(fired, n - late, 0.0)
            grid[polarity, node + 1] += np.where(fired, late, 0.0)
        distance = distance + change - counts
    return grid, distance * contrast_threshold
