"""Pictures on surfaces: files, videos by their own times, boards, text; bad ones in a line."""

from pathlib import Path

import cv2
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.capture.conftest import ClipWriter
from tests.examples import examples
from tests.scenes.hand_scenes import HandScene
from tests.scenes.staged import stage, thing

from texvent.camera import PosedCamera
from texvent.errors import InputError
from texvent.sensor import SensorSize
from texvent_scenes.mesh import decode_srgb
from texvent_scenes.models.nouns import NOUNS
from texvent_scenes.models.protocol import Pose
from texvent_scenes.models.tables import nouns_with
from texvent_scenes.pictures import CACHED_FRAMES, PicturedModel, check_picture, load_picture
from texvent_scenes.raycast.render import render, render_light
from texvent_scenes.spec.scene import Picture
from texvent_scenes.staging.actors import PlacedModel, assemble
from texvent_scenes.staging.placement.tags import list_pictures


def write_video(path: Path, levels: list[int], pts: list[int]) -> Path:
    frames = [np.full((16, 16, 3), level, np.uint8) for level in levels]
    writer = ClipWriter(path.parent)
    return writer.write(path.name, frames, codec="ffv1", stored="bgr0", times_ms=pts, ticks=100)


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


@pytest.fixture(scope="module")
def long_video(tmp_path_factory):
    """Of more frames than are kept; frame n is at 0.1 n s."""
    count = CACHED_FRAMES + 3
    path = tmp_path_factory.mktemp("video") / "long.mkv"
    return write_video(path, [30 * n for n in range(count)], [10 * n for n in range(count)])


@given(st.lists(st.integers(0, 3 * (CACHED_FRAMES + 3)), min_size=1, max_size=30))
@examples(20)
def test_a_video_shows_the_frame_of_each_instant_in_any_order(long_video, numbers):
    source = load_picture(Picture("file", str(long_video)))
    for number in numbers:
        level = decode_srgb(np.uint8(30 * (number % (CACHED_FRAMES + 3))))
        assert source(0.1 * number + 0.05).levels[0].mean() == pytest.approx(float(level), abs=0.02)


def test_an_image_file_is_read_in_linear_light_and_anew_when_it_changes(tmp_path):
    path = tmp_path / "grey.png"
    for size, code, light in (((5, 7), 188, 0.503), ((6, 9), 64, 0.0513)):
        cv2.imwrite(str(path), np.full((*size, 3), code, dtype=np.uint8))
        image = load_picture(Picture("file", str(path)))(0.0)
        assert image.levels[0].shape == (*size, 3)
        assert image.levels[0].mean() == pytest.approx(light, abs=1e-3)


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


SHOWING = pytest.mark.parametrize("noun", sorted(nouns_with("shows a picture")))
POSE = Pose(0.0, 0.0, 0.0)


@SHOWING
def test_a_picture_takes_the_place_of_what_is_usually_printed(noun):
    model = NOUNS[noun].build(colour=None, scale=1.0, seed=0)
    pictured = PicturedModel(model, noun, Picture("checkerboard", "9x6"))
    parts = pictured.parts(POSE)
    assert [part.image is not None for part in parts] == [True] + [False] * (len(parts) - 1)
    assert 1 <= len(parts) <= len(model.parts(POSE))
    assert len(parts) == len(pictured.parts(Pose(1.0, 0.0, 0.0)))


class Model(HandScene):
    """The parts of a model, drawn from before the face of the first one."""

    def primitives(self, time_s):
        return assemble([PlacedModel(self.shapes, np.eye(3, 4), 1)])

    def camera(self, time_s):
        to_body = self.shapes[0].to_body
        normal, right, up = (side / np.linalg.norm(side) for side in to_body[:, :3].T)
        middle = to_body[:, :3] @ [1.0, 0.0, 0.0] + to_body[:, 3]
        away = 2.0 * np.linalg.norm(to_body[:, 1:3])
        return PosedCamera(middle + away * normal, np.array([right, -up, -normal]), 1.0)


@SHOWING
@pytest.mark.parametrize("sides", [(60, 20), (30, 40)])
def test_a_picture_is_whole_upright_and_in_its_own_shape(noun, sides, tmp_path):
    """Red, green and blue quarters, and a grey one: where geometry puts them on the face."""
    (across, down), path = sides, tmp_path / "quarters.png"
    rgb = np.full((down, across, 3), 90, np.uint8)
    for number in range(3):
        rows, columns = divmod(number, 2)
        rgb[rows * down // 2 :][: down // 2, columns * across // 2 :][:, : across // 2] = 0
        rgb[rows * down // 2 :][: down // 2, columns * across // 2 :][:, : across // 2, number] = (
            255
        )
    cv2.imwrite(str(path), rgb[..., ::-1])
    model = NOUNS[noun].build(colour=(0.6, 0.6, 0.6), scale=1.0, seed=0)
    parts = PicturedModel(model, noun, Picture("file", str(path))).parts(POSE)
    scene, size = Model(tuple(parts)), SensorSize(80, 80)
    light = render_light(scene, 0.0, size, shadows=False)
    wide, high = 2.0 * np.linalg.norm(parts[0].to_body[:, 1:3], axis=0)
    width, height = min(wide, high * across / down), min(high, wide * down / across)
    metres = np.linalg.norm([wide, high]) / 80  # of a pixel, `away` being the diagonal of the face
    x, y = np.meshgrid(*2 * [(np.arange(80) + 0.5 - 40) * metres])
    u, v = x / width, y / height
    inner = [np.abs(one) < 0.45 for one in (u, v)] + [np.abs(one) > 0.05 for one in (u, v)]
    expected = (u > 0.0) + 2 * (v > 0.0)
    judged = np.all(inner, axis=0) & (expected < 3)
    assert np.mean(light.argmax(axis=2)[judged] == expected[judged]) > 0.97
    margin = (np.maximum(np.abs(u), np.abs(v)) > 0.55) & (np.abs(x) < 0.45 * wide)
    margin &= np.abs(y) < 0.45 * high
    colourful = np.ptp(light, axis=2) > 0.5 * light.max(axis=2)
    assert colourful[judged].mean() > 0.97
    assert not margin.any() or colourful[margin].mean() < 0.05


def detected_tags(scene, size, time_s=0.0):
    """Ids of AprilTags that a detector finds in a picture."""
    image = np.clip(render(scene, time_s, size), 0.0, 255.0).astype(np.uint8)
    family = cv2.aruco.getPredefinedDictionary(cv2.aruco.DICT_APRILTAG_36h11)
    _, ids, _ = cv2.aruco.ArucoDetector(family).detectMarkers(image)
    return set() if ids is None else set(ids.ravel().tolist())


def tag_board(tag, count=1):
    picture = None if tag is None else Picture("tag", str(tag))
    return thing("april tag", count=count, picture=picture)


@given(st.lists(st.one_of(st.none(), st.integers(0, 580)), min_size=1, max_size=2, unique=True),
       st.integers(1, 2))  # fmt: skip
def test_every_april_tag_has_an_id_of_its_own(stated, count):
    objects = [tag_board(one, count) for one in stated]
    said = {one + n for one in stated if one is not None for n in range(count)}
    free = [tag for tag in range(9) if tag not in said]
    expected = said | {*free[: count * stated.count(None)]}
    found = [int(one.value) for n in range(len(stated)) for one in list_pictures(objects, n)]
    assert {*found} == expected
    assert len(found) == count * len(stated)


@pytest.mark.parametrize("tag", [None, 0, 1, 64, 69, 300, 586])
def test_a_detector_reads_the_id_of_a_tag(tag):
    assert detected_tags(stage(tag_board(tag)), SensorSize(300, 225)) == {tag or 0}


@pytest.mark.parametrize("text", ["-1", "587", "x", "", "3.5"])
def test_an_id_that_no_april_tag_has_is_refused(text):
    with pytest.raises(InputError, match="0 to 586"):
        check_picture(Picture("tag", text))
