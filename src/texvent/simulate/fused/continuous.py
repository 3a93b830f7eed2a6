"""Continuous time: threshold crossings along each pixel's own path, without intermediate frames.

Between two source frames the brightness of a pixel along the flow is a function of time. It is
sampled into linear segments, as many as that pixel needs, and its threshold crossings are solved
for directly. So the cost of a pair depends on what moves in it, not on Eq. 4's K.

Source: the sampling of ESIM (Rebecq, Gehrig and Scaramuzza, CoRL 2018, section 3.2), which renders
a frame whenever some pixel's brightness may have changed by more than a threshold or moved by more
than a pixel, here decided for each pixel by itself.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from texvent.errors import ConfigError
from texvent.pairs.frame_pair import FramePair
from texvent.pairs.instants import intermediate_times_us
from texvent.pairs.scene_change import SceneChange
from texvent.simulate.fused.candidates import one_grid
from texvent.simulate.fused.definitions import Int64Array, SampleGrids
from texvent.simulate.packets.interval import FrameInterval

SEGMENT_PX = 0.5
"""Largest displacement by flow within one segment, px; docs/design has figures for others."""
SEGMENT_RATIO = 1.5
"""Largest factor by which α + I changes within one segment where a pixel stands: two thresholds of
0.2. Blended frames change linearly in intensity, not in its logarithm."""
MOST_SEGMENTS = 64
"""As many as there are intermediate frames at most, by default."""
INTERPOLATIONS = ("flow", "blend", "none")
"""Interpolations along which a pixel can be followed."""


class SegmentPlan(NamedTuple):
    """When the pixels of a pair are sampled."""

    grids: SampleGrids
    edges_us: Int64Array
    """[G, P + 1] where the segments of each grid begin and end, µs."""


def check_continuous(
    simulator: Any, config: Any, *, name: str, backend: str, interpolate: str
) -> None:
    """Refuse a run that cannot be in continuous time; nothing is computed.

    Args:
        simulator: the simulator class; one that runs in continuous time has a static method
            `continuous_misfit(config)`: what its options must be, or None if they fit.
        config: its options.
        name: its name.
        backend: of the run.
        interpolate: of the run.

    Raises:
        ConfigError: simulator, options, backend or interpolation do not fit.
    """
    misfit_of: Callable[[Any], str | None] | None = getattr(simulator, "continuous_misfit", None)
    if backend == "gpu":
        raise ConfigError("engine 'continuous' has no backend gpu; use engine 'frames'")
    if misfit_of is None:
        raise ConfigError(
            f"engine 'continuous' cannot run simulator {name!r}; it runs esim, and texvent "
            "with multi_event, reset 'step' and timestamp_rule 'linear': choose one, or engine "
            "'frames'"
        )
    if interpolate not in INTERPOLATIONS:
        raise ConfigError(
            f"engine 'continuous' cannot follow interpolate {interpolate!r}; it follows "
            f"{', '.join(INTERPOLATIONS)}: choose one, or engine 'frames'"
        )
    misfit = misfit_of(config)
    if misfit is not None:
        raise ConfigError(f"engine 'continuous' runs {name} {misfit}; or use engine 'frames'")


def plan_segments(pair: FramePair) -> SegmentPlan:
    """The segments of a pair: own ones for each pixel, or those of a scene change."""
    motion = pair.motion
    if pair.change is not SceneChange.NONE or not len(motion):
        return SegmentPlan(one_grid(motion.positions), pair.edges_us[np.newaxis])
    return dyadic_segments(FrameInterval(pair.earlier.t_us, pair.second.t_us, np.uint64(0)))


def dyadic_segments(span: FrameInterval) -> SegmentPlan:
    """Grids of 1, 2, 4, ... equal segments, from which every pixel takes the first fine enough one.

    Args:
        span: the pair. Segments last at least a microsecond.
    """
    parts = [1]
    while 2 * parts[-1] <= min(MOST_SEGMENTS, span.duration_us):
        parts.append(2 * parts[-1])
    edges = np.full((len(parts), parts[-1] + 1), span.stop_us)
    for grid, number in enumerate(parts):
        inner = intermediate_times_us(span.start_us, span.stop_us, number - 1)
        edges[grid, :number] = [span.start_us, *inner]
    positions = (edges[:, 1:] - span.start_us) / span.duration_us
    number_of = np.array(parts)
    displacement2 = np.square(SEGMENT_PX * number_of)
    grids = SampleGrids(
        positions, number_of, displacement2, SEGMENT_RATIO ** number_of.astype(float)
    )
    return SegmentPlan(grids, edges)
