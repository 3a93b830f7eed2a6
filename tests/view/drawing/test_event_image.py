"""Images of events, and colours of a flow."""

import colorsys
import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from texvent.frames import Frame
from texvent.transfer import Transfer
from texvent.view.drawing.event_image import (
    UNKNOWN,
    count_ceiling,
    draw_events,
    draw_flow,
    frame_image,
)
from texvent.view.drawing.palettes import PALETTES, get_palette

PAPER = get_palette("paper")


def test_one_event_each_shows_the_palettes_exact_colours():
    counts = np.array([[[0, 1, 0]], [[1, 0, 0]]])
    assert draw_events(counts, PAPER).tolist() == [
        [list(PAPER.on), list(PAPER.off), list(PAPER.background)]
    ]


def test_as_many_on_as_off_mix():
    counts = np.array([[[1]], [[1]]])
    assert draw_events(counts, PAPER, ceiling=2).tolist() == [[[128, 0, 128]]]


def test_more_events_are_stronger_and_the_scale_saturates():
    counts = np.array([[[0, 0, 0, 0]], [[1, 5, 10, 500]]])
    red = draw_events(counts, PAPER, ceiling=10)[0, :, 0].tolist()
    assert red[0] > red[1] > red[2] == red[3] == 0
    assert red[0] < 255, "a single event stays visible"


def test_the_ceiling_follows_the_data_and_ignores_a_hot_pixel():
    counts = np.zeros((2, 10, 10), dtype=int)
    assert count_ceiling(counts) == 1.0
    counts[1] = 4
    counts[1, 0, 0] = 10_000
    assert count_ceiling(counts) == 4.0


@given(seed=st.integers(0, 2**16), rate=st.floats(0.001, 300.0), name=st.sampled_from([*PALETTES]))
def test_an_image_is_never_blank_and_never_outside_its_colours(seed, rate, name):
    palette = get_palette(name)
    counts = np.random.default_rng(seed).poisson(rate, (2, 12, 16))
    # In v2e's palette, as in v2e, as many ON as OFF give the background's grey.
    counts[:, 3, 3] = (0, 1)
    image = draw_events(counts, palette)
    active = counts.any(axis=0)
    background = np.array(palette.background, dtype=np.uint8)
    assert (image[~active] == background).all()
    distance = np.abs(image[3, 3].astype(int) - background).max()
    assert distance > 10


@pytest.mark.parametrize(
    ("pixels", "expected"),
    [
        (np.array([[0, 128, 255]], dtype=np.uint8), [0, 128, 255]),
        (np.array([[0, 128 * 257, 65_535]], dtype=np.uint16), [0, 128, 255]),
        (np.array([[-0.0, 127.6, 300.0]], dtype=np.float32), [0, 128, 255]),
        (np.array([[0.4, 127.5, 254.6]], dtype=np.float64), [0, 128, 255]),
    ],
)
def test_frames_of_every_depth_are_shown_as_8_bit_rgb(pixels, expected):
    image = frame_image(Frame(pixels, 0))
    assert image.dtype == np.uint8
    assert image[0].tolist() == [[value] * 3 for value in expected]


@pytest.mark.parametrize("level", [0.0, 3.0, 60.0, 255.0, 900.0])
def test_linear_light_is_shown_coded_as_srgb(level):
    light = level / 255
    coded = 12.92 * light if light <= 0.0031308 else 1.055 * light ** (1 / 2.4) - 0.055
    shown = frame_image(Frame(np.full((2, 2), level, np.float32), 0, transfer=Transfer.LINEAR))
    assert (shown == round(255 * min(coded, 1.0))).all()


def test_the_default_is_the_papers_on_blue_off_red_on_white():
    paper = next(iter(PALETTES.values()))
    assert paper.name == "paper"
    assert (paper.on, paper.off, paper.background) == ((0, 0, 255), (255, 0, 0), (255, 255, 255))


@pytest.mark.parametrize("name", PALETTES)
def test_polarities_background_and_ink_can_be_told_apart(name):
    palette = get_palette(name)
    colours = [palette.on, palette.off, palette.background]
    for index, one in enumerate(colours):
        for other in colours[index + 1 :]:
            assert sum(abs(a - b) for a, b in zip(one, other, strict=True)) > 100
    contrast = abs(sum(palette.ink) - sum(palette.background))
    assert contrast > 200
    assert palette.name == name


@pytest.mark.parametrize("name", list(PALETTES))
def test_in_dark_mode_no_background_is_light_and_events_stand_out(name):
    palette = PALETTES[name].dark
    background = sum(palette.background)
    assert background <= 3 * 128
    for colour in (palette.on, palette.off):
        assert abs(sum(colour) - background) > 150
    assert palette.on != palette.off


WHITE = (255, 255, 255)
SHAPE = (61, 80)
RADIUS = 6  # a fifth of the shorter side across


@pytest.mark.parametrize("seed", range(3))
def test_flow_is_coloured_pixel_by_pixel_by_its_angle_and_length(seed):
    """The hue goes from red, to the right, through yellow to green as the motion turns down."""
    flow = np.random.default_rng(seed).normal(0, 9, (30, 8, 2))
    flow[0] *= 50
    full = np.percentile(np.hypot(*np.moveaxis(flow, -1, 0)), 95)
    image = draw_flow(flow)
    for row, column in np.ndindex(20, 8):  # the wheel is below
        x, y = flow[row, column]
        hue, strength = math.atan2(y, x) / math.tau % 1.0, min(math.hypot(x, y) / full, 1.0)
        colour = [255 * one for one in colorsys.hsv_to_rgb(hue, strength, 1.0)]
        assert image[row, column].tolist() == pytest.approx(colour, abs=0.6)


@pytest.mark.parametrize("direction", [(1, 0), (0, 1), (-1, 0), (0, -1)])
def test_a_place_of_the_wheel_has_the_colour_of_motion_from_its_centre_to_there(direction):
    image = draw_flow(np.broadcast_to(np.array(direction) * 300.0, (*SHAPE, 2)))
    row, column = SHAPE[0] - 1 - RADIUS + direction[1] * RADIUS, RADIUS + direction[0] * RADIUS
    assert image[row, column].tolist() == image[0, 0].tolist() != list(WHITE)
    assert image[SHAPE[0] - 1 - RADIUS, RADIUS].tolist() == list(WHITE)


def test_rest_is_white_unknown_grey_and_slower_paler():
    flow = np.full((*SHAPE, 2), (100.0, 0.0))
    flow[:, :60] = 50, 0
    flow[0], flow[1] = 0, np.nan
    image = draw_flow(flow)
    assert (image[0] == WHITE).all()
    assert (image[1] == UNKNOWN).all()
    assert image[2, 70].tolist() == [255, 0, 0]
    assert image[2, 10].tolist() == pytest.approx([255, 127, 127], abs=1)
    # One fast outlier makes the rest no paler.
    flow[3, 0] = 10_000, 0
    np.testing.assert_array_equal(np.delete(draw_flow(flow), 3, 0), np.delete(image, 3, 0))
    assert (draw_flow(np.zeros((*SHAPE, 2)))[0] == WHITE).all()
    assert (draw_flow(np.full((1, 1, 2), np.nan)) == WHITE).all()  # the wheel alone fits
