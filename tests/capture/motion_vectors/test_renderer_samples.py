"""Samples in the layouts of other renderers give the vectors that they were made of."""

from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

import texvent
from texvent.capture.motion_vectors.frames import find_motion_sidecar
from texvent.capture.open import open_frames
from texvent.config import CaptureConfig
from texvent.errors import InputError
from texvent.view.drawing.event_image import frame_image

pytest.importorskip("OpenEXR")
HERE = Path(__file__).parent
BLENDER, UNREAL = HERE / "blender_sample", HERE / "unreal_sample"
ISAAC, CARLA = HERE / "isaac_sample", HERE / "carla_sample"
SAMPLES = {
    "isaac": (
        ISAAC,
        {
            "motion": ISAAC / "motion_vectors_*.npy",
            "depth": ISAAC / "distance_to_image_plane_*.npy",
            "motion_convention": "isaac",
        },
    ),
    "carla": (
        CARLA / "rgb",
        {"motion": CARLA / "flow", "motion_convention": "carla"},
    ),
    "unreal": (UNREAL, {"motion": UNREAL, "depth_scale": 0.01}),
}
EXACT_PX = {"isaac": 0.0, "carla": 1e-5, "unreal": 0.05}
"""Unreal's half floats are 1/2048 apart around 0.5: a thousandth of the image's width."""


def frames_of(name, **more):
    source, options = SAMPLES[name]
    return list(open_frames(source, CaptureConfig(fps=Fraction(24), **{**options, **more})))


@pytest.mark.parametrize("name", SAMPLES)
def test_a_sample_gives_the_vectors_it_was_made_of(name):
    truth = list(open_frames(BLENDER, CaptureConfig(motion=BLENDER / "motion")))
    frames = frames_of(name)
    assert len(frames) == len(truth)
    assert all(frame.motion.forward is None for frame in frames)
    assert frames[0].motion.backward is None
    for frame, true in zip(frames[1:], truth[1:], strict=True):
        np.testing.assert_allclose(
            frame.motion.backward, true.motion.backward, rtol=0, atol=EXACT_PX[name]
        )
        if name == "carla":  # its depth images are for the user to decode
            assert frame.motion.depth is None
        else:
            np.testing.assert_allclose(frame.motion.depth, true.motion.depth, rtol=1e-3)
        shown, true_shown = (frame_image(one).astype(int) for one in (frame, true))
        assert np.abs(shown - true_shown).max() <= 1


@pytest.mark.parametrize("name", SAMPLES)
def test_another_renderer_s_convention_is_refused(name):
    wrong = {"isaac": "standard", "carla": "carla,y-down", "unreal": "unreal,y-down"}[name]
    with pytest.raises(InputError, match="do not fit the frames"):
        frames_of(name, motion_convention=wrong)


def test_passes_within_the_frames_are_found():
    assert find_motion_sidecar(UNREAL) == UNREAL
    events = texvent.simulate(UNREAL, fps=24, depth_scale=0.01, noise="none")
    assert events.metadata["source"]["motion_convention"] == "unreal"
