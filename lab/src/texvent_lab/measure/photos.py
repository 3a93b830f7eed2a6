"""What docs/photos.md says: how many px an image needs, how true parallax is, and its picture.

python -m texvent_lab.measure.photos [IMAGE.png]
"""

from __future__ import annotations

import math
import sys
import tempfile
from pathlib import Path
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

import texvent
from texvent.capture.camera_path.opening import open_photo
from texvent.config import CaptureConfig
from texvent.sensor import SensorSize
from texvent.truth.poses import pose_row
from texvent.view.drawing.event_image import draw_events
from texvent.view.drawing.palettes import get_palette

SCENE = "a red car and two trees and a house and a dog in front of a fence"
SENSOR = SensorSize(170, 126)
FINEST = SensorSize(1472, 1120)
SIZES = (4, 2, 1)
"""Px of the image for each of 184x140."""
VIEW = SensorSize(346, 260)
MOVES = (
    "the camera orbits a parked car in front of a house",
    "the camera moves forward past a house",
)
WINDOW_US = 100_000, 160_000


def measure_sizes() -> None:
    """Saccades over images of fewer px, against those over the finest."""
    video: Any = texvent.video(SCENE, sensor=str(FINEST), duration=0.1)
    finest = np.clip(video.at(0).luma, 0, 255)
    reference = _saccades(finest)
    for px in SIZES:
        image = cv2.resize(finest, (184 * px, 140 * px), interpolation=cv2.INTER_AREA)
        events = _saccades(image)
        score = texvent.compare(events, reference, ["stpp"])["stpp"]
        along = events.metadata["source"]["image_px_per_px"]
        print(f"{along:.2f} px: STPP {score:.3f}, {len(events) / len(reference):.0%} of the events")


def measure_parallax() -> None:
    """One image with depth, moved by a scene's poses, against the scene rendered there."""
    for prompt in MOVES:
        scene: Any = texvent.video(prompt, sensor=str(VIEW), duration=1.0)
        large: Any = texvent.video(prompt, sensor=(4 * VIEW.width, 4 * VIEW.height), duration=1.0)
        with tempfile.TemporaryDirectory() as folder:
            poses = Path(folder) / "poses.txt"
            times = range(0, 200_001, 10_000)
            poses.write_text("".join(pose_row(t_us, scene.camera_at(t_us)) for t_us in times))
            fov = math.degrees(2 * math.atan(0.5 / large.camera_at(0).focal))
            options = CaptureConfig(camera=str(poses), camera_fov=fov)
            image = np.clip(large.at(0).luma, 0, 255)
            depth = large.ground_truth(0, 0).depth
            # Pixel by pixel, so that nothing is cut off; then averaged to the scene's size.
            video = open_photo(image, options, depth=depth)
        for t_us in (0, 50_000, 100_000, 200_000):
            true, first = scene.at(t_us).luma, scene.at(0).luma
            seen = cv2.resize(video.at(t_us).pixels, tuple(VIEW), interpolation=cv2.INTER_AREA)
            moved = np.linalg.norm(scene.camera_at(t_us).position - scene.camera_at(0).position)
            error, still = (np.sqrt(np.mean(_inside(one - true) ** 2)) for one in (seen, first))
            print(f"{prompt}, {moved:.2f} m: rms error {error:.1f} levels, unmoved {still:.1f}")


def draw(path: Path) -> None:
    """An image, and events of a pan over it, flat and with depth."""
    video: Any = texvent.video(
        "a red car in front of a house and two trees at noon", sensor=(1384, 1040), duration=0.1
    )
    image = np.clip(video.at(0).pixels, 0, 255).astype(np.uint8)
    options: dict[str, Any] = {"camera": "pan", "camera_amplitude": 100.0, "duration": 0.3}
    options |= {"sensor": str(VIEW), "noise": "none", "contrast_threshold": 0.12}
    tiles = [cv2.resize(image, tuple(VIEW), interpolation=cv2.INTER_AREA)]
    for has_depth in (False, True):
        if has_depth:
            options["depth"] = video.ground_truth(0, 0).depth
        events = _simulate(image, **options)
        part = events[(events.t >= WINDOW_US[0]) & (events.t < WINDOW_US[1])]
        counts = np.zeros((2, *VIEW.shape), np.int64)
        np.add.at(counts, (part.p, part.y, part.x), 1)
        tiles.append(np.asarray(draw_events(counts, get_palette("paper"))))
    cv2.imwrite(str(path), np.concatenate(tiles, axis=1)[..., ::-1])


def _simulate(image: NDArray[Any], **options: Any) -> texvent.EventStream:
    events: texvent.EventStream = texvent.simulate(image, **options)
    return events


def _saccades(image: NDArray[Any]) -> texvent.EventStream:
    return _simulate(image, camera="saccade", sensor=str(SENSOR), simulator="esim")


def _inside(image: NDArray[Any]) -> NDArray[Any]:
    return image[20:-20, 30:-30]


if __name__ == "__main__":
    if len(sys.argv) > 1:
        draw(Path(sys.argv[1]))
    else:
        measure_sizes()
        measure_parallax()
