"""Constants of simulated sensors, found again from events alone: the table of docs/calibration.md.

    python -m texvent_lab.measure.calibration

Every setting is recorded with three seeds, which are three specimens of the sensor.
"""

from __future__ import annotations

import dataclasses
from collections import defaultdict
from collections.abc import Iterator
from typing import Any

from texvent.calibrate.estimates import Estimate
from texvent.calibrate.events_only.flicker import measure_flicker
from texvent.calibrate.events_only.static_scene import measure_static_scene
from texvent.sensor import SensorSize
from texvent.simulate.physical.config import PhysicalConfig
from texvent_lab.bench.document import markdown_table
from texvent_lab.measure.known_scenes import simulate_flicker, simulate_static

START = PhysicalConfig(gamma=1.0, noise_scale=1.0)
SEEDS = (1, 2, 3)
REST_SIZE, REST_S, WARM_UP_S = SensorSize(128, 96), 10.0, 4.0
FLICKER_SIZE, FLICKER_HZ, CYCLES = SensorSize(40, 30), 5.0, 20
AT_REST: tuple[dict[str, Any], ...] = (
    {
        "noise_curve": "128:0.5", "noise_on_fraction": 0.7, "noise_decades": 0.15,
        "leak_rate_hz": 0.5,
    },
    {"noise_curve": "128:2", "refractory_period_us": 300, "leak_rate_hz": 0.0},
    {
        "noise_curve": "128:5", "noise_on_fraction": 0.3, "noise_decades": 0.3, "leak_rate_hz": 2.0,
        "hot_pixel_fraction": 0.005, "hot_pixel_rate_hz": 200.0, "refractory_period_us": 1000,
    },
    {
        "noise_curve": "128:0.1", "leak_rate_hz": 3.0, "leak_rate_decades": 0.15,
        "hot_pixel_fraction": 0.002, "hot_pixel_rate_hz": 40.0,
    },
)  # fmt: skip
FLICKERING: tuple[tuple[float, dict[str, Any]], ...] = (
    (4.0, {}),
    (10.0, {"contrast_threshold": 0.15, "on_off_ratio": 1.4, "cutoff_hz": 100.0,
            "refractory_period_us": 100, "threshold_sigma": 0.02}),
    (6.0, {"contrast_threshold": 0.3, "on_off_ratio": 0.7, "cutoff_hz": 60.0,
           "refractory_period_us": 1000, "threshold_sigma": 0.05}),
    (5.0, {"contrast_threshold": 0.25, "cutoff_hz": 500.0, "refractory_period_us": 10}),
    (4.0, {"noise_curve": "128:2"}),
)  # fmt: skip
"""Bright over dark, and options."""


def main() -> None:
    """Print the table."""
    ratios: dict[tuple[str, str], list[float]] = defaultdict(list)
    held: dict[tuple[str, str], list[bool]] = defaultdict(list)
    truths: dict[tuple[str, str], set[float]] = defaultdict(set)
    for scene, true, one in _found():
        key = scene, one.name
        truths[key].add(true)
        ratios[key].append(one.value / true)
        held[key].append(one.low <= true <= one.high)
    rows = [
        (
            *key,
            ", ".join(f"{value:g}" for value in sorted(truths[key])),
            f"{min(found):.3f}..{max(found):.3f}",
            f"{sum(held[key])} of {len(held[key])}",
        )
        for key, found in ratios.items()
    ]
    titles = ("scene", "constant", "true", "found over true", "intervals that hold it")
    print(markdown_table(titles, rows))


def _found() -> Iterator[tuple[str, float, Estimate]]:
    """Scene, true value and estimate of everything that was found."""
    for seed in SEEDS:
        for options in AT_REST:
            config = dataclasses.replace(START, **options)
            yield from _at_rest(config, seed)
        for ratio, options in FLICKERING:
            config = dataclasses.replace(START, **{"noise_curve": "128:0.05", **options})
            events = simulate_flicker(
                config, FLICKER_SIZE, FLICKER_HZ, ratio=ratio, number=CYCLES, seed=seed
            )
            flicker = measure_flicker(events, START, hz=FLICKER_HZ, ratio=ratio)
            for one in flicker.found:
                yield "flicker", getattr(config, one.name), one


def _at_rest(config: PhysicalConfig, seed: int) -> Iterator[tuple[str, float, Estimate]]:
    events = simulate_static(config, REST_SIZE, REST_S + WARM_UP_S, seed=seed)
    events = events.cut(round(WARM_UP_S * 1e6), round((REST_S + WARM_UP_S) * 1e6))
    scene = measure_static_scene(events, START)
    for one in scene.found:
        if one.name == "noise_rate_hz":
            yield "static", float(config.noise_curve.partition(":")[2]), one
        elif one.name == "hot_pixel_fraction":
            # How many pixels are hot is a matter of chance; those of this specimen are counted.
            continue
        elif one.name == "hot_pixel_rate_hz" and config.hot_pixel_fraction == 0:
            raise RuntimeError("pixels pass for hot, none is")
        elif getattr(config, one.name) > 0:
            yield "static", float(getattr(config, one.name)), one


if __name__ == "__main__":
    main()
