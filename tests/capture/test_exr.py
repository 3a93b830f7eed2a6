from pathlib import Path

import numpy as np
import pytest

import texvent
from texvent.capture.exr_image import exr_frame
from texvent.capture.image_folder import coding_facts
from texvent.capture.motion_vectors.fields import read_file
from texvent.capture.motion_vectors.frames import find_motion_sidecar
from texvent.capture.open import open_frames
from texvent.cli.app import main
from texvent.config import CaptureConfig
from texvent.errors import FileFormatError, InputError

OpenEXR = pytest.importorskip("OpenEXR")
BLENDER = Path(__file__).parent / "motion_vectors" / "blender_sample"
"""Three frames of a ball that shoots past pillars, rendered by Blender 5.0 at 48x36."""


def write(path, channels, **header):
    planes = {name: np.ascontiguousarray(plane, np.float32) for name, plane in channels.items()}
    facts = {"compression": OpenEXR.ZIP_COMPRESSION, "type": OpenEXR.scanlineimage, **header}
    OpenEXR.File(facts, planes).write(str(path))
    return path


def colour(plane):
    return {"R": plane, "G": plane, "B": plane}


def test_light_is_neither_clipped_nor_rounded(tmp_path):
    light = np.linspace(0, 20, 12).reshape(3, 4)
    pixels = exr_frame(write(tmp_path / "a.exr", colour(light)))
    assert pixels.shape == (3, 4, 3)
    assert pixels.dtype == np.float32
    assert np.array_equal(pixels[..., 1], light.astype(np.float32))
    grey = exr_frame(write(tmp_path / "y.exr", {"Y": light}))
    assert np.array_equal(grey, light.astype(np.float32))
    half = exr_frame(write(tmp_path / "h.exr", {"Y": light.astype(np.float16)}))
    assert half.dtype == np.float32


@pytest.mark.parametrize(
    ("header", "message"),
    [
        ({"colorInteropID": "pq_rec2020_display"}, r"coded \('pq_rec2020_display'\); only linear"),
        (
            {"chromaticities": (0.708, 0.292, 0.17, 0.797, 0.131, 0.046, 0.3127, 0.329)},
            "other primaries than Rec. 709",
        ),
    ],
)
def test_what_is_not_linear_rec_709_is_refused(tmp_path, header, message):
    path = write(tmp_path / "a.exr", colour(np.ones((2, 2))), **header)
    with pytest.raises(InputError, match=message):
        exr_frame(path)


def test_damage_and_missing_colour_are_one_line(tmp_path):
    whole = write(tmp_path / "a.exr", colour(np.ones((8, 8)))).read_bytes()
    (tmp_path / "cut.exr").write_bytes(whole[: len(whole) // 2])
    with pytest.raises(FileFormatError, match=r"cut\.exr is damaged or not OpenEXR"):
        exr_frame(tmp_path / "cut.exr")
    with pytest.raises(InputError, match=r"has no colour \(R, G, B or Y\); its channels: Depth\.Z"):
        exr_frame(write(tmp_path / "z.exr", {"Depth.Z": np.ones((2, 2))}))
    layers = {f"{layer}.Vector.{axis}": np.ones((2, 2)) for layer in "AB" for axis in "XYZW"}
    with pytest.raises(FileFormatError, match=r"several channels Vector\.X \(A\.Vector\.X, B\.V"):
        read_file(write(tmp_path / "layers.exr", layers), "motion")
    with pytest.raises(InputError, match=r"no pass that is known .*; its channels: B, G, R"):
        read_file(tmp_path / "a.exr", "motion")
    (tmp_path / "z.exr").with_suffix(".png").write_bytes(b"")
    with pytest.raises(InputError, match=r"a\.exr is linear light and z\.png is gamma-coded; fram"):
        coding_facts([tmp_path / "a.exr", tmp_path / "z.png"])


def test_a_real_render_of_blender():
    assert find_motion_sidecar(BLENDER) == BLENDER / "motion"
    config = CaptureConfig(motion=BLENDER / "motion")  # checked: warped against real frames
    frames = list(open_frames(BLENDER, config))
    assert [frame.t_us for frame in frames] == [0, 41_667, 83_333]
    middle = frames[1].motion
    assert np.abs(middle.forward + middle.backward).max() < 2.0  # nearly even motion
    assert np.hypot(*middle.forward.T).max() > 3.0  # the ball
    assert 3.0 < middle.depth.min() < middle.depth.max() < 30.0
    assert len(np.unique(middle.instance)) >= 5
    for words in ("blender,y-down", "y-down"):  # the file names its renderer itself
        with pytest.raises(InputError, match="motion_convention=blender,y-down,y-up; give that"):
            open_frames(BLENDER, CaptureConfig(motion=BLENDER / "motion", motion_convention=words))


def test_simulate_takes_the_folder_that_the_script_makes(tmp_path, capsys):
    out = tmp_path / "out.h5"
    assert (
        main(["simulate", str(BLENDER), "-o", str(out), "--previews", "none", "--noise", "none"])
        == 0
    )
    source = texvent.open(out).metadata["source"]
    assert source["motion"] == {"motion": str(BLENDER / "motion")}
    assert source["motion_convention"] == "blender"
    assert len(source["motion_fingerprint"]) == 64
    assert len(texvent.load(out)) == len(texvent.simulate(BLENDER, noise="none"))
