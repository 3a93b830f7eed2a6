"""Classes and streams chosen by the paper's rules, from files as N-ImageNet has them."""

import math
from pathlib import Path

import numpy as np
import pytest

from texvent.events import EventStream
from texvent.sensor import SensorSize
from texvent_lab.nt_imagenet.selection import choose_classes, median_speed, select_streams

from .tiny_data import WNIDS, stream_id, write_n_imagenet

COUNTS = {
    WNIDS[1]: {5: 4_000, 6: 2_999, 7: 3_000},
    WNIDS[0]: {1: 3_500, 2: 170_001, 3: 170_000, 4: 9_000},
    WNIDS[2]: {8: 10},
}


@pytest.fixture(scope="module")
def n_imagenet(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write_n_imagenet(tmp_path_factory.mktemp("data") / "N_Imagenet", COUNTS)


def test_streams_in_range_are_taken_in_order_of_their_ids(n_imagenet):
    chosen = select_streams(n_imagenet, WNIDS[:2], per_class=2)
    assert [one.id for one in chosen.streams] == [stream_id(n) for n in (1, 3, 5, 7)]
    assert [one.events for one in chosen.streams] == [3_500, 170_000, 4_000, 3_000]
    assert chosen.too_many == (stream_id(2),)
    assert chosen.too_few == (stream_id(6),)
    assert all(0 < one.duration_us <= 50_000 for one in chosen.streams)
    assert chosen.incomplete(2) == {}
    assert chosen.incomplete(3) == {wnid: 2 for wnid in WNIDS[:2]}


def test_the_first_classes_in_order_of_their_ids_are_taken_unless_named(n_imagenet, tmp_path):
    (n_imagenet / "extracted_val" / "notes.txt").touch()
    assert choose_classes(n_imagenet, 2) == WNIDS[:2]
    listed = tmp_path / "classes.txt"
    listed.write_text(f"{WNIDS[2]} great white shark\n\n{WNIDS[0]}\n")
    assert choose_classes(n_imagenet, 2, listed) == (WNIDS[2], WNIDS[0])


def test_a_damaged_file_costs_that_stream_alone(tmp_path):
    folder = write_n_imagenet(tmp_path, {WNIDS[0]: {1: 3_000, 2: 3_000}})
    path = folder / "extracted_val" / WNIDS[0] / f"{stream_id(1)}.npz"
    path.write_bytes(path.read_bytes()[:2_000])
    chosen = select_streams(folder, WNIDS[:1])
    assert [one.id for one in chosen.streams] == [stream_id(2)]
    assert list(chosen.unreadable) == [stream_id(1)]


def test_speed_is_that_of_an_edge_in_any_direction():
    size = SensorSize(40, 30)
    y, x = np.indices(size.shape)
    for dx, dy in ((200.0, 0.0), (0.0, -150.0), (90.0, 120.0)):
        t = 1e6 * (x * dx + y * dy) / (dx**2 + dy**2)
        order = np.argsort(t, axis=None, kind="stable")
        t = np.rint(t - t.min()).astype(int).ravel()[order]
        columns = (x.ravel()[order], y.ravel()[order], t, np.ones(x.size, int))
        edge = EventStream(*columns, size)
        assert median_speed(edge) == pytest.approx(np.hypot(dx, dy), rel=1e-3)
        # What fires at once beside the edge, as by a lamp, does not move.
        flash = EventStream(*(one[edge.y < 20] for one in columns), size)
        late = np.full((10, 40), flash.t[-1] + 1)
        lit = EventStream(x[20:].ravel(), y[20:].ravel(), late.ravel(), late.ravel() > 0, size)
        both = EventStream.concat([flash, lit])
        assert median_speed(both) == pytest.approx(np.hypot(dx, dy), rel=1e-2)
    assert math.isnan(median_speed(EventStream.empty(size)))
    assert math.isnan(median_speed(EventStream([1, 2], [1, 1], [0, 5], [1, 1], size)))
