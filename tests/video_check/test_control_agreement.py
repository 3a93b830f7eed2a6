"""Agreement of a video with a scene, by its definition."""

from types import SimpleNamespace

import cv2
import numpy as np
import pytest

from texvent.frames import Frame
from texvent.ground_truth import GroundTruth
from texvent.video_check.control_agreement import measure_agreement

HEIGHT, WIDTH, PERIOD_US = 36, 48, 40_000
Y, X = np.mgrid[:HEIGHT, :WIDTH]


def near(mask: np.ndarray, reach: int = 2) -> np.ndarray:
    """Whether a pixel is set within so many rows and columns."""
    wide = np.pad(mask, reach)
    return np.lib.stride_tricks.sliding_window_view(wide, (2 * reach + 1,) * 2).any(axis=(2, 3))


def make_scene(seed: int) -> tuple[list[Frame], list[GroundTruth]]:
    """Three frames, and the truth of each: things of which some move, and are partly hidden."""
    random = np.random.default_rng(seed)
    levels = cv2.GaussianBlur(random.normal(size=(HEIGHT, WIDTH)), (0, 0), 1.5)
    frames, known = [], []
    for number in range(3):
        ids = (X - number) // 12 + 4 * (Y // 18)
        flow = np.array([[0, 0], [1.5, 0], [3, 1], [-2, 0.5], [0.4, 0.2]])[ids % 5]
        places = X + flow[..., 0], Y + flow[..., 1]
        occluded = (places[0] < 0) | (places[0] > WIDTH - 1) | (places[1] > HEIGHT - 1)
        occluded |= (X // 4 + Y // 3) % 3 == 0
        depth = np.where(ids % 4 == 0, 5.0, 5.0 + ids % 3)  # some things are as far as others
        known.append(
            GroundTruth(
                depth=depth.astype(np.float32),
                instance=(ids // 2).astype(np.int32),
                flow=flow.astype(np.float32),
                occluded=occluded,
                boxes=(),
            )
        )
        pixels = 90 + 30 * levels / levels.std() + 50 * (ids % 2)
        frames.append(Frame(np.clip(pixels, 0, 255).astype(np.float32), PERIOD_US * number))
        back = (X - flow[..., 0]).astype(np.float32), (Y - flow[..., 1]).astype(np.float32)
        moved = cv2.remap(levels, *back, cv2.INTER_LINEAR)
        levels = np.where(occluded, random.permuted(levels, axis=1), moved)
        levels = cv2.GaussianBlur(levels, (0, 0), 0.8)
    return frames, known


def shares(one: Frame, other: Frame, truth: GroundTruth, after: np.ndarray) -> list[np.ndarray]:
    """Which borders show, and which moving pixels follow the flow."""
    border = np.zeros((HEIGHT, WIDTH), bool)
    for axis in (0, 1):
        ids = np.diff(truth.instance, axis=axis) != 0
        closer = np.exp(np.abs(np.diff(np.log(truth.depth), axis=axis))) > 1.25
        border |= np.pad(ids | closer, [(0, int(axis == side)) for side in (0, 1)])
    change = np.hypot(*(cv2.Sobel(one.luma, cv2.CV_32F, *way) for way in ((1, 0), (0, 1))))
    windows = np.pad(change, 2, constant_values=0)
    change = np.lib.stride_tricks.sliding_window_view(windows, (5, 5)).max(axis=(2, 3))
    shown = change[border] > np.quantile(change[~near(border, 4)], 0.8)
    before, later = (cv2.GaussianBlur(frame.luma, (0, 0), 1.0) for frame in (one, other))
    x, y = X + truth.flow[..., 0], Y + truth.flow[..., 1]
    there = cv2.remap(later, x.astype(np.float32), y.astype(np.float32), cv2.INTER_LINEAR)
    moved, rested = abs(there - before), abs(later - before)
    counts = np.zeros((HEIGHT, WIDTH), bool)
    is_near, is_front = near(border), near(truth.instance != after)
    for place in np.ndindex(HEIGHT, WIDTH):
        if truth.occluded[place] or np.hypot(*truth.flow[place]) < 0.5:
            continue
        is_inside = not is_near[place] and rested[place] >= 2
        counts[place] = is_inside or (is_front[place] and moved[place] + rested[place] >= 2)
    return [shown, (moved < rested)[counts]]


@pytest.mark.parametrize("seed", range(4))
def test_agreement_is_that_of_its_definition(seed: int) -> None:
    frames, known = make_scene(seed)
    times = [frame.t_us for frame in frames]
    scene = SimpleNamespace(ground_truth=lambda start, _: known[times.index(start)])
    video = type("Video", (list,), {"frame_count": 3})(frames)
    pairs = zip(frames, frames[1:], known, known[1:], strict=False)
    parts = [shares(one, other, truth, after.instance) for one, other, truth, after in pairs]
    found = measure_agreement(video, scene)
    for name, chance, each in zip(
        ("edges", "flow"), (0.2, 0.5), zip(*parts, strict=True), strict=True
    ):
        share = np.concatenate(each).mean()
        assert found[name] == round(max(0.0, (share - chance) / (1 - chance)), 3)
        assert found[name] > 0
