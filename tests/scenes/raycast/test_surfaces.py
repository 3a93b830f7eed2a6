"""Materials and patterns against plain averages, and lists of shapes that miss no cell."""

import itertools
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.examples import examples
from tests.scenes.hand_scenes import HandScene, day

from texvent.sensor import SensorSize
from texvent_scenes.raycast.acceleration import bin_rectangles
from texvent_scenes.raycast.records import INSTANT_RECORD, MAX_CROSSINGS, describe_surroundings
from texvent_scenes.raycast.render import render
from texvent_scenes.raycast.shading.ground import strip_place
from texvent_scenes.raycast.shading.material import patch_axes, tile_average
from texvent_scenes.raycast.shading.value_noise import box_coverage, square_wave
from texvent_scenes.raycast.surfaces.catalogue import CHANNELS, LEVELS, SURFACES, build_tile
from texvent_scenes.raycast.surfaces.fields import SIDE
from texvent_scenes.rendered_scene import Ground, Texture
from texvent_scenes.staging.surroundings.road_line import RoadLine

Floats = np.ndarray


def finest(texture: Texture) -> Floats:
    """[SIDE, SIDE, CHANNELS] level 0 of a tile."""
    return build_tile(texture)[: SIDE * SIDE].reshape(SIDE, SIDE, CHANNELS).astype(np.float64)


def plain_average(texels: Floats, centre: Floats, right: Floats, down: Floats) -> Floats:
    """Mean of the texels under many points of a parallelogram, in tiles."""
    steps = (np.arange(120) + 0.5) / 120 - 0.5
    points = centre + steps[:, None, None] * right + steps[None, :, None] * down
    column, row = np.moveaxis(np.floor(points * SIDE).astype(int) % SIDE, -1, 0)
    return np.asarray(texels[row, column].mean(axis=(0, 1)))


@pytest.mark.parametrize("texture", SURFACES, ids=lambda texture: str(texture.name))
def test_what_a_pixel_shows_is_the_mean_of_what_it_covers(texture):
    texels, address = finest(texture), build_tile(texture).ctypes.data
    rng = np.random.default_rng(5)
    errors = []
    for _ in range(60):
        width, angle = 2.0 ** rng.uniform(0.0, 6.0) / SIDE, rng.uniform(0.0, np.pi)
        axis = np.array([np.cos(angle), np.sin(angle)])
        right = width * rng.uniform(1.0, 4.0) * axis
        down = width * np.array([-axis[1], axis[0]])
        centre = rng.uniform(0.0, 1.0, 2)
        shown = tile_average(address, *centre, patch_axes((*right, *down)))
        errors.append(np.array(shown) - plain_average(texels, centre, right, down))
    spread = texels[..., :2].sum(axis=-1).std()
    error = np.sqrt(np.mean(np.square(np.array(errors)[:, :2].sum(axis=1))))
    assert error < 0.16 * spread


@pytest.mark.parametrize("texture", SURFACES, ids=lambda texture: str(texture.name))
def test_a_material_keeps_its_mean_at_every_size(texture):
    tile = build_tile(texture).astype(np.float64)
    ends = list(itertools.accumulate(SIDE * SIDE >> (2 * level) for level in range(LEVELS)))
    assert tile.shape == (ends[-1], CHANNELS)
    means = [tile[a:b].mean(axis=0) for a, b in itertools.pairwise([0, *ends])]
    np.testing.assert_allclose(means, np.broadcast_to(means[0], (LEVELS, CHANNELS)), atol=1e-5)
    assert means[0][:2].sum() == pytest.approx(1.0, abs=1e-5)
    assert np.abs(means[0][2:]).max() < 0.05


def test_tiles_have_no_seam_and_slopes_along_their_own_axes():
    for texture, axis in itertools.product(SURFACES, (0, 1)):
        look, slope = finest(texture)[..., :2].sum(axis=2), finest(texture)[..., 3 - axis]
        steps = np.abs(np.diff(look, axis=axis, append=look.take([0], axis))).mean(axis=1 - axis)
        assert steps[-1] <= 1.02 * np.sort(steps[:-1])[-3], (texture, axis)
        ways = [np.abs(slope.mean(axis=one)).mean() for one in (axis, 1 - axis)]
        assert ways[0] <= ways[1] + 1e-6, (texture, axis)  # around a ring a slope is even


METRES, ANGLE = st.floats(-30, 30), st.floats(-3, 3)


@pytest.mark.parametrize("texture", [one for one, kind in SURFACES.items() if kind.is_evened])
def test_a_tile_that_repeats_has_no_large_patches(texture):
    look = finest(texture)[..., 0] + 1.35 * finest(texture)[..., 1]
    for patches in (2, 4, 8):
        means = look.reshape(patches, SIDE // patches, patches, -1).mean(axis=(1, 3))
        assert means.std() < 0.025 * means.mean()


@given(x=METRES, y=METRES, angle=ANGLE, roads=st.lists(st.tuples(METRES, METRES, ANGLE)))
@examples(100)
def test_the_drawn_roads_lie_on_the_lines_of_the_staging(x, y, angle, roads):
    line = RoadLine(angle, (2.0, -1.0), tuple(roads[:MAX_CROSSINGS]))
    environment = replace(
        day(Ground.ROAD), road_angle=angle, road_offset=np.array([2.0, -1.0]),
        road_crossings=np.array(roads).reshape(-1, 3),
    )  # fmt: skip
    instant = np.zeros(1, dtype=INSTANT_RECORD)
    describe_surroundings(instant[0], environment, shadows=True)
    along, across, cosine, sine = strip_place(instant[0], x, y)
    assert across == pytest.approx(line.across(np.array([x, y])), abs=1e-6)
    drawn = instant[0]["crossings"][: instant[0]["crossing_count"]]
    crossed = [(y - y0) * turn_x - (x - x0) * turn_y for x0, y0, turn_x, turn_y in drawn]
    nearest = min(abs(one) for one in (across, *crossed))
    assert nearest == pytest.approx(float(line.distance(np.array([[x, y]]))[0]), abs=1e-6)
    foot_x, foot_y, heading = line.at(along)
    assert (cosine, sine) == pytest.approx((np.cos(heading), np.sin(heading)), abs=1e-6)
    assert (foot_x - sine * across, foot_y + cosine * across) == pytest.approx((x, y), abs=1e-6)


PLACES = st.floats(-20.0, 20.0)


@given(x=PLACES, footprint=st.floats(0.01, 5.0), low=PLACES, width=st.floats(0.0, 10.0))
@examples(60)
def test_a_square_wave_and_a_band_are_averaged_over_the_footprint(x, footprint, low, width):
    points = x + footprint * ((np.arange(20_000) + 0.5) / 20_000 - 0.5)
    expected = np.mean(points - np.floor(points) < 0.5)
    assert square_wave(x, footprint) == pytest.approx(expected, abs=2e-3)
    expected = np.mean((points >= low) & (points <= low + width))
    assert box_coverage(x, low, low + width, footprint) == pytest.approx(expected, abs=2e-3)


@given(
    rectangles=st.lists(
        st.tuples(*[st.integers(-3, 9)] * 2, *[st.integers(-3, 7)] * 2), max_size=12
    )
)
@examples(100)
def test_every_cell_lists_the_rectangles_that_touch_it_in_order(rectangles):
    table = np.array(
        [(min(a, b), max(a, b), min(c, d), max(c, d)) for a, b, c, d in rectangles], dtype=np.int64
    ).reshape(-1, 4)
    numbers = np.arange(100, 100 + len(table))
    bins = bin_rectangles(table, numbers, 7, 5)
    for row in range(5):
        for column in range(7):
            expected = [
                number
                for number, (left, right, top, bottom) in zip(numbers, table, strict=True)
                if left <= column <= right and top <= row <= bottom
            ]
            cell = row * 7 + column
            found = bins.items[bins.start[cell] : bins.start[cell + 1]]
            assert found.tolist() == expected


def test_only_waves_higher_than_usual_foam_and_higher_ones_foam_more():
    def share(height):
        scene = HandScene((), environment_base=replace(day(Ground.SEA), wave_height=height))
        seas = [render(scene, 2.0 * at, SensorSize(64, 48))[28:] for at in range(12)]
        return np.mean([sea.min(axis=2) > 180 for sea in seas])

    assert share(1.0) == 0.0
    assert share(1.0 + 1e-6) < 0.002
    assert 0.0 < share(1.5) < share(4.0)


@pytest.mark.parametrize("ground", [Ground.SEA, Ground.LAKE])
@pytest.mark.parametrize("height", [0.5, 1.0, 1.25, 2.0, 4.0, 8.0])
def test_waves_mirror_the_sky_and_not_land_and_foam_on_few_crests(ground, height):
    deep = np.array([0.02, 0.07, 0.12], dtype=np.float32)
    place = replace(day(ground), wave_height=height, ground_second_colour=deep)
    if ground == Ground.SEA:
        place = replace(place, ground_colour=0.5 * deep)
    scene = HandScene((), environment_base=replace(place, road_offset=np.array([0.0, -90.0])))
    seas = [render(scene, 2.5 * at, SensorSize(64, 48))[32:] for at in range(8)]
    water = np.array(seas, dtype=float)
    assert (water[..., 1] <= 1.3 * water[..., 2]).all()
    assert (water.min(axis=-1) > 190).mean() < 0.15
