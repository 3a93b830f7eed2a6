"""Clips of a batch: ESIM's events, arrays that equal the representations of events, and draws."""

import itertools
from typing import Any

import numpy as np
import pytest

from texvent.errors import InputError
from texvent.events import EventStream
from texvent.frames import Frame
from texvent.represent.event_frame import event_frame
from texvent.represent.voxel_grid import voxel_e2vid
from texvent.sensor import SensorSize
from texvent.simulation.clips import pixels as columns_of
from texvent.simulation.clips.pixels import ClipOutputs, ClipPixels, byte_brightness, check_clips
from texvent.simulation.clips.scan import TILE, simulate_on_cpu
from texvent.simulation.esim.config import EsimConfig
from texvent.simulation.esim.simulator import EsimSimulator
from texvent.simulation.random.draws import frame_keys

CLIPS, INTERVALS, HEIGHT, WIDTH = 3, 6, 12, 16
LOG_EPS = 0.05
ALL = ClipOutputs(bins=4, intervals_per_window=2, counts=True, latest=True, events=True)


def some_clips(
    height: int = HEIGHT, width: int = WIDTH, *, longer_us: int = 0
) -> tuple[np.ndarray[Any, Any], np.ndarray[Any, Any]]:
    """[B, T + 1, H, W] uint8 that wanders but for a pause, perhaps a longer one, and times."""
    rng = np.random.default_rng(5)
    steps = rng.normal(0, 25, (CLIPS, INTERVALS + 1, height, width)).cumsum(axis=1)
    steps[:, 3] = steps[:, 2]
    gaps = rng.integers(900, 4000, (CLIPS, INTERVALS))
    gaps[:, 2] += longer_us
    times_us = np.concatenate([np.zeros((CLIPS, 1), np.int64), gaps.cumsum(axis=1)], axis=1)
    return np.clip(90 + steps, 0, 255).astype(np.uint8), times_us


def pixels_of(*, gamma: float = 1.0, log_eps: float = LOG_EPS, **columns: float) -> ClipPixels:
    """Pixels of all clips alike, but for their keys; columns by name."""
    numbers = np.zeros((CLIPS, 8))
    for name, value in {"THRESHOLD_ON": 0.3, "THRESHOLD_OFF": 0.2, **columns}.items():
        numbers[:, getattr(columns_of, name)] = value
    keys = frame_keys(4, np.arange(CLIPS))
    return ClipPixels(numbers, keys, byte_brightness(gamma, log_eps))


EVERYTHING: dict[str, Any] = {
    "MISMATCH": 0.1, "NOISE": 0.1, "HOT_FRACTION": 0.1, "HOT_NOISE": 0.4, "REFRACTORY_US": 700,
}  # fmt: skip


def events_of(made: Any, size: tuple[int, int] = (HEIGHT, WIDTH)) -> list[EventStream]:
    """The events of each clip."""
    found = []
    for first, last in itertools.pairwise([0, *made.ends.tolist()]):
        cell, p = made.words[first:last] >> 1, made.words[first:last] & 1
        t_us, pixel = np.divmod(cell, size[0] * size[1])
        y, x = np.divmod(pixel, size[1])
        found.append(
            EventStream(
                x.astype(np.uint16), y.astype(np.uint16), t_us, p.astype(np.uint8),
                SensorSize(size[1], size[0]),
            )
        )  # fmt: skip
    return found


TILED = (3, TILE // 2 + 3)
"""Height and width of clips of two tiles, the last one of no whole words."""


@pytest.mark.parametrize("longer_us", [0, 2_000_000, 2**31 - 30_000])
@pytest.mark.parametrize(("refractory_us", "size"), [(0, (HEIGHT, WIDTH)), (900, TILED)])
def test_without_noise_the_events_are_those_of_esim(refractory_us, size, longer_us):
    """Also late in the longest clips."""
    frames, times_us = some_clips(*size, longer_us=longer_us)
    made = simulate_on_cpu(frames, times_us, pixels_of(REFRACTORY_US=refractory_us), ALL)
    config = EsimConfig(
        contrast_threshold_on=0.3, contrast_threshold_off=0.2, log_eps=LOG_EPS,
        refractory_period_us=refractory_us,
    )  # fmt: skip
    for clip, events in enumerate(events_of(made, size)):
        simulator = EsimSimulator(config)
        frame_by_frame = zip(frames[clip], times_us[clip].tolist(), strict=True)
        expected = EventStream.concat(simulator.step(Frame(*one)) for one in frame_by_frame)
        assert len(events) > 200
        assert np.array_equal(events.to_structured()[["x", "y", "t", "p"]],
                              expected.to_structured()[["x", "y", "t", "p"]])  # fmt: skip


@pytest.mark.parametrize(
    ("columns", "size"), [({}, (HEIGHT, WIDTH)), (EVERYTHING, TILED)], ids=["plain", "everything"]
)
def test_arrays_are_the_representations_of_the_events(columns, size):
    frames, times_us = some_clips(*size)
    made = simulate_on_cpu(frames, times_us, pixels_of(**columns), ALL)
    for clip, events in enumerate(events_of(made, size)):
        edges = times_us[clip, :: ALL.intervals_per_window].tolist()
        assert len(events) == made.counts[clip].sum()
        for window, (start, stop) in enumerate(itertools.pairwise(edges)):
            part = events.cut(start, stop)
            assert np.array_equal(made.grids[clip, window], voxel_e2vid(part, bins=ALL.bins))
            assert np.array_equal(made.counts[clip, window], event_frame(part, "count"))
            latest = np.full((2, *size), -1)
            latest[part.p, part.y, part.x] = part.t - start
            assert np.array_equal(made.latest[clip, window], latest)


def test_events_that_do_not_fit_into_the_first_room_are_found_all_the_same():
    frames, times_us = some_clips()
    low = pixels_of(log_eps=1e-3, THRESHOLD_ON=0.02, THRESHOLD_OFF=0.02)
    made = simulate_on_cpu(frames, times_us, low, ALL)
    window = int(made.counts[0, 0].sum())
    assert window > 2 * HEIGHT * WIDTH
    steps = np.abs(np.diff(byte_brightness(1.0, 1e-3)[frames[0].astype(int)], axis=0)).sum() / 0.02
    assert made.ends[0] == pytest.approx(steps, rel=0.04)


def test_still_clips_fire_by_noise_and_hot_pixels_alone():
    frames, times_us = some_clips()
    still = np.repeat(frames[:, :1], INTERVALS + 1, axis=1)
    assert not len(simulate_on_cpu(still, times_us, pixels_of(), ALL).words)
    hot = simulate_on_cpu(still, times_us, pixels_of(HOT_FRACTION=0.1, HOT_NOISE=0.5), ALL)
    places = hot.counts.sum(axis=(1, 2)) > 0
    assert 0.02 < places.mean() < 0.12
    assert not np.array_equal(places[0], places[1])
    noisy = [
        len(simulate_on_cpu(still, times_us, pixels_of(NOISE=sigma), ALL).words)
        for sigma in (0.03, 0.1, 0.3)
    ]
    assert noisy == sorted(set(noisy))


def test_noise_is_normal_and_differs_between_frames():
    size = (1, 2, 64, 64)
    still, times_us = np.full(size, 100, np.uint8), np.array([[0, 1000]])
    shares = []
    for limit in (0.5, 1.0, 2.0, 3.0):
        pixels = ClipPixels(
            np.array([[limit, 10.0, 0, 1.0, 0, 0, 0, 0]]), frame_keys(1, [0]),
            byte_brightness(1.0, LOG_EPS),
        )  # fmt: skip
        shares.append(
            (simulate_on_cpu(still, times_us, pixels, ClipOutputs(counts=True)).counts > 0).sum()
        )
    expected = np.array([0.3085, 0.1587, 0.0228, 0.0013]) * 64 * 64
    assert np.allclose(shares, expected, atol=4 * np.sqrt(expected) + 2)


def test_lower_thresholds_and_shorter_refractory_periods_give_more_events():
    frames, times_us = some_clips()

    def number(**columns: float) -> tuple[int, int]:
        counts = simulate_on_cpu(frames, times_us, pixels_of(**columns), ALL).counts
        return int(counts[:, :, 0].sum()), int(counts[:, :, 1].sum())

    off, on = number()
    assert number(THRESHOLD_ON=0.6)[1] < on < number(THRESHOLD_ON=0.2)[1]
    assert number(THRESHOLD_OFF=0.6)[0] < off < number(THRESHOLD_OFF=0.1)[0]
    assert sum(number(REFRACTORY_US=2000)) < off + on


def test_mismatch_spreads_the_thresholds_of_pixels():
    step = np.full((CLIPS, 3, HEIGHT, WIDTH), 100, np.uint8)
    step[:, 1:] = 255
    times_us = np.tile([0, 1000, 2000], (CLIPS, 1))

    def per_pixel(mismatch: float) -> np.ndarray[Any, Any]:
        columns = {"THRESHOLD_ON": 0.05, "MISMATCH": mismatch}
        return np.asarray(
            simulate_on_cpu(step, times_us, pixels_of(**columns), ALL).counts.sum((1, 2))
        )

    assert np.ptp(per_pixel(0.0)) == 0
    spread = per_pixel(0.1) / per_pixel(0.0)
    assert 0.05 < spread.std() < 0.15


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda frames, times: (frames[:, :-1], times[:, :-1]), "whole windows of 2"),
        (lambda frames, times: (frames, times + 1), "rise from 0"),
        (lambda frames, times: (frames, times * 0), "rise from 0"),
    ],
)
def test_clips_that_the_kernels_cannot_take_are_refused(change, message):
    with pytest.raises(InputError, match=message):
        check_clips(*change(*some_clips()), ALL)
