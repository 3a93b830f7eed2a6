"""Pictures on surfaces: files, videos by their own times, boards, text; bad ones in a line."""

from fractions import Fraction
from pathlib import Path

import av
import cv2
import numpy as np
import pytest

from texvent.errors import InputError
from texvent_scenes.models.nouns import NOUNS
from texvent_scenes.models.protocol import Pose
from texvent_scenes.models.tables import nouns_with
from texvent_scenes.pictures import PicturedModel, check_picture, load_picture
from texvent_scenes.spec.scene import Picture


def write_video(path: Path, levels: list[int], pts: list[int]) -> Path:
    with av.open(str(path), "w") as container:
        stream = container.add_stream("ffv1", rate=10)
        stream.width, stream.height, stream.pix_fmt = 16, 16, "bgr0"
        stream.codec_context.time_base = Fraction(1, 100)
        for level, time in zip(levels, pts, strict=True):
            frame = av.VideoFrame.from_ndarray(np.full((16, 16, 3), level, np.uint8), "rgb24")
            frame.pts, frame.time_base = time, Fraction(1, 100)
            container.mux(stream.encode(frame))
        container.mux(stream.encode())
    return path


def test_a_video_is_shown_by_its_own_times_and_plays_again(tmp_path):
    path = write_video(tmp_path / "clip.mkv", [0, 255, 128, 64], [0, 10, 40, 50])
    source = load_picture(Picture("file", str(path)))

    def level(time_s: float) -> float:
        return float(source(time_s).levels[0].mean())

    assert level(0.0) == pytest.approx(0.0, abs=0.01)
    assert level(0.11) == pytest.approx(1.0, abs=0.01)
    assert level(0.39) == pytest.approx(1.0, abs=0.01)
    assert level(0.41) == pytest.approx(0.216, abs=0.01)
    assert level(0.05) == pytest.approx(0.0, abs=0.01)
    assert level(0.61) == pytest.approx(0.0, abs=0.01)
    assert source(0.11) is source(0.2)


def test_an_image_file_is_read_in_linear_light(tmp_path):
    path = tmp_path / "grey.png"
    cv2.imwrite(str(path), np.full((5, 7, 3), 188, dtype=np.uint8))
    image = load_picture(Picture("file", str(path)))(0.0)
    assert image.levels[0].shape == (5, 7, 3)
    assert image.levels[0].mean() == pytest.approx(0.503, abs=1e-3)


@pytest.mark.parametrize(
    ("picture", "message"),
    [
        (Picture("file", "no-such.png"), "does not exist"),
        (Picture("checkerboard", "9 by 6"), "such as 9x6"),
        (Picture("checkerboard", "1x6"), "such as 9x6"),
        (Picture("text", " "), "0 characters"),
        (Picture("text", "x" * 300), "300 characters"),
        (Picture("text", "Größe"), "ASCII"),
    ],
)
def test_a_bad_picture_is_one_clear_line(picture, message):
    with pytest.raises(InputError, match=message) as caught:
        check_picture(picture)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("noun", sorted(nouns_with("shows a picture")))
def test_a_picture_takes_the_place_of_what_is_usually_printed(noun):
    model = NOUNS[noun].build(colour=None, scale=1.0, seed=0)
    pictured = PicturedModel(model, noun, Picture("checkerboard", "9x6"))
    pose = Pose(0.0, 0.0, 0.0)
    parts = pictured.parts(pose)
    assert [part.image is not None for part in parts] == [True] + [False] * (len(parts) - 1)
    assert 1 <= len(parts) <= len(model.parts(pose))
    assert len(parts) == len(pictured.parts(Pose(1.0, 0.0, 0.0)))
