"""Scene cuts and flashes against motion, zoom, fades, noise and their rule; gaps in time."""

import itertools
from collections import Counter
from typing import Any

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray

import texvent
from texvent.brightness import balanced_log
from texvent.errors import InputError, TexventWarning
from texvent.frames import Frame
from texvent.pairs.scene_change import SceneChange, detect_scene_change, shift_agreement
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


Image = NDArray[Any]
ROWS, COLUMNS = 32, 48
"""Pixels; cells have 2 × 2."""


def matches(image: Image, other: Image) -> tuple[float, float, float]:
    """Residual, correlation and textured share of the blocks of 8 × 8 cells, each looked for within
    8 cells."""
    height, width = image.shape
    residuals, variances, correlations = [], [], []
    for top, left in np.ndindex(height // 8, width // 8):
        block = image[8 * top :, 8 * left :][:8, :8]
        block = block - block.mean()
        near = other[max(0, 8 * top - 8) : 8 * top + 16, max(0, 8 * left - 8) : 8 * left + 16]
        there = np.lib.stride_tricks.sliding_window_view(near, (8, 8)).reshape(-1, 8, 8)
        there = there - there.mean(axis=(1, 2), keepdims=True)
        scale = np.sqrt((block.var() + 1e-4) * (there.var(axis=(1, 2)) + 1e-4))
        residuals.append(((block - there) ** 2).mean(axis=(1, 2)).min())
        correlations.append(((block * there).mean(axis=(1, 2)) / scale).max())
        variances.append(block.var())
    has_texture = np.array(variances) > 0.03**2
    middle = np.median(np.array(correlations)[has_texture]) if has_texture.any() else 0.0
    return np.mean(residuals) / (np.mean(variances) + 1e-4), middle, has_texture.mean()


def defined(first: Image, second: Image) -> SceneChange:
    """The rule."""
    cells = [
        one.reshape(ROWS // 2, 2, COLUMNS // 2, 2).mean(axis=(1, 3)) for one in (first, second)
    ]
    brightness = [balanced_log(one, 30.0) for one in cells]
    levels, log = cells[1] - cells[0], brightness[1] - brightness[0]
    middle, change = np.median(log), np.abs(levels).mean()
    is_cut = np.abs(log - middle).mean() >= 0.15 and change >= 12
    is_flash = abs(middle) >= 0.35 and abs(np.median(levels)) >= 32
    is_flash = is_flash and np.mean(np.sign(log) == np.sign(middle)) >= 0.75
    if not (is_cut or is_flash or change >= 32):
        return SceneChange.NONE
    ways = matches(*brightness), matches(*brightness[::-1])
    if min(one[2] for one in ways) < 0.1:
        if is_flash:
            return SceneChange.FLASH
        return SceneChange.CUT if change >= 32 else SceneChange.NONE
    is_lost = min(one[0] for one in ways) > 0.5 and max(one[1] for one in ways) < 0.8
    if is_lost and is_cut:
        return SceneChange.NONE if shift_agreement(*brightness) >= 0.6 else SceneChange.CUT
    return SceneChange.FLASH if is_flash and not is_lost else SceneChange.NONE


def texture(random: np.random.Generator, width: int = COLUMNS) -> Image:
    """Smooth noise of any contrast around any level."""
    image = cv2.GaussianBlur(random.normal(size=(ROWS, width)), (0, 0), random.uniform(1, 4))
    contrast = random.choice([0.0, 5.0, 20.0, 60.0])
    return random.uniform(30, 160) + contrast * image / image.std()


def pair(random: np.random.Generator) -> tuple[Image, Image]:
    """An image, and one that is moved, brighter in a part, and mixed with another."""
    wide = texture(random, 2 * COLUMNS)
    moved = int(random.choice([0, 0, 4, 20]))
    first, second = wide[:, :COLUMNS], wide[:, moved : moved + COLUMNS]
    share = random.choice([0.0, 0.0, 0.2, 0.5, 0.8, 1.0])
    second = (1 - share) * second + share * texture(random)
    lit = np.arange(ROWS)[:, None] < random.choice([0, 18, 22, 26, 32])
    gain, more = random.choice([0.5, 1.0, 1.4, 2.0]), random.choice([0.0, 25.0, 35.0, 80.0])
    second = np.where(lit, gain * second + more, second)
    return np.clip(first, 0, 255), np.clip(second, 0, 255)


def test_changes_are_those_of_the_rule() -> None:
    random = np.random.default_rng(3)
    found = Counter[SceneChange]()
    for _ in range(200):
        first, second = pair(random)
        change = detect_scene_change(Frame(first, 0), Frame(second, 40_000))
        assert change is defined(first, second)
        found[change] += 1
    assert min(found[one] for one in SceneChange) >= 25, found
