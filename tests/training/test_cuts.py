"""Cuts of clips against their definition, frame by frame."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from texvent.sensor import SensorSize
from texvent.training.cuts import CutPlan, cut_clip
from texvent.training.draws import ClipDraw, ClipRanges
from texvent.training.sources import TRUTH, Clip
from texvent.truth.boxes import BOX_RECORD

WIDTH, HEIGHT, COUNT = 9, 7, 11
SHARES = st.sampled_from([0.0, 0.25, 0.5, 0.999])


def drawn_clip(seed: int) -> Clip:
    """Frames, times, depth, flow and boxes, all different."""
    rng = np.random.default_rng(seed)
    frames = rng.integers(0, 256, (COUNT, HEIGHT, WIDTH), np.uint8)
    times_us = np.cumsum(rng.integers(1, 10**5, COUNT)) - 10**5
    boxes = np.zeros(2 * COUNT, BOX_RECORD)
    boxes["t"], boxes["x"] = times_us.repeat(2), rng.uniform(-3, WIDTH, 2 * COUNT)
    boxes["y"] = rng.uniform(-3, HEIGHT, 2 * COUNT)
    boxes["w"], boxes["h"], boxes["class_id"] = 3, 2, rng.integers(0, 5, 2 * COUNT)
    flow = rng.normal(size=(COUNT - 1, 2, HEIGHT, WIDTH)).astype(np.float32)
    depth = rng.random((COUNT, HEIGHT, WIDTH), np.float32)
    return Clip(frames, times_us, {"flow": flow, "depth": depth, "boxes": boxes})


@given(
    seed=st.integers(0, 99),
    paused=st.lists(st.booleans(), min_size=4, max_size=4),
    place=st.tuples(SHARES, SHARES, SHARES),
    speed=st.tuples(st.integers(1, 2), st.integers(0, 3), SHARES),
    is_flipped=st.booleans(),
    per=st.sampled_from([1, 2]),
)
def test_a_cut_has_the_frames_times_and_truth_of_its_place(
    seed, paused, place, speed, is_flipped, per
):
    clip, size, (slow, more, share) = drawn_clip(seed), SensorSize(5, 4), speed
    ranges = ClipRanges(speed=(slow, slow + more))
    truth = TRUTH if per == slow + more == 1 else ("depth", "boxes")
    plan = CutPlan(size, len(paused), per, ranges, truth)
    draw = ClipDraw(np.uint64(1), np.zeros(0), is_flipped, share, np.array(place), np.array(paused))
    cut = cut_clip(clip, draw, plan, np.zeros((len(paused) + 1, *size.shape), np.uint8))
    speeds = range(slow, min(slow + more, (COUNT - 1) // len(paused)) + 1)
    step = speeds[int(share * len(speeds))]
    shown = [0]
    for is_paused in paused:
        shown.append(shown[-1] + (0 if is_paused else step))
    first = int(place[0] * (COUNT - shown[-1]))
    top, left = int(place[1] * (HEIGHT - 3)), int(place[2] * (WIDTH - 4))
    assert cut.place == (first, top, left, step)
    # A pause takes time and no frame: at the end of a clip its last times are those.
    began = min(first, COUNT - 1 - len(paused))
    times_us = clip.times_us[began : began + len(shown)]
    assert cut.times_us.tolist() == (times_us - times_us[0]).tolist()
    ends = [first + one for one in shown[per::per]]

    def seen(field):
        part = field[..., top : top + 4, left : left + 5]
        return part[..., ::-1] if is_flipped else part

    for found, one in zip(cut.frames, shown, strict=True):
        assert np.array_equal(found, seen(clip.frames[first + one]))
    assert np.array_equal(cut.truth["depth"], [seen(clip.truth["depth"][one]) for one in ends])
    for at, is_paused in enumerate(paused if "flow" in truth else ()):
        flow = seen(clip.truth["flow"][min(first + shown[at], COUNT - 2)]).copy()
        flow[0] *= -1 if is_flipped else 1
        assert np.array_equal(cut.truth["flow"][at], flow * (not is_paused))
    for found, one in zip(cut.truth["boxes"], ends, strict=True):
        expected = []
        for box in clip.truth["boxes"][clip.truth["boxes"]["t"] == clip.times_us[one]]:
            x = box["x"] - left
            x = 5 - x - box["w"] if is_flipped else x
            x0, x1, y = max(x, 0), min(x + box["w"], 5), box["y"] - top
            y0, y1 = max(y, 0), min(y + box["h"], 4)
            if x1 > x0 and y1 > y0:
                expected.append([x0, y0, x1, y1])
        assert np.allclose(found["boxes"], np.reshape(expected, (-1, 4)), atol=1e-5)
