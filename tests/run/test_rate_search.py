import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from texvent.errors import InputError
from texvent.frames import Video
from texvent.pipeline import video_to_events
from texvent.run.rate_search import (
    HIGHEST,
    LOWEST,
    MAX_STEPS,
    find_threshold,
    match_rate,
    measure_rate,
)
from texvent.settings.resolution import resolve


def moving_waves(count: int = 13, start_us: int = 0) -> Video:
    y, x = np.mgrid[:24, :32]
    frames = [
        np.round(120 + 70 * np.sin((x + 2 * i) / 3) * np.cos((y - i) / 4)).astype(np.uint8)
        for i in range(count)
    ]
    return Video(np.stack(frames), [start_us + round(i * 1e6 / 24) for i in range(count)])


def simulation(video=None, **options):
    settings = resolve("simulate", {"interpolate": "none", "noise_scale": 0.0, **options})
    return video_to_events(video or moving_waves(), settings)


def test_the_search_ends_within_two_percent():
    found = find_threshold(lambda threshold: 1000 / threshold, 4000.0)
    assert found.ratio == pytest.approx(1, rel=0.02)
    assert found.threshold == pytest.approx(0.25, rel=0.02)
    assert found.steps <= 9


@given(
    many=st.floats(1.03, 20.0),
    few=st.floats(0.05, 0.97),
    edge=st.floats(0.16, 0.25),
    start=st.sampled_from([None, 0.2]),
)
def test_where_rates_jump_the_search_takes_the_side_that_is_nearer_by_its_ratio(
    many, few, edge, start
):
    found = find_threshold(lambda one: 1000 * (many if one < edge else few), 1000.0, start=start)
    nearer = min(many, few, key=lambda one: abs(np.log(one)))
    assert found.ratio == pytest.approx(nearer)
    assert not found.is_matched


@pytest.mark.parametrize("seconds", [0.1, 0.3, 9.0])
def test_a_rate_is_that_of_the_frames_up_to_the_first_one_so_much_later(seconds):
    """Of a shorter clip, that of the whole."""
    run, video = simulation(simulator="esim", noise_scale=None), moving_waves()
    times = [frame.t_us for frame in video]
    end_us = next((one for one in times if one >= seconds * 1e6), times[-1])
    count = len(run.packets.collect().between(0, end_us))
    assert measure_rate(run, seconds) == pytest.approx(count * 1e6 / end_us)


@pytest.mark.parametrize("target", [1.0, 1e9])
def test_a_rate_out_of_reach_fails_and_says_what_is_near(target):
    with pytest.raises(InputError, match=r"no contrast threshold.*the nearest is"):
        match_rate(simulation(), target)
    with pytest.raises(InputError, match="needs at least two frames; this source has fewer"):
        match_rate(simulation(moving_waves(1)), target)


@pytest.mark.parametrize(
    ("simulator", "target", "start_us"), [("physical", 30_000, 0), ("esim", 10_000, 10**10)]
)
def test_a_simulation_is_matched_to_a_rate_wherever_its_clock_begins(simulator, target, start_us):
    options = {"noise_scale": None} if simulator == "esim" else {}
    run = simulation(moving_waves(start_us=start_us), simulator=simulator, **options)
    matched, found = match_rate(run, target, seconds=0.5)
    assert found.ratio == pytest.approx(1, rel=0.05)
    events = matched.packets.collect()
    assert len(events) / 0.5 == pytest.approx(found.ratio * target)
    assert matched.provenance["settings"]["simulate"] != run.provenance["settings"]["simulate"]


class Counter:
    """A simulator whose count falls as a power of the threshold."""

    def __init__(self, at_one, power):
        self.at_one, self.power, self.calls = at_one, power, []

    def __call__(self, threshold):
        self.calls.append(threshold)
        return round(self.at_one * threshold**-self.power)


@given(power=st.floats(0.5, 3.0), wanted=st.floats(0.02, 1.0))
def test_any_power_law_is_matched_within_nine_steps(power, wanted):
    counter = Counter(1_000_000, power)
    match = find_threshold(counter, round(1_000_000 * wanted**-power), start=0.2)
    assert match.is_matched
    assert match.ratio == pytest.approx(1, abs=0.02)
    assert len(counter.calls) <= MAX_STEPS


def test_a_count_that_cannot_be_reached_gives_the_closest_threshold():
    counter = Counter(10, 1.0)
    match = find_threshold(counter, 1_000_000, start=0.2)
    assert not match.is_matched
    assert match.threshold == LOWEST
    too_many = find_threshold(Counter(1_000_000, 0.1), 10, start=0.2)
    assert too_many.threshold == HIGHEST


def test_a_simulator_without_events_keeps_its_threshold():
    match = find_threshold(lambda threshold: 0, 1000, start=0.2)
    assert match.threshold == 0.2
    assert match.ratio == 0
    assert not match.is_matched
