"""Changes of brightness: measured from scenes, and played back as frames."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest

import texvent
from texvent.video import Frame
from texvent_lab.latents.change import BrightnessChange, measure_change


class Ramp:
    """A video of 9 frames at 8 fps whose one row of pixels brightens by 8 · x levels a second."""

    fps, frame_count, is_live, metadata = Fraction(8), 9, False, {}
    size = texvent.SensorSize(3, 1)

    def at(self, t_us: int) -> Frame:
        levels = 8.0 * t_us / 1e6 * np.arange(3)[None]
        return Frame(levels.astype(np.float32), t_us, is_source=False)

    def __iter__(self):
        return (self.at(125_000 * index) for index in range(9))


def test_voxels_are_differences_of_the_balanced_logarithm_at_the_bounds_of_bins() -> None:
    change = measure_change(Ramp(), 2, frames_per_latent=4, balance=10.0)
    assert change.voxels.shape == (2, 2, 1, 3)
    assert change.edges_us.tolist() == [0, 250_000, 500_000, 750_000, 1_000_000]
    # Pixel 2 goes 0, 4, 8, 12, 16: ln(14 / 10), ln(18 / 14), ln(22 / 18), ln(26 / 22).
    expected = np.log([14 / 10, 18 / 14, 22 / 18, 26 / 22])
    np.testing.assert_allclose(change.voxels[..., 0, 2].ravel(), expected, rtol=1e-6)
    assert not change.voxels[..., 0].any()


def test_frames_after_the_last_whole_interval_are_left_out() -> None:
    assert measure_change(Ramp(), 3, frames_per_latent=5).voxels.shape == (1, 3, 1, 3)


def test_frames_repeat_the_changes_of_the_scene() -> None:
    change = measure_change(Ramp(), 2, frames_per_latent=4)
    frames = list(change.frames())
    assert [one.t_us for one in frames] == change.edges_us.tolist()
    brightness = np.log(30 + np.stack([one.luma for one in frames]))
    np.testing.assert_allclose(
        np.diff(brightness, axis=0), change.voxels.reshape(4, 1, 3), atol=1e-5
    )


def test_a_pixel_that_falls_below_black_stays_black() -> None:
    change = BrightnessChange(np.full((1, 2, 1, 1), -3, np.float32), Fraction(24), 4)
    assert [float(one.pixels[0, 0]) for one in change.frames()] == pytest.approx([255, 0, 0])
