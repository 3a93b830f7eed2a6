"""Boxes between labelled instants, by hand."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.dataset.layouts.crossing import CAR, INSTANTS, MAN, crossing_boxes

from texvent.dataset.layouts.boxes import LABEL_RECORD, ClassList, boxes_at, records_of
from texvent.errors import ConfigError, InputError
from texvent.truth.boxes import BOX_RECORD


def places(boxes: np.ndarray) -> list[tuple[float, ...]]:
    return [tuple(round(float(one[name]), 3) for name in ("x", "y", "w", "h")) for one in boxes]


def test_boxes_move_along_their_tracks_and_those_that_come_are_at_the_nearest_place() -> None:
    boxes = crossing_boxes()
    assert places(boxes_at(boxes, INSTANTS, 90_000)) == [(5, 10, 20, 15)]
    assert places(boxes_at(boxes, INSTANTS, 110_000)) == [(7, 10, 20, 15), (40, 20, 8, 20)]
    assert boxes_at(boxes, INSTANTS, 110_000)["t"].tolist() == [110_000] * 2
    assert places(boxes_at(boxes, INSTANTS, 80_000)) == [(4, 10, 20, 15)]
    # Without tracks nothing says which box is which.
    boxes["track_id"] = 0
    assert places(boxes_at(boxes, INSTANTS, 150_000)) == [(12, 10, 20, 15), (40, 20, 8, 20)]


@given(
    st.lists(st.lists(st.integers(0, 90), min_size=8, max_size=8), min_size=1, max_size=4),
    st.integers(0, 40_000),
)
def test_all_sides_of_boxes_go_in_straight_lines(ways, t_us) -> None:
    rows = [(first, *way[4 * n :][:4], CAR, track, 1)
            for n, first in enumerate((0, 40_000)) for track, way in enumerate(ways)]  # fmt: skip
    found = boxes_at(np.array(rows, BOX_RECORD), np.array([0, 40_000]), t_us)
    for track, way in enumerate(ways):
        own = found[found["track_id"] == track][0]
        for n, side in enumerate(("x", "y", "w", "h")):
            at = np.interp(t_us, (0, 40_000), (way[n], way[4 + n]))
            assert own[side] == pytest.approx(at, abs=1e-3)


def test_boxes_are_not_known_far_from_labelled_instants() -> None:
    boxes = crossing_boxes()
    rare = np.array([0, 240_000])
    assert boxes_at(boxes, rare, 120_000) is None
    assert places(boxes_at(boxes, rare, 220_000)) == [(20, 10, 20, 15), (40, 20, 8, 20)]
    assert boxes_at(boxes, INSTANTS, 265_001) is None
    assert boxes_at(boxes, INSTANTS[:0], 0) is None
    # An instant at which nothing is in view is not one that is unknown.
    assert len(boxes_at(boxes[boxes["t"] > 0], INSTANTS, 0)) == 0


def test_classes_gather_and_the_others_go() -> None:
    boxes = crossing_boxes()
    names = {CAR: "taxi", MAN: "man"}
    listed = ClassList.parse("pedestrian,car")
    assert listed.renumbered(boxes, names)["class_id"].tolist() == [1, 1, 1, *[1, 0] * 4]
    only = ClassList.parse("bus, person = man + woman").renumbered(boxes, names)
    assert set(only["class_id"].tolist()) == {1}
    assert len(only) == 4
    wrong = {"car,,b": "without a name, in 'car,,b'; give", "=car": "without a name",
             "v=": "nothing after =", "car,car": "'car' twice", "a=b,c=b": "'b' twice"}  # fmt: skip
    for text, said in wrong.items():
        with pytest.raises(ConfigError, match=said):
            ClassList.parse(text)


def test_times_below_0_do_not_become_late_ones() -> None:
    boxes = crossing_boxes()
    boxes["t"][0] = -1
    with pytest.raises(InputError, match="a box at -1 µs cannot be held"):
        records_of(boxes, LABEL_RECORD)
