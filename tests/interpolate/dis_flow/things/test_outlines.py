"""Outlines of things that the search has found."""

from __future__ import annotations

import numpy as np
import pytest

from texvent.interpolate.dis_flow import flow_cpu, flow_reference
from texvent.interpolate.dis_flow.confirmation import both_unconfirmed
from texvent.interpolate.dis_flow.definitions import make_pyramid
from texvent.interpolate.dis_flow.things.fast_things import follow_fast_things
from texvent.interpolate.dis_flow.things.outlines import redraw_things
from texvent.interpolate.dis_flow.things.ways import look
from texvent.interpolate.flow import FlowInterpolator
from texvent.video import Frame

WIDTH, HEIGHT = 120, 96
FROM, STEP, RADIUS = np.array([48.0, 50.0]), np.array([14.0, -4.0]), 13.0
Y, X = np.mgrid[:HEIGHT, :WIDTH]


@pytest.fixture(scope="module")
def ground():
    rng = np.random.default_rng(8)
    image = np.kron(rng.uniform(20, 140, (24, 30)), np.ones((4, 4)))
    for axis in (0, 1):
        image = (image + np.roll(image, 2, axis)) / 2
    return image


def away(share):
    """Distance of each pixel from the middle of the ball, px."""
    return np.hypot(X - FROM[0] - share * STEP[0], Y - FROM[1] - share * STEP[1])


def with_ball(ground, share, level=230.0):
    """The ground behind a ball of one colour, its edge one pixel soft."""
    inside = np.clip(RADIUS + 0.5 - away(share), 0, 1)
    return (ground + inside * (level - ground)).astype(np.float32)


def levels_of(*images, kernels=flow_cpu):
    return [make_pyramid(image, 0, 0, kernels)[0] for image in images]


def moving(mask, step=STEP):
    """Pixels that move before others that rest."""
    return np.where(mask, np.float32(step)[:, np.newaxis, np.newaxis], np.float32(0))


@pytest.fixture
def spread():
    """What a search finds: the motion of the ball 4 px around it and where it comes to lie."""
    both = (away(0) < RADIUS + 4) | (away(1) < RADIUS + 4)
    return moving(both), moving(both, -STEP)


@pytest.mark.parametrize("level", [230.0, 2.0])
def test_the_ground_around_a_ball_gets_its_own_flow_back(ground, spread, level):
    images = levels_of(*(with_ball(ground, share, level) for share in (0, 1)))
    found = follow_fast_things(*images, spread, flow_cpu)
    for flow, share, step in zip(found, (0, 1), (STEP, -STEP), strict=True):
        ball, beside = away(share) < RADIUS, away(share) > RADIUS + 4
        assert np.abs(flow[:, ball] - np.float32(step)[:, np.newaxis]).max() < 0.3
        assert (np.abs(flow[:, beside]).max(axis=0) > 0.1).mean() < 0.005


def test_an_imprecise_shift_becomes_precise(ground, spread):
    images = levels_of(*(with_ball(ground, share) for share in (0, 1)))
    off = np.float32([0.6, 0.5])[:, np.newaxis, np.newaxis]
    rough = tuple(
        np.where(flow != 0, flow + sign * off, flow)
        for flow, sign in zip(spread, (1, -1), strict=True)
    )
    forward, _ = follow_fast_things(*images, rough, flow_cpu)
    middle = forward[:, away(0) < RADIUS]
    np.testing.assert_allclose(np.median(middle, axis=1), STEP, atol=0.2)


def test_both_kernels_give_the_same_flows(ground, spread):
    found = []
    for kernels in (flow_reference, flow_cpu):
        images = levels_of(*(with_ball(ground, share) for share in (0, 1)), kernels=kernels)
        found.append(follow_fast_things(*images, spread, kernels))
    assert any((one != other).any() for one, other in zip(found[0], spread, strict=True))
    for one, other in zip(*found, strict=True):
        np.testing.assert_array_equal(one, other)


def redraw(images, flows):
    ways = look(*images, flows[0], flow_cpu), look(*images[::-1], flows[1], flow_cpu)
    is_open = both_unconfirmed(*images, flows, flow_cpu)
    return redraw_things(ways, flows, is_open, np.zeros_like(is_open[0]), flow_cpu)


def test_flows_stay_where_nothing_moves_otherwise(ground):
    images = levels_of(ground.astype(np.float32), np.roll(ground, 3, 1).astype(np.float32))
    flows = moving(Y >= 0, (3, 0)), moving(Y >= 0, (-3, 0))
    for one, other in zip(redraw(images, flows), flows, strict=True):
        np.testing.assert_array_equal(one, other)


def test_flows_stay_where_another_outline_explains_no_more(ground):
    images = levels_of(*(with_ball(ground, share) for share in (0, 1)))
    exact = moving(away(0) < RADIUS + 1), moving(away(1) < RADIUS + 1, -STEP)
    for one, other in zip(redraw(images, exact), exact, strict=True):
        assert (one != other).any(axis=0).mean() < 0.02


def test_a_settled_ball_stays_as_it_is(ground, spread):
    images = levels_of(*(with_ball(ground, share) for share in (0, 1)))
    ways = tuple(
        look(*pair, flow, flow_cpu)
        for pair, flow in zip((images, images[::-1]), spread, strict=True)
    )
    is_open = both_unconfirmed(*images, spread, flow_cpu)
    settled = np.ones((HEIGHT, WIDTH), np.bool_)
    assert redraw_things(ways, spread, is_open, settled, flow_cpu) is spread


def test_a_large_ball_on_its_way_has_its_outline(config, stream, psnr, monkeypatch):
    rng = np.random.default_rng(5)
    y, x = np.mgrid[:144, :192]
    ground = np.kron(rng.uniform(0, 150, (36, 48)), np.ones((4, 4)))
    ground = (ground + np.roll(ground, 2, 0) + np.roll(ground, 2, 1)) / 3

    def at(share):
        inside = np.clip(15.5 - np.hypot(x - 80 - 20 * share, y - 70 + 6 * share), 0, 1)
        return (ground + inside * (230 - ground)).astype(np.float32)

    def guess():
        pair = Frame(at(0), 0), Frame(at(1), 1000)
        (frame,) = FlowInterpolator(config(), stream).between(*pair, [500])
        return psnr(frame.pixels, at(0.5))

    drawn_anew = guess()
    monkeypatch.setattr(
        "texvent.interpolate.dis_flow.things.fast_things.redraw_things",
        lambda _, flows, *__: flows,
    )
    assert drawn_anew > guess() + 2.0
