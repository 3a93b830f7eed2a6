"""Warping, its paths and samples: hand-computed cases; compiled, they equal their definitions."""

import functools

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from tests.examples import examples
from tests.pairs import reference

from texvent.pairs import contested_paths, warping
from texvent.runtime.kernel_arrays import read_only


def as_in_a_run(kernel):
    """The kernel of arrays that cannot be written, as those of a run: it is compiled once."""

    def unwritten(value):
        if isinstance(value, tuple):
            return tuple(map(unwritten, value))
        return read_only(value) if isinstance(value, np.ndarray) else value

    @functools.wraps(kernel)
    def call(*arguments):
        return kernel(*map(unwritten, arguments))

    return call


find_sweep, number_contested, choose_paths = map(
    as_in_a_run,
    (contested_paths.find_sweep, contested_paths.number_contested, contested_paths.choose_paths),
)


def warp_between(*arrays):
    """One intermediate frame at the last argument, compiled."""
    return warping.warp_pair(warping.prepare_pair(*arrays[:-1], arrays[-1:]), 0, 1)[0]


kernels = pytest.mark.parametrize(
    "warp", [reference.warp_between, warp_between], ids=["reference", "cpu"]
)


def constant_flow(shape, x, y=0.0):
    return np.broadcast_to(np.float32([x, y]), (*shape, 2)).copy()


@kernels
def test_a_ramp_moves_with_its_flow(warp):
    # I(x) = 10 x moves right by 2 px: at τ = 1/4 it has moved 0.5 px, so I = 10 (x − 0.5).
    first = np.tile(np.arange(12, dtype=np.float32) * 10, (3, 1))
    second = first - 20
    forward, backward = constant_flow((3, 12), 2.0), constant_flow((3, 12), -2.0)
    got = warp(first, second, forward, backward, 0.25)
    np.testing.assert_allclose(got[:, 2:-2], first[:, 2:-2] - 5.0, atol=1e-5)


@kernels
def test_flows_that_contradict_each_other_give_a_blend_in_place(warp):
    # Both directions claim 50 px to the right: the errors are 100 px on a path of 0 px.
    rng = np.random.default_rng(0)
    first, second = (rng.uniform(0, 255, (6, 200)).astype(np.float32) for _ in range(2))
    wrong = constant_flow((6, 200), 50.0)
    got = warp(first, second, wrong, wrong, 0.5)
    np.testing.assert_allclose(got, (first + second) / 2, atol=0.01)


@kernels
def test_what_enters_the_image_is_taken_from_the_frame_that_shows_it(warp):
    # Everything moves right by 8 px. At τ = 1/2, column 0 shows what is at column 4 of the later
    # frame and was outside the earlier one, which therefore does not count.
    first, second = np.zeros((1, 20), np.float32), np.full((1, 20), 70.0, np.float32)
    got = warp(first, second, constant_flow((1, 20), 8.0), constant_flow((1, 20), -8.0), 0.5)
    assert got[0, 0] == pytest.approx(70.0)
    assert got[0, 10] == pytest.approx(35.0)
    assert got[0, 19] == pytest.approx(0.0)


def test_places_outside_are_looked_at_at_the_edge():
    image = np.array([[0.0, 10.0], [20.0, 30.0]])
    flow = np.stack([image, -image], axis=-1)
    way = np.zeros((2, 2, 2))
    way[0, 0], way[0, 1], way[1, 0], way[1, 1] = (0.5, 0.4), (-0.75, 0.0), (-3.0, -0.5), (0.3, 9.0)
    seen, vectors, is_inside = reference.sample_along(image, flow, way)
    np.testing.assert_allclose(seen, [[13.0, 2.5], [10.0, 30.0]])
    np.testing.assert_array_equal(vectors[..., 0], [[10.0, 0.0], [20.0, 30.0]])
    np.testing.assert_array_equal(is_inside, [[True, True], [False, False]])
    assert reference.sample_along(image, flow, way + np.array([0.2, -8.5]))[2][1, 1]


def test_some_points_of_an_image_are_those_of_the_whole_image():
    rng = np.random.default_rng(7)
    first, second = (rng.uniform(0, 255, (30, 21)).astype(np.float32) for _ in range(2))
    forward = rng.normal(0, 3, (30, 21, 2)).astype(np.float32)
    pair = warping.prepare_pair(first, second, forward, -forward, [0.2, 0.7])
    pixel = np.sort(rng.choice(630, 100, replace=False))
    room, shown = warping.make_room(pixel.size), np.empty(pixel.size, np.float32)
    warping.take_points(pair, pixel, room.points)
    warping.warp_points(pair, room, pixel.size, 1, shown)
    whole = warping.warp_pair(pair, 0, 2)
    np.testing.assert_array_equal(shown, whole[1].reshape(-1)[pixel])


def test_a_flow_that_is_no_number_does_no_harm():
    frame, flow = np.full((4, 5), 7, np.float32), constant_flow((4, 5), np.nan)
    assert warp_between(frame, frame, flow, flow, 0.5).shape == (4, 5)
    flow = constant_flow((4, 5), 1e30)
    np.testing.assert_array_equal(warp_between(frame, frame, flow, flow, 0.5), frame)


def ball_flows(step, size=3, shape=(9, 24), x=2):
    """Flows of a small thing from column x on that moves right before a ground at rest."""
    forward, backward = np.zeros((2, *shape, 2), np.float32)
    forward[3:6, x : x + size] = step, 0
    backward[3:6, x + step : x + step + size] = -step, 0
    return forward, backward


@pytest.mark.parametrize("find", [reference.find_sweep, find_sweep])
def test_the_sweep_is_what_a_small_thing_passes_and_covers_in_neither_frame(find):
    sweep = find(*ball_flows(12), 0)
    # In columns 2 to 4 it is at first, in 14 to 16 at last; it passes 5 to 13.
    assert (sweep[3:6, 5:14] == (12, 0)).all()
    assert not sweep[:, :5].any()
    assert not sweep[:, 14:].any()


@pytest.mark.parametrize("find", [reference.find_sweep, find_sweep])
def test_a_path_along_the_edge_stays_in_the_image(find):
    forward, backward = np.zeros((2, 3, 24, 2), np.float32)
    for row, slope in ((0, -0.4), (2, 0.4)):
        forward[row, 2], backward[row, 14] = (12, slope), (-12, -slope)
    sweep = find(forward, backward, 0)
    np.testing.assert_allclose(sweep[0, 3:14], np.tile(np.float32([12, -0.4]), (11, 1)))
    assert not sweep[1].any()


@pytest.mark.parametrize("find", [reference.find_sweep, find_sweep])
@pytest.mark.parametrize("backward", [-12, 0])
def test_nothing_sweeps_where_all_moves_or_the_later_frame_contradicts(find, backward):
    forward = np.broadcast_to(np.float32([12, 0]), (9, 24, 2)).copy()
    other = np.broadcast_to(np.float32([backward, 0]), (9, 24, 2)).copy()
    assert not find(forward, other, 0).any()


@kernels
@pytest.mark.parametrize("position", [0.25, 0.5, 0.75])
def test_a_small_fast_thing_is_where_it_is_and_nowhere_else(warp, position):
    ground = np.full((9, 24), 40, np.float32)
    first, second = ground.copy(), ground.copy()
    first[3:6, 2:5] = 200
    second[3:6, 14:17] = 200
    got = warp(first, second, *ball_flows(12), position)
    there = ground.copy()
    there[3:6, 2 + round(12 * position) : 5 + round(12 * position)] = 200
    np.testing.assert_allclose(got, there, atol=1e-3)


def flows_of_surfaces(rng, shape):
    """Flows both ways of surfaces that meet: slow, fast and impossible ones; some agree."""
    motions = rng.normal(0, 1, (5, 2)) * rng.choice([0.3, 4.0, 15.0, 60.0, 1e5], (5, 1))
    motions[:2] = (5, 1), rng.normal(0, 8, 2)
    side = rng.integers(1, 5)
    one, other = rng.integers(0, 5, (2, *shape)) * (rng.random((2, *shape)) < 0.6)
    one, other = (each[::side, ::side].repeat(side, 0).repeat(side, 1) for each in (one, other))
    ahead, back = (motions[each[: shape[0], : shape[1]]] for each in (one, other))
    return (ahead + rng.normal(0, 0.1, ahead.shape)).astype(np.float32), -back.astype(np.float32)


@examples(25)
@given(
    st.integers(0, 999),
    st.sampled_from([(1, 1), (5, 9), (16, 21), (12, 60)]),
    st.sampled_from([0, 1]),
    st.floats(0.015625, 0.984375, width=32),
)
def test_compiled_paths_equal_their_definition(seed, shape, shift, position):
    rng, position = np.random.default_rng(seed), np.float32(position)
    vectors = tuple(side + shift >> shift for side in shape)
    forward, backward = flows_of_surfaces(rng, vectors)
    sweep = find_sweep(forward, backward, shift)
    expected = reference.find_sweep(forward, backward, shift)
    np.testing.assert_array_equal(sweep if sweep.size else np.zeros_like(forward), expected)
    numbers = number_contested(forward, backward, sweep, shift)
    found, is_chosen = forward - position * (forward + backward), numbers.reshape(-1) > 0
    if numbers.size:
        assert sorted(numbers[is_chosen]) == [*range(1, is_chosen.sum() + 1)]
        instants = np.array([0.5, position], np.float32)
        paths = choose_paths((forward, backward), sweep, shift, numbers, instants)
        found.reshape(-1, 2)[is_chosen] = paths[1, numbers[is_chosen] - 1]
    wanted = reference.choose_paths(forward, backward, position, shift)
    np.testing.assert_array_equal(found, wanted)
    images = rng.uniform(0, 255, (2, *shape)).astype(np.float32)
    arguments = *images, forward, backward, position
    np.testing.assert_array_equal(warp_between(*arguments), reference.warp_between(*arguments))


@pytest.mark.parametrize("length", [3.0, 6.0, 30.0])
@pytest.mark.parametrize(("share", "is_contested"), [(0.98, False), (1.02, True)])
def test_two_surfaces_meet_where_flows_differ_by_four_px_and_a_tenth(length, share, is_contested):
    # d² = 0.1 · (length² + d²) + 16, of the longer of both flows.
    across = share * np.sqrt((0.1 * length**2 + 16) / 0.9)
    forward, backward = constant_flow((3, 70), length), constant_flow((3, 70), -length)
    backward[1, 20] = -length, across
    none = np.zeros((0, 0, 2), np.float32)
    numbers = number_contested(forward, backward, none, 0)
    assert [*np.flatnonzero(numbers)] == [90] * is_contested


@pytest.mark.parametrize(("step", "is_followed"), [(2, False), (3, True), (48, True), (49, False)])
def test_what_moves_by_three_to_48_px_is_followed(step, is_followed):
    forward, backward = ball_flows(step, size=1, shape=(9, 60))
    ground = -6
    forward[~forward.any(-1)], backward[~backward.any(-1)] = (ground, 0), (-ground, 0)
    sweep = find_sweep(forward, backward, 0)
    assert bool(sweep.any()) == is_followed
    if is_followed:
        assert (sweep[3:6, 3 : 2 + step] == (step, 0)).all()


def error_of(trust, path):
    """The error, px, of a flow that is trusted so far: by a half at a tenth of the path and 0.3."""
    return np.sqrt((0.01 * path**2 + 0.1) * np.sqrt(1 / trust - 1))


@pytest.mark.parametrize("path", [8.0, 20.0])
@pytest.mark.parametrize(("kind", "least"), [("swept", 0.5), ("own", 0.3)])
@pytest.mark.parametrize("more", [-0.03, 0.03])
def test_a_path_is_taken_from_the_stated_agreement_on(path, kind, least, more):
    """By one end fully, by the other as far as its flow is trusted; the mean, by one end."""
    forward, backward = constant_flow((1, 90), 0.0, 50.0), constant_flow((1, 90), 0.0, 50.0)
    x, half, sweep = 40, int(path) // 2, np.zeros((1, 90, 2), np.float32)
    own = np.float32([path, 0]) if kind == "own" else np.float32([-24.0, 0])
    forward[0, x], backward[0, x] = own, (12, 0) if kind == "own" else -own
    if kind == "own":
        mean = (path - 12) / 2
        forward[0, int(np.floor(x - mean / 2 + 0.5))] = mean, 0
    else:
        sweep[0, x] = path, 0
    forward[0, x - half] = path, error_of(least + more, path)
    backward[0, x + half] = -path, 0
    numbers = np.zeros(90, np.int32)
    numbers[x] = 1
    flows, middle = (forward, backward), np.float32([0.5])
    chosen = choose_paths(flows, sweep, 0, numbers, middle)[0, 0]
    assert (chosen.tolist() == [path, 0]) == (more > 0)


LEVELS = st.integers(0, 255)
SIXTEENTHS = st.integers(-48, 48)


def sample(image, x, y=0.0):
    """Samples of the whole image, displaced by (x, y) px."""
    shift = np.broadcast_to(np.array([x, y], image.dtype), (*image.shape, 2))
    return reference.sample_along(image, np.zeros_like(shift), shift)[0]


def images(least=1):
    shapes = st.tuples(st.integers(least, 6), st.integers(least, 8))
    return shapes.flatmap(lambda shape: arrays(np.float32, shape, elements=LEVELS))


@pytest.mark.parametrize("turned", [False, True])
def test_samples_by_hand(turned):
    # The slope changes by 0 at 10 and by (10 − 20) + (60 − 20) = 30 at 20, and by 0 at the border.
    # So the bend is 7.5 between 10 and 20, and between 20 and 60: a sample is 7.5 / 4 lower at a
    # half, 7.5 · 3/16 at a quarter.
    image = np.array([[0.0, 10.0, 20.0, 60.0]])

    def look(x):
        return sample(image.T, 0.0, x).T if turned else sample(image, x)

    np.testing.assert_allclose(look(0.5)[0], [5.0, 13.125, 38.125, 60.0])
    np.testing.assert_allclose(look(0.25)[0, 1], 11.09375)
    np.testing.assert_allclose(look(-0.75)[0, 2], 11.09375)


def test_a_sample_stays_in_the_range_of_the_pixels_around_it():
    # The parabolas through 0, 50, 50 and 50, 50, 0 reach 56.25 between both.
    np.testing.assert_array_equal(sample(np.array([[0.0, 50.0, 50.0, 0.0]]), 0.5)[0, 1], 50.0)


def test_parabolas_are_given_exactly_away_from_the_border():
    y, x = np.mgrid[:9, :9].astype(np.float64)
    image = x * x + 3 * y * y + 2 * x + 7 * y + 5
    wanted = (x + 0.3) ** 2 + 3 * (y + 0.6) ** 2 + 2 * (x + 0.3) + 7 * (y + 0.6) + 5
    np.testing.assert_allclose(sample(image, 0.3, 0.6)[1:-2, 1:-2], wanted[1:-2, 1:-2])


@given(image=images(), x=st.integers(-3, 3), y=st.integers(-3, 3))
def test_whole_pixels_give_the_pixels(image, x, y):
    rows = np.clip(np.arange(image.shape[0]) + y, 0, image.shape[0] - 1)
    columns = np.clip(np.arange(image.shape[1]) + x, 0, image.shape[1] - 1)
    np.testing.assert_array_equal(sample(image, x, y), image[rows][:, columns])


@given(along=st.integers(-9, 9), down=st.integers(-9, 9), x=SIXTEENTHS, y=SIXTEENTHS)
def test_ramps_are_given_exactly(along, down, x, y):
    row, column = np.mgrid[:5, :7].astype(np.float32)
    image = 128 + along * column + down * row
    column = np.clip(column + np.float32(x / 16), 0, 6)
    row = np.clip(row + np.float32(y / 16), 0, 4)
    np.testing.assert_array_equal(sample(image, x / 16, y / 16), 128 + along * column + down * row)
