"""Statistics of bursts, on events counted by hand."""

from pathlib import Path

import numpy as np
import pytest

from texvent import EventStream, SensorSize
from texvent.truth.boxes import BOX_RECORD
from texvent_lab.bench.document import read_document
from texvent_lab.measure import street
from texvent_lab.measure.street import FOCAL, as_markdown, inside, measure, two_cars
from texvent_scenes.scene_input import describe_scene, list_nouns
from texvent_scenes.staging.compose import compose_scene

ROOT = Path(__file__).parents[3]
SIZE = SensorSize(8, 4)
ROWS = [  # x, y, ms, polarity
    (1, 1, 0, 1), (1, 1, 4, 1), (1, 1, 10, 1),  # an edge: gaps of 4 and 6 ms
    (1, 1, 12, 0),  # the next has the other polarity
    (1, 1, 60, 0),  # and one after a pause
    (2, 1, 1, 1), (7, 3, 30, 0),
]  # fmt: skip


def stream(rows=ROWS):
    x, y, t, p = np.array(sorted(rows, key=lambda row: row[2])).T
    return EventStream.from_columns(x, y, 1000 * t, p, size=SIZE)


def test_soon_runs_and_gaps_are_those_counted_by_hand():
    row = measure("street", stream(), 80.0, 30.0)
    assert (row.events, row.speed_px_s, row.length_px) == (7, 80.0, 30.0)
    assert row.soon == pytest.approx(2 / 7)  # after 4 ms and, of either polarity, after 2 ms
    assert row.run == pytest.approx((3 * 3 + 4 * 1) / 7)
    assert row.gap_ms == 5.0
    assert "| street | 80 | 30 | 7 | 29 | 1.9 | 5.0 |" in as_markdown([vars(row)])


def test_events_of_a_car_are_those_in_its_box_as_it_moves():
    boxes = np.zeros(2, BOX_RECORD)
    boxes["t"], boxes["x"], boxes["y"], boxes["w"], boxes["h"] = (0, 60_000), (1, 21), 1, 1, 1
    # The margin is 4 px: after 12 ms the box begins at x = 5, and 1 is outside.
    assert inside(stream(), boxes).t.tolist() == [0, 1000, 4000, 10_000]


def test_the_table_of_the_design_notes_is_that_of_the_stored_result():
    rows = read_document(ROOT / "docs/results/street.json.gz")["rows"]
    assert as_markdown(rows) in (ROOT / "docs/design.md").read_text(encoding="utf-8")


def test_speeds_and_lengths_are_those_of_the_image_of_the_camera(monkeypatch):
    scenes = []
    monkeypatch.setattr(
        street.texvent, "generate", lambda scene, **_: scenes.append(scene) or stream()
    )
    rows = [*street.simulated_rows()]
    assert len(rows) == len(scenes) >= 8
    for row, scene in zip(rows, scenes, strict=True):
        half = np.tan(np.radians(scene.camera.field_of_view_deg) / 2)
        px_per_m = street.SIZE.width / 2 / half / np.linalg.norm(scene.camera.position_m)
        speed_m_s = scene.objects[0].motions[0].speed_m_s
        assert row.speed_px_s == pytest.approx(px_per_m * speed_m_s)
        assert row.length_px == pytest.approx(px_per_m * street.CAR_M)


def test_two_cars_pass_each_other_before_the_camera():
    camera = two_cars(44.0).camera
    assert 0.5 / np.tan(np.radians(camera.field_of_view_deg) / 2) == pytest.approx(FOCAL)
    description = describe_scene(two_cars(44.0), list_nouns())
    scene = compose_scene(description, seed=0, size=SensorSize(346, 260), duration_s=1.0)
    first, second = (one.track.at(0.75).position[0] - one.track.at(0.25).position[0]
                     for one in scene.actors)  # fmt: skip
    assert (first, second) == pytest.approx((5.0, -5.0), abs=0.01)
    assert np.linalg.norm(scene.camera(0.5).position) == pytest.approx(44.0, abs=0.1)
