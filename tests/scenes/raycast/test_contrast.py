"""Contrast of pictures: mean gradients of log light per pixel are as high as those of photographs.

Photographs of skies have about .004, rooms .06; speckle noise would have far more.
"""

import cv2
import numpy as np
import pytest

from texvent.sensor import SensorSize
from texvent.transfer import decode_srgb
from texvent_scenes.procedural import ProceduralConfig, ProceduralGenerator

SIZE, AT_US = SensorSize(346, 260), 500_000
SKIES = (
    "a car on a road", "a dog runs across a meadow", "a bird flies over a lake", "a tree in a park",
    "a horse gallops along a beach", "a train leaves a station", "a tractor on a field",
)  # fmt: skip
ROOMS = (
    "handheld shot of an office", "the camera moves forward along a corridor",
    "walking through a library", "the camera pans through a kitchen",
    "the camera orbits a laptop on a desk in a laboratory", "handheld shot of a living room",
    "handheld shot of a classroom",
)  # fmt: skip


pytestmark = pytest.mark.filterwarnings("ignore::texvent.TexventWarning")


def gradients(text):
    """[H, W] |∂x ln I| of a picture smoothed over three pixels, and where there is sky."""
    video = ProceduralGenerator(ProceduralConfig(duration=1.0), size=SIZE).generate(text)
    light = decode_srgb(np.asarray(video.at(AT_US).pixels, np.float64) / 255.0)
    grey = cv2.blur(light.mean(axis=-1), (3, 3))
    sky = np.isinf(video.ground_truth(AT_US, AT_US + 10_000).depth).astype(np.uint8)
    inner = cv2.erode(sky, np.ones((5, 5), np.uint8)) > 0
    return np.abs(np.gradient(np.log(np.maximum(grey, 0.01)), axis=1)), inner


def test_skies_have_the_contrast_of_those_in_photographs():
    means = [found[sky].mean() for found, sky in map(gradients, SKIES) if sky.sum() > 2000]
    assert len(means) >= 5
    assert 0.0035 < np.median(means) < 0.006
    assert max(means) < 0.009


def test_rooms_have_the_contrast_of_those_in_photographs():
    means = [gradients(text)[0].mean() for text in ROOMS]
    assert 0.05 < np.median(means) < 0.08
    assert max(means) < 0.1
