"""One sample: what ends its simulation, and the picture of its events and boxes."""

import io
import json

import cv2
import numpy as np
import pytest

from texvent.dataset.generation.make_sample import (
    SampleRun,
    SimulatedClip,
    npy_bytes,
    preview_png,
    sample_members,
    simulate_sample,
)
from texvent.dataset.specification.specification import Filters
from texvent.events import EventStream
from texvent.frames import Video
from texvent.pipeline import video_to_events
from texvent.sensor import SensorSize
from texvent.settings.resolution import resolve
from texvent.truth.boxes import BOX_RECORD
from texvent.truth.clip import ClipTruth

STEP_US = 10_000


@pytest.mark.parametrize("lacking", [None, 0, 1, 0.6])
def test_a_clip_of_more_events_than_are_allowed_is_not_simulated_to_its_end(lacking):
    pixels = np.random.default_rng(1).integers(0, 256, (6, 12, 16)).astype(np.uint8)
    video = Video(pixels, [STEP_US * number for number in range(6)])
    simulation = video_to_events(video, resolve("simulate", {"interpolate": "none"}))
    counts = np.cumsum([len(packet) for packet in simulation])
    total = int(counts[-1])
    lacking = round(lacking * total) if isinstance(lacking, float) else lacking
    most = None if lacking is None else total - lacking
    clip = simulate_sample(SampleRun(simulation, Filters(min_events=0, max_events=most)))
    ended = int(np.argmax(counts > most)) if lacking else len(counts) - 1
    assert (len(clip.events), clip.duration_us) == (counts[ended], STEP_US * ended)
    assert clip.left_out == (f"more than {most:,} events" if lacking else None)


def truth_of(times_us: list[int], *shown: int) -> ClipTruth:
    """One box that goes right, at some of the times."""
    boxes = np.zeros(len(shown), BOX_RECORD)
    boxes["t"], boxes["x"] = shown, np.array(shown) // STEP_US
    boxes["w"] = boxes["h"] = 9
    boxes["class_id"] = 2
    facts = {"parts": ["boxes"], "times_us": times_us, "classes": {"2": "car"}}
    run = {"width": 64, "height": 48, "truth": facts}
    members = {
        "json": json.dumps(run).encode(),
        "boxes.npy": npy_bytes(boxes),
        "visibility.npy": npy_bytes(np.ones(len(shown), np.float32)),
    }
    return ClipTruth(members.__getitem__, "the clip")


@pytest.mark.parametrize("began_us", [0, 400_000])
@pytest.mark.parametrize("busy_us", [0, 100_000, 163_000])
def test_the_picture_of_a_clip_has_its_busiest_50_ms_and_the_boxes_at_their_end(began_us, busy_us):
    t = began_us + np.r_[0, busy_us + np.arange(30) * 100, 200_000]
    x, y = np.arange(32) * 2, np.arange(32)
    events = EventStream.from_columns(x, y, np.sort(t), x % 2, size=SensorSize(64, 48))
    times_us = [began_us + STEP_US * number for number in range(26)]
    end_us = began_us + (busy_us // 50_000 + 1) * 50_000
    picture = preview_png(events, truth_of(times_us, *times_us))
    assert picture == preview_png(events, truth_of(times_us, end_us))
    assert picture != preview_png(events, truth_of(times_us, end_us - 3 * STEP_US))


@pytest.mark.parametrize("width", [20, 64, 100, 127, 129, 200, 256, 257, 640])
def test_boxes_lie_where_their_objects_are_in_a_picture_of_any_sensor(width):
    height, (x, y, w, h) = width * 3 // 4, (width // 4, width // 4, width // 2, width // 3)
    truth = truth_of([0], 0)
    truth.boxes[["x", "y", "w", "h"]] = x, y, w, h
    png = preview_png(EventStream.empty(SensorSize(width, height)), truth)
    image = cv2.imdecode(np.frombuffer(png, np.uint8), cv2.IMREAD_COLOR).astype(int)
    scale = image.shape[1] / width
    assert scale == min(256 / width, max(1, 256 // width))
    ink = image[..., 2] - image[..., 0] > 80
    across = np.flatnonzero(ink[round((y + h / 2) * scale)])
    down = np.flatnonzero(ink[:, round((x + w * 0.9) * scale)])
    np.testing.assert_allclose(across[[0, -1]], (x * scale, (x + w) * scale - 1), atol=2)
    assert down[-1] == pytest.approx((y + h) * scale - 1, abs=2)


@pytest.mark.parametrize("began_us", [0, -5, 2**32])
def test_members_of_a_sample_have_the_names_and_types_that_loaders_know(began_us):
    t = began_us + np.arange(9)
    events = EventStream(t % 4, t % 3, t, t % 2, SensorSize(4, 3))
    clip, facts = SimulatedClip(events, began_us, 9, 9), {"prompt": "a red bus", "seed": 3}
    members = sample_members(clip, facts, class_number=7, preview=False)
    columns = {name: np.load(io.BytesIO(members[f"{name}.npy"])) for name in "xytp"}
    assert list(members) == ["x.npy", "y.npy", "t.npy", "p.npy", "json", "txt", "cls"]
    times = np.uint32 if began_us == 0 else np.int64
    assert [one.dtype for one in columns.values()] == [np.uint16, np.uint16, times, np.uint8]
    assert all(np.array_equal(one, getattr(events, name)) for name, one in columns.items())
    assert (members["txt"], members["cls"]) == (b"a red bus", b"7")
    assert json.loads(members["json"]) == facts
    assert "cls" not in sample_members(clip, facts, class_number=None, preview=False)
