import json

import numpy as np
import pytest

from texvent.data.catalogue import DATA_SETS
from texvent.data.pull import pull
from texvent.errors import ConfigError, InputError
from texvent.events import EventStream
from texvent.truth.boxes import BOX_RECORD
from texvent_lab.bench.detection.labels import CLASSES, IGNORED, STREET, read_street_labels
from texvent_lab.bench.detection.precision import ALL, average_precision, bootstrap
from texvent_lab.frame_recordings import open_recording

KINDS = ("car", "bus")


def boxes(*rows):
    """Records of (t, x, class, confidence): boxes of 20 x 10 pixels."""
    records = [(t, x, 50, 20, 10, kind, 1, score) for t, x, kind, score in rows]
    return np.array(records, dtype=BOX_RECORD)


def counted(labels):
    return labels[labels["class_confidence"] > IGNORED]


def test_labels_are_continuous_tracks_in_the_picture():
    labels = read_street_labels()
    assert np.unique(counted(labels)["track_id"], return_counts=True)[1].tolist() == [59, 59, 28]
    assert not counted(labels)["class_id"].any()
    assert len(read_street_labels(("bus", "car"))) == np.sum(labels["class_id"] == 0)
    assert min(labels["x"].min(), labels["y"].min()) >= 0
    assert (labels["x"] + labels["w"]).max() <= 346
    assert (labels["y"] + labels["h"]).max() <= 260
    for track in range(1, 9):
        one = labels[labels["track_id"] == track]
        assert set(np.diff(one["t"])) <= {40_000, 40_001}
        assert max(np.abs(np.diff(one[side])).max() for side in "xywh") < 6


def test_boxes_between_keyframes_are_linear():
    labels = read_street_labels()
    first = labels[labels["track_id"] == 1]
    # Keyframes 0 and 5: x 48.0 and 67.2.
    np.testing.assert_allclose(first["x"][:6], [48, 51.84, 55.68, 59.52, 63.36, 67.2], rtol=1e-6)


@pytest.mark.network
def test_counted_boxes_hold_the_events_of_their_frames():
    recording = open_recording(pull("davis346"))
    labels, info = read_street_labels(), json.loads(STREET.read_text())["info"]
    assert info["sha256"] == DATA_SETS[info["recording"]].files[0].sha256
    assert [frame.t_us for frame in recording.frames] == np.unique(labels["t"]).tolist()
    events = EventStream.concat(list(recording.events))
    for box in counted(labels):
        near = events.cut(box["t"] - 20_000, box["t"] + 20_000)
        inside = (near.x >= box["x"]) & (near.x < box["x"] + box["w"])
        inside &= (near.y >= box["y"]) & (near.y < box["y"] + box["h"])
        assert inside.sum() > 60


def test_a_perfect_detector_scores_one_and_shifted_boxes_score_nothing():
    truth = read_street_labels()
    found = counted(truth)
    scores = average_precision(found, truth, classes=CLASSES)
    assert scores == pytest.approx({"car": 1, "pedestrian": np.nan, ALL: 1}, nan_ok=True)
    found["y"] -= 100
    assert average_precision(found, truth, classes=CLASSES)["car"] == 0
    assert average_precision(found[:0], truth, classes=CLASSES)["car"] == 0


# Half of the boxes are found: 51 of COCO's 101 recalls. A false box that is surer halves their
# precision; one that is less sure, or lies on an ignored box, costs nothing.
@pytest.mark.parametrize(
    ("x", "confidence", "expected"), [(60, 0.8, 1), (60, 0.95, 0.5), (90, 0.95, 1)]
)
def test_one_miss_and_one_false_positive_by_hand(x, confidence, expected):
    truth = boxes((0, 10, 0, 1), (1, 10, 0, 1), (1, 90, 0, IGNORED), (0, 10, 1, 1))
    # 16 of 20 columns of the bus are shared: 16 / 24 passes 4 of COCO's 10 overlaps.
    detections = boxes((0, 10, 0, 0.9), (1, x, 0, confidence), (0, 14, 1, 0.1))
    scores = average_precision(detections, truth, classes=KINDS)
    car = expected * 51 / 101
    assert scores == pytest.approx({"car": car, "bus": 0.4, ALL: (car + 0.4) / 2})


def test_samples_of_the_bootstrap_score_the_drawn_frames():
    draws = np.random.default_rng(1)
    truth = boxes(*((t, x, x > 50, 1) for t in range(20) for x in (10, 100)))
    found = truth[draws.random(40) < 0.8]
    found["x"] += draws.choice([0, 3, 40], len(found))
    found["class_confidence"] = draws.random(len(found))
    estimates = bootstrap(found, truth, classes=KINDS, block=6, samples=20, seed=3)

    def moved(records, chosen):
        parts = [records[records["t"] == frame] for frame in chosen]
        for number, part in enumerate(parts):
            part["t"] = number
        return np.concatenate(parts)

    draws = np.random.default_rng(3)
    for number in range(20):
        starts = draws.integers(15, size=4)
        chosen = np.concatenate([np.arange(start, start + 6) for start in starts])[:20]
        scores = average_precision(moved(found, chosen), moved(truth, chosen), classes=KINDS)
        for name, value in scores.items():
            assert estimates[name].samples[number] == pytest.approx(value)
    for name, value in average_precision(found, truth, classes=KINDS).items():
        assert estimates[name].value == value
        assert estimates[name].low < value < estimates[name].high
    whole = bootstrap(found, truth, classes=KINDS, block=20, samples=2)["car"]
    assert whole.low == whole.value == whole.high


def test_what_cannot_be_scored_is_refused():
    truth = boxes((0, 0, 0, 1))
    with pytest.raises(InputError, match="at 1 µs, where nothing is labelled"):
        average_precision(boxes((1, 0, 0, 1)), truth, classes=KINDS)
    with pytest.raises(InputError, match=r"class 2; .* car, bus: 0 to 1"):
        average_precision(boxes((0, 0, 2, 1)), truth, classes=KINDS)
    with pytest.raises(ConfigError, match="block is 2"):
        bootstrap(truth, truth, classes=KINDS, block=2)
