"""Control videos of scenes: depth, edges, ids or motion of every frame, as models were shown them.

* depth: inverse depth, from the farthest (black) to the nearest (white) of the whole clip, as
  Cosmos-Transfer2.5 normalises it; VACE does it frame by frame. The sky is black.
* edges: Canny's of the rendered frames, with Cosmos-Transfer2.5's thresholds, white on black.
* ids: a flat colour for each object on black.
* flow: motion from the frame before as hue and saturation, the fastest of the clip saturated;
  white rests. The first frame shows that of the second one, as in VACE.
"""

from __future__ import annotations

import colorsys
import itertools
from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from texvent.frames import frame_time_us
from texvent.ground_truth import GroundTruth

Pixels = NDArray[np.uint8]
EDGE_THRESHOLDS = (100, 200)
"""Thresholds of Canny's gradient, levels: "medium" of Cosmos-Transfer2.5."""
HUE_STEP = 0.618_034
"""Golden ratio: hues of following ids lie far apart."""
WHEEL = ((255, 0, 0, 15), (255, 255, 0, 6), (0, 255, 0, 4), (0, 255, 255, 11), (0, 0, 255, 13),
         (255, 0, 255, 6))  # fmt: skip
"""Colours around the wheel of motions, and steps from each to the next.

Source: Baker et al., A database and evaluation methodology for optical flow (IJCV 2011).
"""


def draw_control(scene: Any, kind: str) -> Pixels:
    """The control video of a scene, [N, H, W, 3], 0..255.

    Args:
        scene: frames that know their ground truth.
        kind: a name of `KINDS`.
    """
    return KINDS[kind](scene)


def times_of(scene: Any) -> list[int]:
    """Times of the frames of a scene, µs."""
    return [frame_time_us(index, scene.fps) for index in range(scene.frame_count)]


def draw_depth(scene: Any) -> Pixels:
    """Inverse depth, normalised over the clip."""
    depth = np.stack([_truth(scene, t_us, t_us).depth for t_us in times_of(scene)])
    near = np.reciprocal(np.maximum(depth, np.float32(1e-3)), out=depth)  # that of the sky is 0
    low, high = float(near.min()), float(near.max())
    near -= np.float32(low)
    near *= np.float32(255 / max(high - low, 1e-9))
    return _grey(np.rint(near).astype(np.uint8))


def draw_edges(scene: Any) -> Pixels:
    """Edges of the rendered frames."""
    found = []
    for frame in scene:
        luma = np.rint(np.clip(frame.luma, 0, 255)).astype(np.uint8)
        found.append(cv2.Canny(luma, *EDGE_THRESHOLDS))
    return _grey(np.stack(found).astype(np.uint8))


def draw_ids(scene: Any) -> Pixels:
    """A flat colour for each object."""
    ids = np.stack([_truth(scene, t_us, t_us).instance for t_us in times_of(scene)])
    drawn: Pixels = id_colours(int(ids.max(initial=0)))[np.maximum(ids, 0)]
    return drawn


def id_colours(highest: int) -> Pixels:
    """Colours of the ids up to the highest, [n, 3]; 0 is black.

    Example:
        >>> id_colours(2).tolist()
        [[0, 0, 0], [46, 99, 230], [153, 230, 46]]
    """
    hues = [colorsys.hsv_to_rgb(number * HUE_STEP % 1, 0.8, 0.9) for number in range(highest + 1)]
    colours: Pixels = np.rint(255 * np.array(hues)).astype(np.uint8)
    colours[0] = 0
    return colours


def draw_flow(scene: Any) -> Pixels:
    """Motion from the frame before."""
    times = times_of(scene)
    pairs = itertools.pairwise(times)
    vectors = np.stack([_truth(scene, first, second).flow for first, second in pairs])
    np.nan_to_num(vectors, copy=False)
    fastest = max(float(np.hypot(*np.moveaxis(one, -1, 0)).max()) for one in vectors)
    # Frame by frame: colours of a whole clip take gigabytes before they are rounded.
    drawn = np.stack([_colours_of(one, max(fastest, 1e-9)) for one in vectors])
    return np.concatenate([drawn[:1], drawn])


def _colours_of(vectors: NDArray[np.float32], fastest: float) -> Pixels:
    """Motion [H, W, 2] as colours [H, W, 3]; the fastest is saturated, rest is white."""
    share = np.hypot(vectors[..., 0], vectors[..., 1]) / fastest
    turn = np.arctan2(-vectors[..., 1], -vectors[..., 0]) / (2 * np.pi) + 0.5  # 0..1, right is 0
    wheel = _wheel()
    place = turn * len(wheel)
    below = place.astype(np.intp) % len(wheel)
    part = (place - np.floor(place))[..., None]
    hue = (1 - part) * wheel[below] + part * wheel[(below + 1) % len(wheel)]
    colours: Pixels = np.rint(255 * (1 - share[..., None] * (1 - hue))).astype(np.uint8)
    return colours


def _wheel() -> NDArray[np.float64]:
    """Colours around the wheel, [n, 3], 0..1."""
    rows = []
    for (*start, steps), (*stop, _) in zip(WHEEL, (*WHEEL[1:], WHEEL[0]), strict=True):
        part = np.arange(steps)[:, None] / steps
        rows.append((1 - part) * np.array(start) + part * np.array(stop))
    return np.asarray(np.concatenate(rows) / 255)


KINDS: Mapping[str, Callable[[Any], Pixels]] = MappingProxyType(
    {"depth": draw_depth, "edges": draw_edges, "ids": draw_ids, "flow": draw_flow}
)
"""Name → drawing of the clip."""


def _truth(scene: Any, t0_us: int, t1_us: int) -> GroundTruth:
    truth: GroundTruth = scene.ground_truth(t0_us, t1_us)
    return truth


def _grey(levels: Pixels) -> Pixels:
    return np.repeat(levels[..., None], 3, axis=-1)
