"""An embedded video can begin at any frame."""

from __future__ import annotations

import numpy as np

from texvent.generate.procedural import ProceduralConfig, ProceduralGenerator
from texvent.sensor import SensorSize


def test_frames_from_one_on_are_those_of_the_whole_video():
    generator = ProceduralGenerator(ProceduralConfig(duration=0.2), size=SensorSize(48, 36))
    video = generator.generate("a ball bounces").with_motion()
    whole, late = list(video), list(video.from_frame(3))
    assert len(late) == len(whole) - 3
    for expected, frame in zip(whole[3:], late, strict=True):
        assert frame.t_us == expected.t_us
        np.testing.assert_array_equal(frame.pixels, expected.pixels)
        assert (frame.motion.forward is None) == (expected.motion.forward is None)
