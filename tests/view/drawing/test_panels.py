import itertools
from functools import partial

import numpy as np
import pytest

from texvent.sensor import SENSORS, SensorSize
from texvent.view.drawing.canvas import blank, draw_arrow, draw_frame, draw_label
from texvent.view.drawing.palettes import PALETTES, get_palette
from texvent.view.drawing.panels import (
    BOX_COLOUR,
    FLOW_COLOUR,
    SURROUND,
    PanelLayout,
    draw_legend,
    title_of,
)

SIZES = [
    SENSORS["davis346"].size,
    SensorSize(1, 1),
    SensorSize(33, 17),
    SensorSize(3, 500),
    SensorSize(1001, 3),
]


TITLES = {"prompt": "a cat", "title": "cats", "source": {"source": "of/cat.mp4"}, "input": "e.raw"}
"""Fact → what it says, those that say most first."""


@pytest.mark.parametrize("count", range(5))
def test_a_recording_is_called_after_the_fact_that_says_most(count):
    for names in itertools.permutations(TITLES, count):
        first = next((one for one in TITLES if one in names), "")
        expected = {"": "", "source": "cat.mp4"}.get(first) or TITLES.get(first, "")
        assert title_of({one: TITLES[one] for one in names}) == expected
        assert title_of({"prompt": " ", **{one: TITLES[one] for one in names}}) == expected


@pytest.mark.parametrize("colour", [BOX_COLOUR, FLOW_COLOUR, (255, 255, 255)])
@pytest.mark.parametrize(
    "draw",
    [partial(draw_frame, corners=(20, 20, 60, 50)), partial(draw_arrow, tail=(9, 9), tip=(50, 40))],
    ids=["frame", "arrow"],
)
def test_what_is_drawn_stands_out_of_its_own_colour(draw, colour):
    image = blank(80, 70, colour)
    draw(image, colour=colour)
    assert image.sum(axis=-1).min() < 0.5 * sum(colour)


@pytest.mark.parametrize("y", [0, 1, 19, 20, 21, 79])
def test_a_label_is_whole_above_its_corner_or_below_it_at_the_edge(y):
    image = blank(120, 120, (0, 0, 0))
    draw_label(image, "car", (30, y), (9, 200, 9), height=10)
    rows = np.flatnonzero((image == (9, 200, 9)).all(axis=2).any(axis=1))
    assert [rows[0], rows[-1] + 1] == ([y - 20, y] if y >= 20 else [y, y + 20])


@pytest.mark.parametrize("size", SIZES, ids=str)
@pytest.mark.parametrize("side_by_side", [True, False])
def test_every_sensor_gives_an_even_image_with_both_panels(size, side_by_side):
    layout = PanelLayout(size, get_palette("paper"), side_by_side=side_by_side)
    frame = blank(size.width, size.height, (10, 200, 30))
    events = blank(size.width, size.height, (0, 0, 255))
    image = layout.compose(frame, events, title="a title", facts="0.1 s")
    assert image.shape == (layout.height, layout.width, 3)
    assert layout.width % 2 == layout.height % 2 == 0
    row = image[layout.caption_height + (layout.height - layout.caption_height) // 2]
    assert (row == (0, 0, 255)).all(axis=1).sum() == size.width * layout.factor
    shown = (row == (10, 200, 30)).all(axis=1).sum()
    assert shown == (size.width * layout.factor if side_by_side else 0)


@pytest.mark.parametrize(
    ("size", "factor"),
    [(SensorSize(346, 260), 2), (SensorSize(64, 48), 10), (SensorSize(1280, 720), 1)],
)
def test_small_sensors_are_enlarged_by_a_whole_factor(size, factor):
    assert PanelLayout(size, get_palette("paper")).factor == factor


def test_events_are_enlarged_without_inventing_colours():
    layout = PanelLayout(SensorSize(4, 4), get_palette("paper"), side_by_side=False)
    events = blank(4, 4, (255, 255, 255))
    events[1, 2] = (0, 0, 255)
    image = layout.compose(None, events, title="", facts="")
    panel = image[layout.caption_height :]
    assert {tuple(colour) for colour in panel.reshape(-1, 3).tolist()} <= {
        (255, 255, 255),
        (0, 0, 255),
        SURROUND,
    }


@pytest.mark.parametrize("name", PALETTES)
def test_the_legend_shows_on_before_off_and_their_mixture_in_the_palettes_colours(name):
    palette = get_palette(name)
    legend = draw_legend(palette, 13)
    middle = legend[legend.shape[0] // 2]
    first_on = int(np.argmax((middle == palette.on).all(axis=1)))
    first_off = int(np.argmax((middle == palette.off).all(axis=1)))
    assert (middle[first_on : first_on + 12] == palette.on).all()
    assert (middle[first_off : first_off + 12] == palette.off).all()
    is_seen = sum(np.abs(np.subtract(palette.both, palette.background))) > 3
    assert (legend.shape[1] > draw_legend(get_palette("v2e"), 13).shape[1]) == is_seen
    assert (middle[first_off + 12 :] == palette.both).all(axis=1).any()
    # In palettes of black and white, the other polarity may also be the colour of the words.
    assert first_on < first_off or palette.off == palette.ink
