"""Boxes between labelled instants, by hand."""

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from tests.dataset.layouts.crossing import CAR, INSTANTS, MAN, crossing_boxes

from texvent.dataset.layouts.boxes import GATHERED, LABEL_RECORD, ClassList, boxes_at, records_of
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


def known_at(boxes: np.ndarray, instants: list[int], t_us: int) -> list[tuple[float, ...]] | None:
    """Track and place of the boxes at an instant; None where they are not known."""
    before = max((one for one in instants if one < t_us), default=None)
    after = min((one for one in instants if one >= t_us), default=None)
    ends = sorted((one for one in (before, after) if one is not None), key=lambda o: abs(o - t_us))
    if not ends:
        return None
    near, far = ({b["track_id"]: b for b in boxes if b["t"] == end} for end in (ends[0], ends[-1]))
    moves = len(ends) == 2 and abs(ends[1] - ends[0]) <= 100_000
    if not moves and abs(ends[0] - t_us) > 25_000:
        return None
    share = (t_us - ends[0]) / (ends[1] - ends[0]) if moves else 0.0
    return sorted(
        (int(track), *(box[n] + share * (far.get(track, box)[n] - box[n]) for n in "xywh"))
        for track, box in near.items()
    )


@pytest.mark.parametrize("tracks", [2, 3])
def test_boxes_are_known_near_labelled_instants_and_between_close_ones(tracks: int) -> None:
    random = np.random.default_rng(tracks)
    unknown = 0
    for _ in range(150):
        count = random.integers(0, 5)
        gaps = random.choice([25_000, 60_000, 99_999, 100_000, 100_001, 200_000], count)
        instants = (1000 + np.cumsum(gaps)).tolist()
        rows = [
            (t_us, *random.uniform(1, 30, 4), CAR, track, 1)
            for t_us in instants
            for track in range(tracks)
            if random.random() < 0.8  # an instant may show nothing
        ]
        boxes = np.array(rows, BOX_RECORD)
        places = instants or [0]
        t_us = int(random.choice(places) + random.choice([-25_001, -25_000, 0, 7, 25_000, 25_001]))
        found, expected = (
            boxes_at(boxes, np.array(instants, np.int64), t_us),
            known_at(boxes, instants, t_us),
        )
        if expected is None or found is None:
            assert expected is found
            unknown += 1
            continue
        assert found["t"].tolist() == [t_us] * len(expected)
        rows = sorted((int(one["track_id"]), *(float(one[n]) for n in "xywh")) for one in found)
        np.testing.assert_allclose(rows, expected, rtol=1e-5)
    assert 30 < unknown < 120


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


NOUNS = ("taxi", "bus", "cyclist", "sign", "dog")


@example(["car", "bus"], [[], ["taxi"], [], []])  # stated, and usually gathered by another
@given(
    st.lists(st.sampled_from([*GATHERED, *NOUNS]), min_size=1, max_size=4, unique=True),
    st.lists(st.lists(st.sampled_from(NOUNS), max_size=3, unique=True), min_size=4, max_size=4),
)
def test_a_class_counts_where_it_is_stated_or_under_the_first_name_that_usually_gathers_it(
    names, stated
):
    taken = set()
    gathered = [[one for one in each if one not in names and not (one in taken or taken.add(one))]
                for each in stated]  # fmt: skip
    entries = [f"{name}={'+'.join((name, *each))}" if each else name
               for name, each in zip(names, gathered, strict=False)]  # fmt: skip
    numbers = ClassList.parse(",".join(entries)).numbers
    for noun in {*NOUNS, *names, *(one for each in GATHERED.values() for one in each)}:
        said = [n for n, entry in enumerate(entries) if noun in entry.partition("=")[2].split("+")]
        said += [n for n, entry in enumerate(entries) if entry == noun]
        said += [n for n, entry in enumerate(entries) if noun in GATHERED.get(entry, ())]
        assert numbers.get(noun) == (said[0] if said else None), noun


def test_times_below_0_do_not_become_late_ones() -> None:
    boxes = crossing_boxes()
    boxes["t"][0] = -1
    with pytest.raises(InputError, match="a box at -1 µs cannot be held"):
        records_of(boxes, LABEL_RECORD)
