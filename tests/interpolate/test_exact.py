"""Frames rendered by the scene itself, and none at all."""

from __future__ import annotations

import numpy as np
import pytest

from texvent.errors import ConfigError
from texvent.interpolate.simple import ExactInterpolator
from texvent.video import Frame, Video


class Brightening(Video):
    """A grey field that brightens by one level per 100 µs, at any instant."""

    def at(self, t_us: int) -> Frame:
        return Frame(np.full((4, 4, 3), t_us / 100, np.float32), t_us, is_source=False)


@pytest.fixture
def renderable() -> Brightening:
    return Brightening(np.stack([np.zeros((4, 4, 3)), np.full((4, 4, 3), 10.0)]), [0, 1000])


def test_exact_frames_are_what_the_scene_shows_then(renderable, config):
    exact = ExactInterpolator(config(interpolate="exact"), renderable)
    frames = list(exact.between(renderable[0], renderable[1], [250, 999]))
    assert [frame.t_us for frame in frames] == [250, 999]
    for frame, level in zip(frames, (2.5, 9.99), strict=True):
        assert frame.pixels.shape == (4, 4)
        assert frame.pixels.dtype == np.float32
        assert frame.pixels == pytest.approx(level, abs=1e-4)
        assert not frame.is_source


def test_exact_fails_on_a_recorded_video_and_names_the_choices(stream, config):
    with pytest.raises(ConfigError, match="use flow, blend or none"):
        ExactInterpolator(config(interpolate="exact"), stream)
