"""RIFE's published weights on a real recording: the figures of docs/interpolation.md."""

import cv2
import numpy as np
import pytest

from texvent.config import InterpolateConfig
from texvent.data.pull import pull
from texvent.frames import Frame
from texvent.interpolate.rife.interpolator import RifeInterpolator
from texvent.weights import pull_weights

pytestmark = [pytest.mark.network, pytest.mark.torch]
pytest.importorskip("torch")
pytest.importorskip("safetensors")


@pytest.mark.parametrize(
    ("weights", "layout", "expected_db"), [("rife", "4.0", 33.12), ("rife-4.6", "4.6", 33.36)]
)
def test_held_out_frames_of_slider_depth_are_guessed_as_documented(
    weights, layout, expected_db, psnr, stream
):
    folder = pull("slider_depth") / "images"
    frames = [cv2.imread(str(path), cv2.IMREAD_GRAYSCALE) for path in sorted(folder.glob("*.png"))]
    config = InterpolateConfig(interpolator_weights=pull_weights(weights))
    interpolator = RifeInterpolator(config, stream)
    scores = []
    for i in range(2, 82, 8):
        pair = Frame(frames[i], 0), Frame(frames[i + 4], 1000)
        (guess,) = interpolator.between(*pair, [500])
        scores.append(psnr(guess.pixels, frames[i + 2]))
    assert float(np.mean(scores)) == pytest.approx(expected_db, abs=0.02)
