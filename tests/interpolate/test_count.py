"""Eq. 4: how many intermediate frames, when, and what raises and lowers their number."""

import itertools
import math
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

from texvent._registry import INTERPOLATORS
from texvent.brightness import balanced_log
from texvent.config import InterpolateConfig
from texvent.frames import Frame, MotionVectors, Video
from texvent.interpolate.count_policy import CountPolicy, count_for_flicker, count_intermediate
from texvent.interpolate.flow import PairFlow
from texvent.interpolate.pairing import pair_frames
from texvent.interpolate.simple import BlendInterpolator
from texvent.pairs.instants import intermediate_times_us

BLACK = np.zeros((2, 2), np.uint8)
WHITE = np.full((2, 2), 255, np.uint8)


def count(first, second, *, balance=30.0, threshold=0.2, **options):
    lumas = (Frame(one, 0).luma for one in (first, second))
    return count_intermediate(*lumas, balance=balance, contrast_threshold=threshold, **options)


def test_cap_limits_the_count():
    assert count(BLACK, WHITE, threshold=0.01) == 64
    assert count(BLACK, WHITE, threshold=0.01, cap=7) == 7
    assert count(BLACK, WHITE, cap=0) == 0


@given(
    hnp.arrays(np.float32, (2, 3), elements=st.floats(0, 1e6, width=32)),
    hnp.arrays(np.float32, (2, 3), elements=st.floats(0, 1e6, width=32)),
    st.sampled_from([0.5, 0.9]) | st.floats(0.5, 100),
    st.sampled_from([0.2, 0.01, 1.0, 1e-4]),
)
def test_eq4_equals_its_definition_in_float64(first, second, balance, threshold):
    change = np.abs(balanced_log(first, balance) - balanced_log(second, balance)).max()
    expected = math.floor(change / threshold)
    assert count(first, second, balance=balance, threshold=threshold, cap=10**9) == expected


times = st.integers(-(2**40), 2**40)


@given(times, st.integers(1, 10**7), st.floats(0.01, 1e4), st.integers(0, 99))
def test_light_that_beats_is_shown_in_twelfths_of_its_period(first_us, interval_us, hz, cap):
    count = count_for_flicker(first_us, first_us + interval_us, hz, cap=cap)
    assert count == min(math.ceil(12 * (hz * interval_us / 1e6)) - 1, cap)
    assert count_for_flicker(first_us, first_us + interval_us, None, cap=cap) == 0


@given(times, st.integers(1, 10**7), st.integers(0, 200))
def test_times_lie_strictly_inside_and_increase(first_us, interval_us, wanted):
    second_us = first_us + interval_us
    got = intermediate_times_us(first_us, second_us, wanted)
    assert len(got) == min(wanted, interval_us - 1)
    assert all(a < b for a, b in zip([first_us, *got], [*got, second_us], strict=True))


@given(times, st.integers(2, 10**7), st.integers(1, 64))
def test_times_are_equally_spaced_to_half_a_microsecond(first_us, interval_us, wanted):
    got = intermediate_times_us(first_us, first_us + interval_us, wanted)
    for k, t_us in enumerate(got, start=1):
        exact = Fraction(interval_us * k, len(got) + 1)
        assert abs(t_us - first_us - exact) <= Fraction(1, 2)


@pytest.fixture
def policy(stream):
    def build(interpolator=None, counts_motion=False, **options):
        config = InterpolateConfig(**{"interpolate": "blend", **options})
        interpolator = interpolator or INTERPOLATORS.load(config.interpolate)(config, stream)
        return CountPolicy(
            config,
            stream,
            interpolator,
            balance=30.0,
            contrast_threshold=0.2,
            counts_motion=counts_motion,
        )

    return build


@pytest.fixture
def faint_pair(moving_texture, pair):
    """A texture too faint for Eq. 4 that moves by 7 px."""
    faint = [100 + moving_texture(dx) / 50 for dx in (0, 7)]
    return pair(*faint, interval_us=40_000)


def test_motion_raises_the_count_of_a_faint_pair(policy, faint_pair):
    assert policy().count(*faint_pair) == 0
    # The fastest thousandth are a few vectors gone astray in a corner.
    assert policy(frames_per_pixel=1.0).count(*faint_pair) in (7, 8, 9)


class Beating(Video):
    """Frames of light that beats so often, which can be rendered at any instant."""

    flicker_hz: float | None = None

    def at(self, t_us: int) -> Frame:
        return Frame(BLACK, t_us)


CHOICES = {
    "flicker_hz": (None, 120.0),
    "known_px": (0.0, 30.0),
    "flow_px": (5.2, 15.0, 40.0),
    "per_pixel": (None, 0.0, 2.0),
    "cap": (64, 12),
    "fixed": (None, 0, 100),
    "gains": (False, True),
}


@pytest.mark.parametrize("name", INTERPOLATORS.names())
def test_a_count_is_the_largest_that_eq4_flicker_or_motion_ask_for(name, monkeypatch):
    """Where nothing is said, motion that is estimated asks for no more than twice Eq. 4's count."""
    for values in itertools.product(*CHOICES.values()):
        case = dict(zip(CHOICES, values, strict=True))
        monkeypatch.setattr(PairFlow, "motion_px", lambda *_, case=case: case["flow_px"])
        assert _counted(name, **case) == _defined(name, **case), case


def _counted(name, flicker_hz, known_px, per_pixel, cap, fixed, gains, **_):
    given = {"frames_per_pixel": per_pixel, "fixed_count": fixed, "max_intermediate": cap}
    given = {key: one for key, one in given.items() if one is not None}
    config = InterpolateConfig(interpolate=name, **given)
    vectors = np.zeros((2, 2, 2), np.float32)
    vectors[1, 0] = 0.6 * known_px, -0.8 * known_px
    known = [MotionVectors(vectors), None] if gains else [None, MotionVectors(backward=vectors)]
    pair = Frame(BLACK, 0, motion=known[0]), Frame(WHITE, 40_000, motion=known[1])
    stream = Beating(np.zeros((2, 4, 4), np.uint8), [0, 1000])
    stream.flicker_hz = flicker_hz
    blend = BlendInterpolator(InterpolateConfig(), stream)
    policy = CountPolicy(
        config, stream, blend, balance=30.0, contrast_threshold=0.2, counts_motion=gains
    )
    return policy.count(*pair)


def _defined(name, flicker_hz, known_px, flow_px, per_pixel, cap, fixed, gains):
    if name == "none":
        return 0
    if fixed is not None:
        return fixed
    asked, knows = [count(BLACK, WHITE)], name in ("motion", "exact")
    per_px = 1.0 if per_pixel is None else per_pixel
    if per_pixel is None and gains and name not in ("blend", "motion"):
        asked.append(min(math.ceil(flow_px), 2 * asked[0]))
    elif per_pixel:
        asked.append(math.ceil(per_px * flow_px))
    if knows:
        asked += [math.ceil(max(per_px, 1.0) * known_px)]
        asked += [math.ceil(12 * flicker_hz * 0.04) - 1] if flicker_hz else []
    return min(max(asked), cap)


def test_where_nothing_can_fire_motion_is_not_even_estimated(policy, faint_pair, monkeypatch):
    monkeypatch.setattr(PairFlow, "motion_px", None)
    assert policy(interpolate="flow", counts_motion=True).count(*faint_pair) == 0


def test_flow_for_the_count_and_for_the_frames_is_computed_once(moving_texture, monkeypatch):
    video = Video(np.stack([100 + moving_texture(4 * i) / 50 for i in range(3)]), [0, 9000, 18_000])
    config = InterpolateConfig(interpolate="flow", frames_per_pixel=1.0)
    interpolator = INTERPOLATORS.load("flow")(config, video)
    dis = interpolator.pair_flow._dis
    calls = []
    compute = dis.both_ways
    monkeypatch.setattr(dis, "both_ways", lambda *pair: calls.append(pair) or compute(*pair))
    policy = CountPolicy(config, video, interpolator, balance=30.0, contrast_threshold=0.2)
    pairs = list(pair_frames(video, interpolator, config, policy))
    assert len(calls) == 2
    assert min(len(pair.times_us) for pair in pairs[1:]) >= 4


def test_motion_is_that_of_the_fastest_thousandth(moving_texture):
    still = PairFlow().motion_px(Frame(moving_texture(0), 0), Frame(moving_texture(0), 1))
    assert still == 0
    fast = PairFlow().motion_px(Frame(moving_texture(0), 0), Frame(moving_texture(5.2), 1))
    assert 5.2 < fast < 7


def test_motion_is_that_from_the_first_frame_to_the_second():
    y, x = np.mgrid[-40:40, -50:50]

    def zoomed(factor):
        u, v = x / factor, y / factor
        levels = 120 + 50 * np.sin(0.35 * u) * np.cos(0.3 * v) + 40 * np.sin(0.11 * u + 0.17 * v)
        return Frame(levels.astype(np.float32), round(1000 * factor))

    pair = zoomed(1.2), zoomed(1.0)
    lengths = [np.hypot(*np.moveaxis(one, -1, 0)) for one in PairFlow().both_ways(*pair)]
    forward, backward = (np.percentile(one, 99.9) for one in lengths)
    assert PairFlow().motion_px(*pair) == pytest.approx(forward, rel=0.05)
    assert abs(backward - forward) > 0.1 * forward


def test_known_motion_counts_where_it_is_followed(policy, pair, stream):
    first, second = pair(*[np.full((4, 4), 100, np.uint8)] * 2, interval_us=40_000)
    forward = np.zeros((4, 4, 2), np.float32)
    forward[1, 2], forward[0, 0] = (6.0, -8.0), np.nan
    moving = [Frame(one.pixels, one.t_us, motion=MotionVectors(forward)) for one in (first, second)]
    blend = BlendInterpolator(InterpolateConfig(), stream)
    assert policy(blend, interpolate="motion").count(*moving) == 10
    assert policy(blend, interpolate="motion").count(first, second) == 0
    back = Frame(second.pixels, second.t_us, motion=MotionVectors(backward=forward))
    assert policy(blend, interpolate="motion").count(first, back) == 10
