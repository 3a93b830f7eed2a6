"""Images on surfaces: right way up, filtered as supersampling says, and checkerboards exactly."""

import cv2
import numpy as np
import pytest
from tests.scenes.raycast.meshes.mesh_scenes import MeshScene, sheet

from texvent.camera import PosedCamera, place_in_image
from texvent.sensor import SensorSize
from texvent.transfer import encode_srgb
from texvent_scenes.mesh import SurfaceImage, surface_image
from texvent_scenes.pictures import draw_checks
from texvent_scenes.raycast.render import render_light

SIZE = SensorSize(48, 36)


def camera(distance: float, turn: float = 0.0) -> PosedCamera:
    """In front of the sheet, at its height; turned aside by an angle, rad."""
    position = np.array([distance * np.sin(turn), -distance * np.cos(turn), 1.0])
    forward = (np.array([0.0, 0.0, 1.0]) - position) / distance
    right = np.cross(forward, [0.0, 0.0, 1.0])
    return PosedCamera(position, np.stack([right, np.cross(forward, right), forward]), 1.0)


def scene_of(image: SurfaceImage, seen_by: PosedCamera) -> MeshScene:
    return MeshScene(sheet(image), camera_at=lambda time: seen_by)


def light_on(image: SurfaceImage, seen_by: PosedCamera, size: SensorSize = SIZE) -> np.ndarray:
    return render_light(scene_of(image, seen_by), 0.0, size, shadows=False)


def quarters() -> np.ndarray:
    """Red, green, blue and grey quarters: top left, top right, bottom left, bottom right."""
    image = np.zeros((16, 16, 3), dtype=np.float32)
    image[:8, :8, 0], image[:8, 8:, 1], image[8:, :8, 2], image[8:, 8:] = 0.5, 0.5, 0.5, 0.3
    return image


def test_an_image_stands_upright_and_is_not_mirrored():
    light = light_on(surface_image(quarters()), camera(3.0))
    places = {(12, 17): 0, (12, 31): 1, (24, 17): 2}
    for (row, column), channel in places.items():
        assert light[row, column].argmax() == channel
        assert light[row, column, channel] > 5.0 * np.delete(light[row, column], channel).max()
    assert np.ptp(light[24, 31]) < 0.5 * light[24, 31].max()


@pytest.mark.parametrize(("distance", "turn"), [(2.5, 1.2), (8.0, 0.6), (25.0, 0.0), (25.0, 1.2)])
def test_a_filtered_image_is_near_the_mean_of_many_samples(distance, turn):
    rng = np.random.default_rng(3)
    coarse = rng.random((12, 12, 3)).astype(np.float32)
    image = surface_image(cv2.resize(coarse, (96, 96), interpolation=cv2.INTER_NEAREST))
    one = light_on(image, camera(distance, turn))
    many = light_on(image, camera(distance, turn), SensorSize(48 * 8, 36 * 8))
    mean = many.reshape(36, 8, 48, 8, 3).mean(axis=(1, 3))
    inner = np.zeros((36, 48), dtype=bool)
    inner[17:19, 23:25] = True  # away from the edges of the sheet
    assert np.abs(one - mean)[inner].max() < 0.06


def test_a_checkerboard_shows_its_corners_exactly_where_the_camera_says():
    size = SensorSize(320, 240)
    seen_by = camera(3.2, 0.5)
    board = surface_image(draw_checks(9, 6))
    gray = encode_srgb(light_on(board, seen_by, size)).mean(axis=2).astype(np.uint8)
    found, corners = cv2.findChessboardCorners(gray, (8, 5))
    assert found
    window = (4, 4)
    stop = (cv2.TERM_CRITERIA_EPS | cv2.TERM_CRITERIA_MAX_ITER, 50, 1e-4)
    corners = cv2.cornerSubPix(gray, corners, window, (-1, -1), stop).reshape(-1, 2)
    across, down = np.meshgrid(np.arange(2, 10) / 11.0, np.arange(2, 7) / 8.0)
    places = np.stack(
        [2.0 * across - 1.0, np.zeros_like(across), 1.0 + 1.0 - 2.0 * down], axis=-1
    ).reshape(-1, 3)
    seen = (places - seen_by.position) @ seen_by.rotation.T
    true = place_in_image(seen_by, size, seen)[:, :2]
    if np.linalg.norm(corners[0] - true[0]) > np.linalg.norm(corners[-1] - true[0]):
        corners = corners[::-1]
    # OpenCV counts from the middle of the first pixel.
    assert np.abs(corners + 0.5 - true).max() < 0.15
