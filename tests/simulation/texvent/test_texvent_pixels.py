"""The fast pixels fire exactly as the definition does: any type of frames and option."""

import itertools
import tracemalloc
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.examples import examples
from tests.simulation.references import definitions, in_both_forms

from texvent.brightness import HIGHEST_INTENSITY
from texvent.errors import InputError
from texvent.events import EventStream
from texvent.frames import Frame
from texvent.simulation.texvent.simulator import TexventConfig, TexventSimulator

TYPES = (np.uint8, np.uint16, np.float32, np.float64)
CHECKED = examples(60)
NOISY = {"noise_rate_hz": 20.0, "noise_intensity": 150.0}
OPTIONS = [
    {"cache": cache, "residual_decay_hz": decay, "reset": reset, "timestamp_rule": stamp}
    | {"multi_event": multi_event}
    for cache, decay, reset, stamp, multi_event in itertools.product(
        ("local", "global", "none"),
        (0.0, 5.0),
        ("current", "step"),
        ("eq7", "random", "linear", "end"),
        (False, True),
    )
    if not (decay and cache != "global") and not (multi_event and stamp == "eq7")
]
FORGETFUL = [
    one
    for one in OPTIONS
    if one["cache"] in ("local", "none") and one["timestamp_rule"] != "random"
]
switches = st.sampled_from(OPTIONS)
noises = st.sampled_from(["adaptive", "gaussian", "random", "none"])
seeds = st.integers(0, 2**63 - 1)
# Fewer pixels than a run of 64, whole runs and a rest, more than one tile of 4096; odd widths.
SHAPES = ((1, 1), (3, 7), (8, 8), (5, 37), (64, 2), (65, 63), (71, 129))


def frame(levels, dtype, t_us, *, is_source=True) -> Frame:
    scaled = levels * 257 if dtype == np.uint16 else levels
    return Frame(scaled.astype(dtype), t_us, is_source)


@st.composite
def clips(draw, min_frames=2):
    """Clips of which a stated share of the pixels moves; types of frames mixed in some."""
    rng = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    shape, count = draw(st.sampled_from(SHAPES)), draw(st.integers(min_frames, 6))
    share, size = draw(st.sampled_from([0.002, 0.1, 1.0])), draw(st.sampled_from([4, 15, 60]))
    types = draw(st.one_of(st.just(TYPES), st.sampled_from(TYPES).map(lambda one: (one,))))
    levels, frames, t_us = rng.integers(0, 256, shape).astype(np.float64), [], -500
    for _ in range(count):
        moves = (rng.random(shape) < share) * rng.normal(0, size, shape)
        levels = np.clip(levels + moves, 0, 255)
        t_us += int(rng.integers(1, 40_000))
        is_source = not frames or bool(rng.random() < 0.4)
        frames.append(frame(levels, rng.choice(types), t_us, is_source=is_source))
    return frames


def simulate(frames, *, seed=0, **options) -> EventStream:
    simulator = TexventSimulator(TexventConfig(**options), seed=seed)
    return EventStream.concat([simulator.step(one) for one in frames])


def defined(frames, **options) -> EventStream:
    with definitions():
        return simulate(frames, **options)


def assert_forms_agree(frames, **options) -> EventStream:
    expected, events = in_both_forms(lambda: simulate(frames, **options))
    assert events.equals(expected)
    return expected


@examples(150)
@given(clips(), switches, noises, st.sampled_from([0.01, 0.2, 2.0]), seeds)
def test_pixels_equal_the_definition(frames, options, noise, threshold, seed):
    options = {"noise": noise, **NOISY, **options}
    assert_forms_agree(frames, contrast_threshold=threshold, seed=seed, **options)


@pytest.mark.parametrize("dtype", [np.uint8, np.uint16, np.float32])
@pytest.mark.parametrize(("low", "high"), [(0, 7), (70, 90), (100, 101), (3, 255)])
def test_pixels_at_the_threshold_itself_fire_in_both_forms(low, high, dtype):
    """δ is the change of one pair of levels, then the next float64 above and below it."""
    first, second = (frame(np.full((9, 9), float(level)), dtype, level) for level in (low, high))
    change = float(np.log(20.0 + high) - np.log(20.0 + low))
    counts = [
        len(assert_forms_agree([first, second], contrast_threshold=threshold, noise="none"))
        for threshold in (np.nextafter(change, 0), change, np.nextafter(change, 10))
    ]
    assert counts == [81, 81, 0]


@examples(100)
@given(
    st.floats(0, 2.0**29, width=32),
    st.sampled_from([1e-4, 0.2, 10.0]),
    st.sampled_from([1e-6, 30.0, 1e6]),
    st.booleans(),
)
def test_the_scan_misses_no_float_beside_a_trigger_level(intensity, threshold, balance, is_on):
    """The 201 float32 numbers around the level at which a pixel fires, ON and OFF."""
    factor = np.exp(threshold if is_on else -threshold)
    level = (balance + float(intensity)) * factor - balance
    near = np.float32(np.clip(level, 1e-38, 0.99 * HIGHEST_INTENSITY))
    bits = near.view(np.int32) + np.arange(-100, 101, dtype=np.int32)
    around = np.abs(bits.view(np.float32))
    around[~np.isfinite(around)] = 1.0
    before = Frame(np.full((1, around.size), intensity, np.float32), 0)
    after = Frame(around[None], 1000)
    assert_forms_agree([before, after], contrast_threshold=threshold, balance=balance, noise="none")


@pytest.mark.parametrize(
    ("bad", "place"), [(np.nan, 0), (np.inf, 63), (-1.0, 64), (np.nan, 4100), (-1.0, 4222)]
)
def test_an_impossible_intensity_is_found_wherever_it_is(bad, place):
    """In a whole run, in the rest after it, and in the last tile; the frame is then forgotten."""
    rng = np.random.default_rng(0)
    good = [Frame(rng.uniform(0, 255, (41, 103)).astype(np.float32), t) for t in (0, 10, 30)]
    broken = good[1].pixels.copy()
    broken.reshape(-1)[place] = bad
    simulator = TexventSimulator()
    packets = [simulator.step(one) for one in good[:2]]
    with pytest.raises(InputError, match=r"1 pixel.s. that are NaN, infinite or negative"):
        simulator.step(Frame(broken, 20))
    packets.append(simulator.step(good[2]))
    assert EventStream.concat(packets).equals(defined(good))


@pytest.mark.parametrize("dtype", [np.uint8, np.uint16, np.float32])
def test_no_array_as_large_as_a_frame_is_made_after_the_first(dtype):
    """Where little fires and references are intensities."""
    still = np.full((900, 1000), 100.0)
    moved = still.copy()
    moved[::90, ::100] = 160
    config = replace(TexventSimulator.presets["paper"], noise="none")
    simulator = TexventSimulator(config)
    for k in range(3):
        simulator.step(frame(moved if k % 2 else still, dtype, 10 * k))
    last = frame(moved, dtype, 100)
    tracemalloc.start()
    try:
        assert len(simulator.step(last)) == 100
        peak = tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()
    assert peak < 100_000


@CHECKED
@given(clips(min_frames=3), st.sampled_from(FORGETFUL), seeds, st.data())
def test_local_cache_needs_no_state_at_a_source_frame(frames, options, seed, data):
    """So a clip can be cut at source frames, but for draws, which count from its first frame."""
    cut = data.draw(st.integers(1, len(frames) - 1))
    frames[cut] = Frame(frames[cut].pixels, frames[cut].t_us, is_source=True)
    options = {"seed": seed, "noise": "none", **options}
    parts = [simulate(frames[: cut + 1], **options), simulate(frames[cut:], **options)]
    assert EventStream.concat(parts).equals(simulate(frames, **options))
