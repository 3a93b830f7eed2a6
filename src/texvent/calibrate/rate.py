"""Find the contrast threshold that gives a wanted event rate."""

from __future__ import annotations

import dataclasses
import itertools
from collections.abc import Callable
from typing import NamedTuple

from texvent.calibrate.threshold_search import HIGHEST, LOWEST, MAX_STEPS, find_threshold
from texvent.config import check_range
from texvent.errors import InputError
from texvent.pipeline import Simulation
from texvent.runtime.progress import Progress
from texvent.simulate.model_options import contrast_threshold_of, with_contrast_threshold
from texvent.video import MICROSECONDS

UNREACHED = 0.1
"""Relative difference from which the rate counts as out of reach."""


class RateMatch(NamedTuple):
    """What the search found."""

    contrast_threshold: float
    """δ, log units."""
    rate_hz: float
    """Events per second with it, over the part that was simulated."""
    steps: int
    """Number of trials."""


def reach_target_rate(simulation: Simulation, *, progress: Progress | None = None) -> Simulation:
    """The run with the contrast threshold that its option `target_rate` asks for, if it is set.

    Raises:
        ConfigError, InputError: as `match_rate`.
    """
    target_hz = simulation.settings.run.target_rate
    if target_hz is None:
        return simulation
    simulation, match = match_rate(simulation, target_hz, progress=progress)
    if progress is not None:
        progress.announce(
            f"rate     {match.rate_hz:,.0f} events per second in the first second, with contrast "
            f"threshold {match.contrast_threshold:.4g} ({match.steps} trials)"
        )
    return simulation


def match_rate(
    simulation: Simulation,
    target_hz: float,
    *,
    seconds: float = 1.0,
    progress: Progress | None = None,
) -> tuple[Simulation, RateMatch]:
    """A simulation whose contrast threshold makes its start fire at a wanted rate.

    Args:
        simulation: the run; its frames are read several times.
        target_hz: events per second of the whole sensor, above 0.
        seconds: how much of the clip, from its start, is simulated to measure the rate.
        progress: told of every trial.

    Returns:
        The same run with another threshold (ON and OFF keep their ratio), and what was found.

    Raises:
        ConfigError: the target or the duration is not above 0, or the simulator has no threshold.
        InputError: the source can be read only once, or no threshold gives that rate.
    """
    check_range("target_rate", target_hz, 1e-9)
    check_range("seconds", seconds, 1e-6)
    if simulation.video.is_live:
        raise InputError(
            "target_rate needs frames that can be read again, and this is a live source; "
            "record it first, or set contrast_threshold"
        )
    contrast_threshold_of(simulation.settings.simulate)

    def with_threshold(threshold: float) -> Simulation:
        config = with_contrast_threshold(simulation.settings.simulate, threshold)
        settings = dataclasses.replace(simulation.settings, simulate=config)
        return dataclasses.replace(simulation, settings=settings)

    trials = itertools.count(1)

    def rate_of(threshold: float) -> float:
        if progress is not None:
            progress.advance("target rate", next(trials), MAX_STEPS)
        return measure_rate(with_threshold(threshold), seconds)

    match = threshold_for_rate(rate_of, target_hz)
    return with_threshold(match.contrast_threshold), match


def threshold_for_rate(rate_of: Callable[[float], float], target_hz: float) -> RateMatch:
    """The threshold at which a falling function takes a value, by bisection of its logarithm.

    Args:
        rate_of: threshold → events per second.
        target_hz: rate wanted, events per second.

    Raises:
        InputError: the nearest rate found differs by more than a tenth.
    """
    match = find_threshold(rate_of, target_hz)
    rate_hz = match.ratio * target_hz
    if abs(match.ratio - 1) > UNREACHED:
        raise InputError(
            f"no contrast threshold of {LOWEST:g}..{HIGHEST:g} gives {target_hz:,.0f} events per "
            f"second; the nearest is {rate_hz:,.0f} at {match.threshold:.3g}. Choose "
            "a rate nearer to that, or change the noise, which no threshold removes"
        )
    return RateMatch(match.threshold, rate_hz, match.steps)


def measure_rate(simulation: Simulation, seconds: float) -> float:
    """Events per second over the first `seconds` of a run.

    Raises:
        InputError: there is one frame only, so no time passes.
    """
    events, first_us, last_us = 0, None, 0
    for frame, packet in simulation.steps():
        first_us = frame.t_us if first_us is None else first_us
        events += len(packet)
        last_us = frame.t_us
        if last_us - first_us >= seconds * MICROSECONDS:
            break
    if first_us is None or last_us == first_us:
        raise InputError("target_rate needs at least two frames; this source has fewer")
    return events * MICROSECONDS / (last_us - first_us)
