"""Windows, halves and scores of objects, against plain definitions."""

from dataclasses import fields, replace
from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from texvent.dataset import read_specification
from texvent.events import EventStream
from texvent.frames import Frame
from texvent.sensor import SensorSize
from texvent.truth.boxes import BOX_RECORD
from texvent_lab.bench.objects import clips
from texvent_lab.bench.objects.arms import Arm
from texvent_lab.bench.objects.clips import count_pixels, make_windows
from texvent_lab.bench.objects.plan import Run
from texvent_lab.bench.objects.recorded import SIDE, Frames
from texvent_lab.bench.objects.results import ObjectsReport, WindowSet, objects_tables, score_all

from .stand_in import write_specifications

KINDS = ("mug", "fork", "key")
SEEDS = st.integers(0, 2**32 - 1).map(np.random.default_rng)
SETS = {name: WindowSet(0.25, 900, 7, 0.125) for name in ("texvent", "other")}


def windows_of(rng, counts, *, has_boxes):
    """Windows of each kind, whose boxes hold events in some."""
    classes = np.repeat(np.arange(len(counts)), counts)
    side = SIDE if has_boxes else 16
    images = rng.choice(np.array([-1, 0, 1], np.int8), (len(classes), side, side),
                        p=[0.006, 0.99, 0.004])  # fmt: skip
    boxes = np.full((len(classes), 4), np.nan, np.float32)
    if has_boxes:
        boxes[:] = np.stack([*rng.integers(0, 60, (2, len(classes))),
                             *rng.integers(24, 60, (2, len(classes)))], axis=1)  # fmt: skip
        for image, (x, y, w, h) in zip(images[::2], boxes[::2].astype(int), strict=True):
            image[y : y + h, x : x + w] = -1
    return Frames(images, classes, boxes, classes)


@given(rng=SEEDS)
def test_accuracy_is_the_mean_over_recordings_of_the_share_of_windows_that_are_right(rng):
    recorded = windows_of(rng, rng.integers(4, 25, 3), has_boxes=False)
    names = ("texvent", "other", None)
    found = {name: list(rng.integers(0, 3, (2, len(recorded.classes)))) for name in names}
    *rows, floor = score_all(recorded, KINDS, SETS, found)
    assert [row.arm for row in rows] == ["texvent", "other", "recorded"]
    for row, guesses in zip(rows, found.values(), strict=True):
        shares = [
            [np.mean([g == k for g, c in zip(one, recorded.classes, strict=True) if c == k])
             for k in range(3)] for one in guesses
        ]  # fmt: skip
        assert row.scores["accuracy"] == pytest.approx([np.mean(one) for one in shares])
        of_kinds = [row.scores[kind] for kind in KINDS]
        assert np.array(of_kinds) == pytest.approx(np.transpose(shares))
        assert row.interval[0] <= row.interval[1]
    assert [rows[0].difference, rows[2].difference] == [None, None]
    one_kind = [np.zeros_like(recorded.classes)]  # right in all windows of one recording of three
    row = score_all(recorded, KINDS, SETS, {"texvent": one_kind})[0]
    assert [*row.interval, *row.scores["accuracy"]] == pytest.approx([1 / 3] * 3)
    less = np.mean(rows[1].scores["accuracy"]) - np.mean(rows[0].scores["accuracy"])
    assert rows[1].difference[0] == pytest.approx(less)
    logs = np.log1p([np.count_nonzero(one) for one in recorded.images])
    right = []
    for number in range(1, len(logs), 2):
        chances = []
        for kind in range(3):
            known = logs[::2][recorded.classes[::2] == kind]
            sd = known.std() + 1e-3
            chances.append(-((logs[number] - known.mean()) ** 2) / (2 * sd**2) - np.log(sd))
        right.append((recorded.classes[number], np.argmax(chances) == recorded.classes[number]))
    shares = [np.mean([is_right for k, is_right in right if k == kind]) for kind in range(3)]
    assert floor.scores["accuracy"] == pytest.approx([np.mean(shares)])


@pytest.mark.parametrize(("run", "least", "most"), [(1, 0.0, 0.0), (2, 0.0, 0.0), (20, 0.1, 0.6)])
def test_intervals_are_those_of_blocks_of_ten_windows(run, least, most):
    """Windows that are right in turns of few have no chance, those in turns of many have."""
    recorded = windows_of(np.random.default_rng(0), (80, 80, 80), has_boxes=False)
    is_right = np.arange(240) // run % 2 == 0
    guess = np.where(is_right, recorded.classes, (recorded.classes + 1) % 3)
    rows = score_all(recorded, KINDS, SETS, {"texvent": [guess], "other": [recorded.classes]})
    low, high = rows[0].interval
    assert least <= high - low <= most + 1e-9 + (0.1 if run == 2 else 0.0)
    assert rows[1].interval == [1.0, 1.0]
    assert rows[1].difference == pytest.approx([0.5, 1 - high, 1 - low])


@given(rng=SEEDS)
def test_best_boxes_overlap_by_half_and_have_the_class_of_their_frame(rng):
    recorded = windows_of(rng, (3, 3, 3), has_boxes=True)
    found = np.zeros(40, BOX_RECORD)
    found["t"], found["class_id"] = rng.integers(0, 9, 40), rng.integers(0, 3, 40)
    found["class_confidence"] = rng.permutation(40) / 41
    for side, values in zip("xywh", recorded.boxes[found["t"]].T, strict=True):
        found[side] = values + rng.integers(-12, 13, 40)
    row = score_all(recorded, KINDS, SETS, {"texvent": [found]})[0]
    located = right = 0
    for frame, (x, y, w, h) in enumerate(recorded.boxes.tolist()):
        own = found[found["t"] == frame]
        if len(own):
            bx, by, bw, bh = (float(max(own, key=lambda one: one["class_confidence"])[side])
                              for side in "xywh")  # fmt: skip
            shared = max(min(bx + bw, x + w) - max(bx, x), 0) * max(
                min(by + bh, y + h) - max(by, y), 0
            )
            located += shared / (bw * bh + w * h - shared) >= 0.5
            best = own[np.argmax(own["class_confidence"])]
            right += int(best["class_id"]) == recorded.classes[frame]
    assert row.scores["located"] == pytest.approx([located / 9])
    assert row.scores["class"] == pytest.approx([right / 9])


def test_precision_asks_for_visible_objects_first_and_the_table_says_so():
    recorded = windows_of(np.random.default_rng(3), (4, 4, 4), has_boxes=True)
    assert recorded.is_visible.tolist() == [True, False] * 6
    found = np.zeros(6, BOX_RECORD)
    found["t"], found["class_id"] = np.arange(0, 12, 2), recorded.classes[::2]
    found["class_confidence"] = 0.5
    for side, values in zip("xywh", recorded.boxes[::2].T, strict=True):
        found[side] = values
    rows = score_all(
        recorded, KINDS, SETS, {"texvent": [found], "other": [found[:0]], None: [found]}
    )
    best, lost, _ = rows
    assert next(iter(best.scores.items())) == ("AP50 visible", [1.0])
    assert best.scores["AP50"] == pytest.approx([0.5], abs=0.02)
    assert [best.scores[f"AP50 visible, {kind}"] for kind in KINDS] == [[1.0]] * 3
    assert lost.difference == [-1.0, -1.0, -1.0]
    report = ObjectsReport({}, {}, [lost, rows[2], best], [lost, rows[2], best], 1.0)
    lines = [line for line in objects_tables(report).splitlines() if line.startswith("|")]
    head, _, first, second, third = ([one.strip() for one in line.split("|")] for line in lines[:5])
    assert head[1:7] == ["trained on", "δ", "pixels with an event", "AP50 visible", "95 %",
                         "less texvent"]  # fmt: skip
    assert first[1:7] == ["texvent", "0.25", "0.125", "1.000", "[1.000, 1.000]", "–"]
    assert second[1:7] == ["other", "0.25", "0.125", "0.000", "[0.000, 0.000]",
                           "-1.000 [-1.000, -1.000]"]  # fmt: skip
    assert third[1:4] == ["recorded", "–", "–"]


@given(rng=SEEDS, sides=st.lists(st.integers(2, 12), min_size=3, max_size=3))
def test_halves_are_the_first_and_the_second_of_each_recording_or_of_the_poses(rng, sides):
    frames, poses = (windows_of(rng, one, has_boxes=False) for one in (sides, (4, 4, 4)))
    poses = replace(poses, classes=np.arange(12) % 3, groups=5 + np.arange(12) // 3)
    run = Run(SimpleNamespace(seeds=3), {"table": poses, "turntable": frames})
    for fold in (0, 1):
        expected = [2 * place // side == fold for side in sides for place in range(side)]
        assert run.half("turntable", fold).tolist() == expected
        assert run.half("table", fold).tolist() == [n // 6 == fold for n in range(12)]
    for test, one in run.recorded.items():
        assert run.target(test) == pytest.approx(np.count_nonzero(one.images) / one.images.size,
                                                 abs=5e-5)  # fmt: skip
    arms = [run.trainings("table", arm) for arm in ("texvent", None)]
    assert [[(one.seed, one.fold) for one in row] for row in arms] == [
        [(0, 0), (1, 0), (2, 0)], [(seed, fold) for seed in range(3) for fold in (0, 1)]
    ]  # fmt: skip


@given(rng=SEEDS)
def test_windows_of_clips_follow_the_first_and_keep_the_last_polarity(rng, tmp_path_factory):
    folder, streams, lengths = tmp_path_factory.mktemp("clips"), {}, (400_000, 330_000)
    for number, end_us in enumerate(lengths):
        path, t_us = folder / f"{number}.npz", np.linspace(0, end_us, 9).astype(int)
        count = len(range(100_000, end_us - 99_999, 100_000))
        boxes = np.full((count, 4), number, np.float32)
        np.savez(path, luma=np.zeros((9, SIDE, SIDE), np.float16), t_us=t_us, boxes=boxes)
        x, y = rng.integers(0, 5, (2, 300))
        t, p = np.sort(rng.integers(0, end_us, 300)), rng.integers(0, 2, 300)
        streams[path] = EventStream(x, y, t, p, SensorSize(SIDE, SIDE))
    asked = []
    frames, events = make_windows(
        [*streams], [4, 2], lambda path, one: asked.append(one) or streams[path], [0.1, None]
    )
    expected = []
    for one, end_us in zip(streams.values(), lengths, strict=True):
        for start in range(100_000, end_us - 99_999, 100_000):
            image = np.zeros((SIDE, SIDE), np.int8)
            for x, y, t, p in zip(one.x, one.y, one.t, one.p, strict=True):
                if start <= t < start + 100_000:
                    image[y, x] = 1 if p else -1
            expected.append(image)
    assert np.array_equal(frames.images, expected)
    assert (frames.classes.tolist(), frames.groups.tolist()) == ([4, 4, 4, 2, 2], [0, 0, 0, 1, 1])
    assert (frames.boxes[:, 0].tolist(), events, asked) == ([0, 0, 0, 1, 1], 600, [0.1, None])
    count, pixels = count_pixels([*streams], lambda path, one: streams[path])
    assert (count(0.3), pixels) == (np.count_nonzero(expected), len(expected) * SIDE * SIDE)


def test_a_clip_has_a_box_in_the_middle_of_each_window_after_the_first(tmp_path, monkeypatch):
    class Film:
        asked = ()

        def __iter__(self):
            return iter(
                Frame(np.zeros((SIDE, SIDE), np.uint8), t) for t in range(0, 450_001, 50_000)
            )

        def instances_at(self, t_us, points):
            self.asked += (t_us,)
            return None, np.ones(len(points))

    film, item = Film(), SimpleNamespace(key="a", subject="a", label="mug")
    seeds = []
    monkeypatch.setattr(clips, "make_video", lambda _, made: seeds.append(made.run.seed) or film)
    for key in "abba":
        clips.render_clip(SimpleNamespace(**{**vars(item), "key": key}), {}, tmp_path / "other.npz")
    assert seeds[:2] == seeds[:1:-1]
    assert seeds[0] != seeds[1]
    film.asked = ()
    clips.render_clip(item, {"sensor": "128x128"}, tmp_path / "clip.npz")
    assert film.asked == (150_000, 250_000, 350_000)
    with np.load(tmp_path / "clip.npz") as found:
        assert found["boxes"].tolist() == [[-5, -5, SIDE + 10, SIDE + 10]] * 3
        assert found["t_us"].tolist() == [*range(0, 450_001, 50_000)]


def test_options_of_an_arm_reach_its_runs_and_clips_have_seeds_of_their_own(tmp_path):
    runs = [clips._settings(tmp_path / name, options) for name in ("a.npz", "b.npz", "a.npz")
            for options in ({}, {"interpolate": "blend", "balance": 7.5})]  # fmt: skip
    assert [one.interpolate.interpolate for one in runs] == ["none", "blend"] * 3
    assert [one.simulate.balance == 7.5 for one in runs] == [False, True] * 3
    seeds = [one.run.seed for one in runs]
    assert seeds[:2] == seeds[4:] != seeds[2:4]
    assert seeds[0] == seeds[1]


def other(value):
    """Another value of a field of an arm."""
    kinds = {"exact": "frames", "": "v2v", (): (0.2,), 0.0: 0.3, None: SimpleNamespace(digest="x")}
    if isinstance(value, dict):
        return {**value, "noise": "random"}
    return kinds[value] if isinstance(value, str | tuple | float | None) else None


@pytest.mark.parametrize("field", [one.name for one in fields(Arm)])
def test_windows_of_an_arm_are_named_after_every_fact_of_it(field, tmp_path):
    write_specifications(tmp_path / "configs")
    specification = read_specification(tmp_path / "configs" / "table.toml")
    arm = Arm(specification, {"preset": "paper"})
    if field == "specification":
        changed = replace(specification, options={**specification.options, "fps": 30})
    else:
        changed = other(getattr(arm, field))
    recorded = {"table": windows_of(np.random.default_rng(0), (1,), has_boxes=True)}
    arms = {"a": arm, "again": replace(arm), "b": replace(arm, **{field: changed})}
    run = Run(SimpleNamespace(sets={"table": arms}, work=tmp_path), recorded)
    first, again, second = (run.windows_path("table", name) for name in arms)
    assert first == again != second


@pytest.mark.parametrize(
    ("object_px", "box"),
    [
        ((30, 50, 60, 70), [25, 45, 40, 30]),
        ((30, 50, 34, 52), [20, 39, 24, 24]),
        (None, [np.nan] * 4),
    ],
)
def test_a_box_has_the_margin_and_the_least_side_of_recorded_ones(object_px, box):
    left, top, right, bottom = object_px or (0, 0, 0, 0)

    def instances_at(t_us, points):
        x, y = points.T
        is_in = (x > left) & (x < right) & (y > top) & (y < bottom)
        return None, np.where(is_in, 1, 2)

    found = clips._box(SimpleNamespace(instances_at=instances_at), 0)
    np.testing.assert_array_equal(found, box)
