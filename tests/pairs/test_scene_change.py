"""Scene cuts and flashes against motion, zoom, fades and noise; gaps in time."""

import itertools

import numpy as np
import pytest

import texvent
from texvent.errors import InputError, TexventWarning
from texvent.frames import Frame
from texvent.pairs.scene_change import SceneChange, detect_scene_change
from texvent.pairs.time_jump import watch_steps
from texvent.run.check import check_source

WIDTH, HEIGHT = 192, 144


def change(first, second):
    return detect_scene_change(Frame(first, 0), Frame(second, 40_000))


@pytest.fixture(scope="module")
def scene(moving_texture):
    """`scene(x, y)`: part of one large image of dark and bright things."""

    def render(x: float, y: float = 0.0) -> np.ndarray:
        coarse = moving_texture(-x / 3, -y / 3, width=WIDTH, height=HEIGHT)
        fine = moving_texture(-x + 500, -y, width=WIDTH, height=HEIGHT)
        return np.clip(0.6 * coarse + 0.4 * fine - 30, 0, 255)

    return render


def test_another_image_is_a_cut(scene, moving_texture):
    assert (
        change(scene(0), moving_texture(3000, 800, width=WIDTH, height=HEIGHT)) is SceneChange.CUT
    )
    assert change(scene(0), scene(0)[:, ::-1]) is SceneChange.CUT
    assert change(scene(0), scene(0)[::-1]) is SceneChange.CUT


def test_zoom_is_no_jump(moving_texture):
    y, x = np.mgrid[:HEIGHT, :WIDTH].astype(np.float64)
    first = moving_texture(0, width=WIDTH, height=HEIGHT)
    rows = np.clip(np.rint((y - 72) / 1.1 + 72), 0, HEIGHT - 1).astype(int)
    columns = np.clip(np.rint((x - 96) / 1.1 + 96), 0, WIDTH - 1).astype(int)
    assert change(first, first[rows, columns]) is SceneChange.NONE


def test_a_fade_to_or_from_black_is_no_jump(scene):
    steps = [scene(0) * k / 8 for k in range(9)]
    for dark, bright in itertools.pairwise(steps):
        assert change(dark, bright) is SceneChange.NONE
        assert change(bright, dark) is SceneChange.NONE


def test_the_same_image_twice_as_bright_is_a_flash(scene):
    dim = scene(0) * 0.5
    assert change(dim, scene(0)) is SceneChange.FLASH
    assert change(scene(0), dim) is SceneChange.FLASH


def test_white_and_black_images_are_flashes(scene):
    assert change(scene(0), np.full((HEIGHT, WIDTH), 255.0)) is SceneChange.FLASH
    assert change(np.zeros((HEIGHT, WIDTH)), np.full((HEIGHT, WIDTH), 200.0)) is SceneChange.FLASH


def test_frames_too_small_to_judge_do_not_jump():
    assert change(np.zeros((1, 1)), np.full((1, 1), 255.0)) is SceneChange.NONE
    assert change(np.zeros((15, 400)), np.full((15, 400), 255.0)) is SceneChange.NONE
    assert change(np.zeros((16, 400)), np.full((16, 400), 255.0)) is SceneChange.FLASH


@pytest.mark.parametrize(("right", "down"), [(1, 0), (18, 0), (80, 0), (-50, 30), (0, 60)])
def test_a_pan_in_any_direction_is_no_jump(moving_texture, right, down):
    first = moving_texture(0, 0, width=WIDTH, height=HEIGHT)
    second = moving_texture(right, down, width=WIDTH, height=HEIGHT)
    assert change(first, second) is SceneChange.NONE


def test_two_skies_that_share_only_a_gradient_do_not_agree(scene):
    rng = np.random.default_rng(4)
    sky = np.linspace(220, 60, HEIGHT)[:, None]
    blocks = [np.kron(rng.uniform(-40, 40, (18, 24)), np.ones((8, 8))) for _ in range(2)]
    first, second = (np.clip(sky + one, 0, 255) for one in blocks)
    assert change(first, second) is SceneChange.CUT


S = 1_000_000
PIXELS = np.zeros((2, 2), np.uint8)


def times_of(steps):
    return [0, *itertools.accumulate(steps)]


def watch(steps, *, is_live=False):
    frames = (Frame(PIXELS, t_us) for t_us in times_of(steps))
    return [frame.t_us for frame in watch_steps(frames, is_live=is_live)]


@pytest.mark.parametrize(
    "steps",
    [
        [33_000] * 5,
        [10 * S] * 4,  # a slide show
        [86_400 * S] * 4,  # an image a day
        [300 * S, 280 * S, 900 * S, 310 * S],
        [33_000, 33_000, 5 * S, 33_000],  # a pause
        [40 * S],
        [],
    ],
)
def test_long_steps_that_are_usual_are_no_jump(steps):
    assert watch(steps) == times_of(steps)


@pytest.mark.parametrize("steps", [[33_000] * 3 + [20 * S, 33_000], [20 * S, 33_000, 33_000]])
def test_a_pause_of_a_screen_recorder_is_warned_of(steps):
    with pytest.warns(TexventWarning, match="20 s later, far beyond"):
        assert watch(steps) == times_of(steps)


@pytest.mark.parametrize("steps", [[33_000] * 3 + [86_400 * S], [86_400 * S, 33_000], [7200 * S]])
@pytest.mark.parametrize("is_live", [False, True])
def test_a_jump_of_hours_is_refused_also_as_the_first_step(steps, is_live):
    with pytest.raises(InputError, match=r"hours; times are µs.*rate \(`fps`\).*reset\(\)"):
        watch(steps, is_live=is_live)


def test_every_way_to_simulate_and_check_finds_a_jump():
    images = np.random.default_rng(0).integers(0, 255, (6, 16, 16), np.uint8)
    times_us = times_of([33_000, 33_000, 86_400 * S, 33_000, 33_000])
    for options in ({}, {"simulator": "esim", "interpolate": "none"}):
        with pytest.raises(InputError, match=r"24\.0 hours"):
            texvent.simulate(images, t_us=times_us, **options)
    with pytest.raises(InputError, match=r"24\.0 hours"):
        texvent.simulate(texvent.Video(images, times_us))
    report = check_source(texvent.Video(images, times_us), progress=False).report
    assert "time jump" in report.remarks
    assert report.measurements["longest_jump_s"] == 86_400
    camera = texvent.EventCamera((16, 16))
    camera.step(images[0], 0)
    camera.step(images[1], 33_000)
    with pytest.warns(TexventWarning, match="noise fills the pause"):
        camera.step(images[2], 20 * S)
