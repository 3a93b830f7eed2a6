"""FireNet and FireNet+ with their real weights, where these and slider_depth lie here."""

from pathlib import Path

import numpy as np
import pytest

from texvent.data.pull import find_pulled
from texvent.represent.slices import slice_between
from texvent_lab.frame_recordings import open_recording
from texvent_lab.reconstruct.reconstructor import load_reconstructor

pytestmark = pytest.mark.torch
pytest.importorskip("torch")

WEIGHTS = Path(__file__).parents[4] / "shared" / "weights"
SKIPPED = 10


def uniform_similarity(a, b):
    """SSIM with a 7×7 uniform window and population covariance, which the figures below are of."""
    windows = np.lib.stride_tricks.sliding_window_view

    def mean(x):
        return windows(x, (7, 7)).mean(axis=(2, 3))

    mean_a, mean_b = mean(a), mean(b)
    variances = mean(a * a) - mean_a**2 + mean(b * b) - mean_b**2
    covariance = mean(a * b) - mean_a * mean_b
    ssim = (2 * mean_a * mean_b + 1e-4) * (2 * covariance + 9e-4)
    return (ssim / ((mean_a**2 + mean_b**2 + 1e-4) * (variances + 9e-4))).mean()


@pytest.mark.parametrize(
    ("name", "file", "ssim", "mse"),
    [
        ("firenet", "firenet.pth", 0.443, 0.1115),
        ("firenet+", "firenet_plus_state_dict.pth", 0.465, 0.0406),
    ],
)
def test_slider_depth_is_reconstructed_as_measured_before(name, file, ssim, mse):
    path, pulled = WEIGHTS / file, find_pulled("slider_depth")
    if not path.is_file() or pulled is None:
        pytest.skip(f"{path} or the recording slider_depth is not here, so nothing was compared")
    recording = open_recording(pulled)
    reconstructor = load_reconstructor(name, path, device="cpu")
    frames = list(recording.frames)
    times_us = [frame.t_us for frame in frames]
    slices = slice_between(recording.events, times_us, size=recording.frames.size)
    images = [image.astype(np.float64) for _, image in reconstructor.reconstruct_all(slices)]
    truth = [frame.pixels / 255.0 for frame in frames[1:]]
    pairs = list(zip(images, truth, strict=True))[SKIPPED:]
    assert np.mean([((a - b) ** 2).mean() for a, b in pairs]) == pytest.approx(mse, abs=6e-5)
    assert np.mean([uniform_similarity(a, b) for a, b in pairs]) == pytest.approx(ssim, abs=6e-4)
