"""Colours of a flow."""

import numpy as np
import pytest

from texvent.view.drawing.event_image import UNKNOWN, draw_flow

WHITE = (255, 255, 255)
SHAPE = (61, 80)
RADIUS = 6  # a fifth of the shorter side across


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
