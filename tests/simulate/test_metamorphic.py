"""Relations between runs: the clip changed, or the way to go through it, and the events known."""

from __future__ import annotations

import dataclasses
import itertools
import sys
from collections import Counter
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import texvent
from texvent._registry import INTERPOLATORS, SIMULATORS
from texvent.events import EventStream
from texvent.runtime import threads

HEIGHT, WIDTH, COUNT, STEP_US = 18, 24, 5, 41_667
TIMES_US = STEP_US * np.arange(COUNT)


def waves(height: int = HEIGHT, width: int = WIDTH, count: int = COUNT) -> Any:
    """Waves that move to the left by 1 px per frame, [N, H, W] uint8, and their vectors."""
    index, y, x = np.ogrid[:count, :height, :width]
    levels = 125 + 120 * np.sin((x + index) / 2.3) * np.cos((y + 0.3 * x + 0.3 * index) / 3.1)
    vectors = np.broadcast_to(np.float32([-1, 0]), (count, height, width, 2))
    return np.round(levels).astype(np.uint8), {"motion": vectors, "motion_back": -vectors}


CLIP, VECTORS = waves()
FLICKERING = np.stack([CLIP[0]] * COUNT)
FLICKERING[:, :9] = CLIP[:, :9]
FLICKERING = np.round(
    (60 + 0.4 * FLICKERING) * np.array([1, 0.85, 1.05, 0.9, 1])[:, None, None]
).astype(np.uint8)
"""Of which half moves, and whose gain jumps."""

MODELS = {name: SIMULATORS.load(name) for name in SIMULATORS.builtin}
SOURCES: dict[str, dict[str, Any]] = {
    "none": {},
    "blend": {},
    "flow": {},
    "motion": VECTORS,
}
"""Interpolators of ordinary frames, and what they need beside them."""
OTHERS = {"exact", "rife"}
"""One draws no frames but instants, the other needs weights."""
LOUD = {
    "noise_rate_hz": 20.0,
    "noise_intensity": 120.0,
    "shot_noise_rate_hz": 20.0,
    "leak_rate_hz": 5.0,
    "threshold_sigma": 0.03,
    "hot_pixel_fraction": 0.1,
    "initial_phase": "random",
}
"""Everything random, for the models that have it."""
QUIET = {
    "noise": "none",
    "noise_scale": 0.0,
    "shot_noise_rate_hz": 0.0,
    "threshold_sigma": 0.0,
    "leak_rate_decades": 0.0,
    "hot_pixel_fraction": 0.0,
    "initial_phase": "zero",
    # A scan knows left from right.
    "scan_period_ns": 0,
}
"""Nothing random, nor anything that depends on the place."""


def has(config: Any, options: dict[str, Any]) -> dict[str, Any]:
    """The options that a model has."""
    return {name: value for name, value in options.items() if hasattr(config, name)}


def loud(name: str, preset: str) -> dict[str, Any]:
    config = MODELS[name].presets[preset]
    options = has(config, LOUD)
    if "noise_curve" in vars(config):
        options["noise_scale"] = 20.0
    if "constants" in vars(config):
        options["constants"] = str(config.k._replace(k6=1e-3))
    return options


def quiet(name: str, preset: str) -> dict[str, Any]:
    config = MODELS[name].presets[preset]
    options = has(config, QUIET)
    if "noise" in options:
        del options["noise_scale"]
    if "constants" in vars(config):
        options["constants"] = str(config.k._replace(k3=0.0, k6=0.0))
    return options


def simulate(frames: Any = CLIP, t_us: Any = TIMES_US, **options: Any) -> EventStream:
    source = SOURCES[options.get("interpolate", "none")]
    given = {"seed": 4, "label_noise": True, "max_intermediate": 6, "progress": False}
    if options.get("interpolate", "none") == "none":
        del given["max_intermediate"]
    options = {**given, **source, **options}
    return texvent.simulate(frames, t_us=t_us, **options)


def rows(events: EventStream, place: Callable[..., Any] = lambda x, y: (x, y)) -> list[Any]:
    """All columns of every event, sorted, at places that a function of x and y gives."""
    columns = events.columns()
    columns["x"], columns["y"] = place(events.x.astype(int), events.y.astype(int))
    return sorted(zip(*(column.tolist() for column in columns.values()), strict=True))


FIRST = {name: next(iter(model.presets)) for name, model in MODELS.items()}
RUNS = [
    *((name, preset, "none") for name, model in MODELS.items() for preset in model.presets),
    *((name, FIRST[name], "flow") for name in MODELS),
    *(("texvent", "accurate", one) for one in SOURCES if one not in ("none", "flow")),
]
"""Every preset, every model with flow, which some fuse with it, and every interpolator."""
runs = pytest.mark.parametrize(("name", "preset", "interpolate"), RUNS)


def test_no_interpolator_is_forgotten():
    assert set(SOURCES) | OTHERS == set(INTERPOLATORS.builtin)


WIDER: dict[str, tuple[Callable[[Any], Any], dict[str, Any]]] = {
    "16 bits": (lambda frames: frames.astype(np.uint16) * np.uint16(257), {}),
    "floats": (lambda frames: frames.astype(np.float32), {}),
    "shares of white": (lambda frames: frames / 255, {"white_level": 1.0}),
}


@runs
def test_the_same_levels_of_any_type_give_the_same_events(name, preset, interpolate):
    options = {"simulator": name, "preset": preset, "interpolate": interpolate}
    options |= loud(name, preset)
    for frames, deflicker in ((CLIP, False), (FLICKERING, True)):
        if deflicker and interpolate == "motion":
            continue  # vectors do not explain a gain
        events = simulate(frames, deflicker=deflicker, **options)
        assert (events != simulate(frames, **options)) == deflicker
        for change, more in WIDER.values():
            assert simulate(change(frames), deflicker=deflicker, **options, **more) == events


@runs
def test_shifting_the_clip_shifts_the_events_and_nothing_else(name, preset, interpolate):
    options = {"simulator": name, "preset": preset, "interpolate": interpolate}
    options |= loud(name, preset)
    if name == "texvent" and preset != "paper":
        options["timestamp_rule"] = "random"
    events = simulate(**options)
    assert len(events) > 100
    for shift_us in (7_000_001, -3_000_017, 10**12, 10**15):
        shifted = simulate(t_us=TIMES_US + shift_us, **options)
        moved = dataclasses.replace(events, t=events.t + shift_us)
        assert shifted == moved


@pytest.mark.parametrize(
    ("name", "preset", "interpolate"), [run for run in RUNS if run[2] != "motion"]
)
def test_frames_given_one_by_one_give_the_events_of_the_clip(name, preset, interpolate):
    options = {"simulator": name, "preset": preset, "interpolate": interpolate, "seed": 4}
    options |= {"deflicker": True, "label_noise": True, **loud(name, preset)}
    whole = simulate(FLICKERING, **options)
    with texvent.EventCamera((WIDTH, HEIGHT), **options) as camera:
        for _ in range(2):
            packets = [camera.step(*one) for one in zip(FLICKERING, TIMES_US, strict=True)]
            assert EventStream.concat([*packets, camera.finish()]) == whole
            for start_us, packet in zip(TIMES_US - STEP_US, packets, strict=True):
                assert ((packet.t >= start_us) & (packet.t < start_us + STEP_US)).all()
            camera.reset()


@pytest.mark.parametrize(("name", "interpolate"), sorted({(run[0], run[2]) for run in RUNS}))
def test_a_run_from_a_frame_on_is_that_of_the_frames_from_there(name, interpolate):
    options = {"simulator": name, "interpolate": interpolate}
    late_us = TIMES_US + 9_000_000
    part = simulate(t_us=late_us, start=2 * STEP_US / 1e6, **options)
    more = {key: one[2:] for key, one in SOURCES[interpolate].items()}
    assert part == simulate(CLIP[2:], late_us[2:], **options, **more)
    begun = simulate(t_us=late_us, stop=3 * STEP_US / 1e6, **options)
    assert begun == simulate(t_us=late_us, **options).cut(0, late_us[2])


# Turned: the frames, their vectors, and the place of an event.
TURNED = {
    "left-right": (lambda one: one[:, :, ::-1], (-1, 1), lambda x, y: (WIDTH - 1 - x, y)),
    "up-down": (lambda one: one[:, ::-1], (1, -1), lambda x, y: (x, HEIGHT - 1 - y)),
    "transposed": (lambda one: one.swapaxes(1, 2), (1, 1), lambda x, y: (y, x)),
}
EXACT = {"none", "blend"}
"""Interpolators that do not know left from right; others search from the left, or round places."""


@runs
@pytest.mark.parametrize("way", TURNED)
def test_a_turned_clip_gives_the_turned_events(name, preset, interpolate, way):
    turn, signs, place = TURNED[way]
    options = {"simulator": name, "preset": preset, "interpolate": interpolate}
    options |= quiet(name, preset)
    expected = rows(simulate(**options), place)
    vectors = {key: turn(one) * np.float32(signs) for key, one in SOURCES[interpolate].items()}
    if way == "transposed":
        vectors = {key: one[..., ::-1] for key, one in vectors.items()}
    found = rows(simulate(turn(CLIP), **options, **vectors))
    assert len(expected) > 100
    if interpolate in EXACT:
        assert found == expected
        return
    counts = [Counter((x, y, p) for x, y, _, p, _ in one) for one in (expected, found)]
    assert (counts[0] & counts[1]).total() > 0.98 * max(len(expected), len(found))


@pytest.mark.parametrize(
    ("name", "preset", "interpolate"), [run for run in RUNS if run[2] in EXACT]
)
def test_at_twice_the_size_each_pixel_has_its_events_four_times(name, preset, interpolate):
    options = {"simulator": name, "preset": preset, "interpolate": interpolate}
    options |= quiet(name, preset)
    small = simulate(**options)
    places = itertools.product((0, 1), repeat=2)
    parts = [rows(small, lambda x, y, i=i, j=j: (2 * x + i, 2 * y + j)) for i, j in places]
    large = simulate(CLIP.repeat(2, 1).repeat(2, 2), **options)
    assert rows(large) == sorted(itertools.chain(*parts))


@runs
def test_the_seed_decides_everything_random(name, preset, interpolate):
    options = {"simulator": name, "preset": preset, "interpolate": interpolate}
    events = simulate(**options, **loud(name, preset))
    assert simulate(**options, **loud(name, preset)) == events
    assert simulate(**options, **loud(name, preset), seed=5) != events
    options |= quiet(name, preset)
    assert simulate(**options) == simulate(**options, seed=5)


THREADED = [
    *((name, "none") for name in ("physical", "v2e", "voltmeter")),
    *((name, "flow") for name in MODELS),
    ("texvent", "motion"),
]
"""Models and interpolators whose kernels share a frame out."""


@pytest.mark.parametrize(("name", "interpolate"), THREADED)
def test_any_number_of_threads_gives_the_same_events_and_has_work(name, interpolate, monkeypatch):
    clip, vectors = waves(100, 150, 3)
    source = vectors if interpolate == "motion" else {}
    options = {"simulator": name, "interpolate": interpolate, "fixed_count": 4, **source}
    if interpolate == "none":
        del options["fixed_count"]
    options |= loud(name, FIRST[name])
    streams = [simulate(clip, TIMES_US[:3], **options)]
    shared: list[int] = []

    def run_parts(work: Any, parts: Any) -> Any:
        shared.append(len(parts))
        return threads.run_parts(work, parts)

    for module in [one for key, one in sys.modules.items() if key.startswith("texvent.")]:
        if getattr(module, "run_parts", None) is threads.run_parts and module is not threads:
            monkeypatch.setattr(module, "run_parts", run_parts)
            if hasattr(module, "PIXELS_PER_THREAD"):
                monkeypatch.setattr(module, "PIXELS_PER_THREAD", 512)
    for count in (1, 3):
        monkeypatch.setenv(threads.THREADS_VARIABLE, str(count))
        streams.append(simulate(clip, TIMES_US[:3], **options))
        assert max(shared, default=1) >= count
    assert streams[0] == streams[1] == streams[2]
