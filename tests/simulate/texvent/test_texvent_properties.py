"""Properties of every clip and every combination of switches."""

import copy
import importlib
import itertools
from unittest import mock

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st
from tests.simulate.references import definitions

from texvent.brightness import balanced_log
from texvent.errors import ConfigError
from texvent.events import EventStream
from texvent.simulate.texvent.simulator import TexventConfig, TexventSimulator
from texvent.video import Frame

CHECKED = settings(max_examples=60)
NOISY = {"noise_rate_hz": 50.0, "noise_intensity": 150.0}


def is_possible(options) -> bool:
    try:
        TexventConfig(**options)
    except ConfigError:
        return False
    return True


SWITCHES = [
    options
    for values in itertools.product(
        ("local", "global", "none"),
        (0.0, 5.0),
        ("current", "step"),
        (False, True),
        ("eq7", "random", "linear", "end"),
    )
    if is_possible(
        options := dict(
            zip(
                ("cache", "residual_decay_hz", "reset", "multi_event", "timestamp_rule"),
                values,
                strict=True,
            )
        )
    )
]
switches = st.sampled_from(SWITCHES)
noises = st.sampled_from(["adaptive", "gaussian", "random", "none"])
seeds = st.integers(0, 2**63 - 1)


@st.composite
def clips(draw, min_frames=2):
    """Small clips: any pixel type, irregular times, source and intermediate frames mixed."""
    rng = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    count = draw(st.integers(min_frames, 8))
    shape = (count, draw(st.integers(1, 5)), draw(st.integers(1, 6)))
    steps = np.cumsum(rng.normal(0, draw(st.sampled_from([5, 40])), shape), axis=0)
    levels = np.clip(rng.uniform(0, 255, shape[1:]) + steps, 0, 255)
    dtype = draw(st.sampled_from([np.uint8, np.uint16, np.float32, np.float64]))
    scaled = levels * 257 if dtype == np.uint16 else levels
    times = rng.integers(-1000, 1000) + np.cumsum(rng.integers(1, 15_000, count))
    sources = [True, *(rng.random(count - 1) < 0.5)]
    return [Frame(scaled[k].astype(dtype), int(times[k]), bool(sources[k])) for k in range(count)]


def simulate(frames, *, seed=0, **options) -> EventStream:
    simulator = TexventSimulator(TexventConfig(**options), seed=seed)
    return EventStream.concat([simulator.step(frame) for frame in frames])


def rows(events: EventStream) -> list[tuple[int, int, int, int]]:
    return list(
        zip(events.t.tolist(), events.y.tolist(), events.x.tolist(), events.p.tolist(), strict=True)
    )


@CHECKED
@given(clips(), switches, noises, seeds)
def test_convention_packets_are_half_open_sorted_and_inside_the_sensor(
    frames, options, noise, seed
):
    simulator = TexventSimulator(TexventConfig(noise=noise, **NOISY, **options), seed=seed)
    assert len(simulator.step(frames[0])) == 0
    for earlier, later in itertools.pairwise(frames):
        packet = simulator.step(later)
        assert packet.size == later.size
        assert rows(packet) == sorted(rows(packet))
        if len(packet):
            first, stop = packet.time_range
            assert earlier.t_us <= first < stop <= later.t_us


@CHECKED
@given(clips(min_frames=3), switches, noises, seeds, st.data())
def test_splitting_the_stream_changes_nothing_when_state_is_carried(
    frames, options, noise, seed, data
):
    simulator = TexventSimulator(TexventConfig(noise=noise, **NOISY, **options), seed=seed)
    cut = data.draw(st.integers(1, len(frames) - 1))
    packets = [simulator.step(frame) for frame in frames[:cut]]
    carried = copy.deepcopy(simulator)
    simulator.step(Frame(frames[cut].pixels, frames[cut].t_us, False))  # must not disturb the copy
    packets += [carried.step(frame) for frame in frames[cut:]]
    whole = simulate(frames, seed=seed, noise=noise, **NOISY, **options)
    assert EventStream.concat(packets).equals(whole)


@CHECKED
@given(
    clips(min_frames=3),
    st.sampled_from([one for one in SWITCHES if one["cache"] in ("local", "none")]),
    noises,
    seeds,
    st.data(),
)
def test_local_cache_needs_no_state_at_a_source_frame(frames, options, noise, seed, data):
    """So a clip can be cut at source frames and simulated in parallel, noise included."""
    cut = data.draw(st.integers(1, len(frames) - 1))
    frames[cut] = Frame(frames[cut].pixels, frames[cut].t_us, is_source=True)
    options = {"seed": seed, "noise": noise, **NOISY, **options}
    parts = [simulate(frames[: cut + 1], **options), simulate(frames[cut:], **options)]
    assert EventStream.concat(parts).equals(simulate(frames, **options))


@CHECKED
@given(
    clips(),
    st.sampled_from([one for one in SWITCHES if one["timestamp_rule"] != "random"]),
    st.integers(-(10**15), 10**15),
)
def test_shifting_a_clip_in_time_shifts_its_events(frames, options, shift_us):
    """Without noise: noise is keyed by the time itself, so that clips can be cut anywhere."""
    moved = [Frame(frame.pixels, frame.t_us + shift_us, frame.is_source) for frame in frames]
    events = simulate(frames, noise="none", **options)
    shifted = simulate(moved, noise="none", **options)
    assert np.array_equal(shifted.t, events.t + shift_us)
    for column in "xyp":
        assert np.array_equal(getattr(shifted, column), getattr(events, column))


@CHECKED
@given(clips(), switches)
def test_no_change_gives_no_events(frames, options):
    still = [Frame(frames[0].pixels, frame.t_us, frame.is_source) for frame in frames]
    assert len(simulate(still, noise="none", **options)) == 0


@CHECKED
@given(clips(), switches)
def test_negated_contrast_swaps_on_and_off(frames, options):
    """The brightness itself is negated: negated intensities would round differently."""
    options = options | {"noise": "none"}
    with definitions():
        events = simulate(frames, **options)
    module = importlib.import_module("tests.simulate.references.texvent")
    negative = mock.patch.object(module, "balanced_log", lambda *given: -balanced_log(*given))
    with definitions(), negative:
        negated = simulate(frames, **options)
    swapped = EventStream(negated.x, negated.y, negated.t, 1 - negated.p, negated.size)
    assert swapped.equals(events.without_label())
