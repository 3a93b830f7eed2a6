"""Nouns as lists of parts: what lines, surfaces and joints mean."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from texvent.errors import FileFormatError
from texvent.truth.class_ids import CLASS_IDS, FIRST_OTHER
from texvent_scenes.models.joints import Instant, read_joint, read_light
from texvent_scenes.models.limbs import _held
from texvent_scenes.models.materials import Material, share_of
from texvent_scenes.models.nouns import NOUNS
from texvent_scenes.models.part_lines import read_parts
from texvent_scenes.models.parts import read_nouns
from texvent_scenes.models.people.person import Rider
from texvent_scenes.models.protocol import ModelPart, Pose
from texvent_scenes.models.shapes import part
from texvent_scenes.models.skeleton import _SLIVER_M, _clip
from texvent_scenes.models.surfaces import read_surface, shared_surfaces
from texvent_scenes.rendered_scene import Shape, Texture

AT_REST = Pose(0.0, 0.0, 0.0, "stand")


def test_pedals_go_round_the_crank_forwards_with_the_wheels_and_are_opposite():
    crank = (-0.05, 0.11, 0.3)
    rider = Rider((-0.24, 0, 1), (0.1, 0, 1.44), (0.44, 0.24, 1.02), crank, wheel=0.34)
    for quarters in range(9):
        # 0.45 turns of the pedals to one of the wheels; a pedal that is up goes ahead.
        distance_m = quarters / 4 / 0.45 * 2 * math.pi * 0.34
        ahead, up = ((0, 1), (1, 0), (0, -1), (-1, 0))[quarters % 4]
        for side, rod in zip((1, -1), rider.draw(0, distance_m), strict=False):
            axle, pedal = (rod.to_body @ [0, 0, end, 1] for end in (-1, 1))
            np.testing.assert_allclose(axle, [crank[0], side * 0.08, crank[2]], atol=1e-9)
            turned = crank[0] + side * 0.17 * ahead, side * 0.11, crank[2] + side * 0.17 * up
            np.testing.assert_allclose(pedal, turned, atol=1e-9)


def test_every_noun_has_a_class_id():
    assert set(NOUNS) <= set(CLASS_IDS)
    assert (CLASS_IDS["airplane"], CLASS_IDS["zebra"], CLASS_IDS["hand"]) == (1, 117, 118)
    assert (CLASS_IDS["car"], CLASS_IDS["man"]) == (24, 67)
    # Numbers from `FIRST_OTHER` on are of names that are no nouns.
    assert max(CLASS_IDS.values()) < FIRST_OTHER


@given(st.integers(0, 999), st.integers(1, 5))
def test_a_share_of_a_surface_is_that_of_faces_however_its_parts_are_turned(seed, count):
    rng = np.random.default_rng(seed)
    sides, turns = (
        rng.uniform(0.1, 2.0, (count, 3)),
        np.linalg.qr(rng.normal(size=(count, 3, 3)))[0],
    )
    parts = [
        ModelPart(Shape.BOX, np.column_stack([turn * side, rng.normal(size=3)]), (0, 0, 0))
        for turn, side in zip(turns, sides, strict=True)
    ]
    faces = [np.prod(side) / min(side) for side in sides]
    for number in range(count):
        share = share_of(parts, lambda one: one is parts[number])  # noqa: B023
        assert share == pytest.approx(faces[number] / sum(faces))
    assert (share_of(parts, lambda one: True), share_of([], bool)) == (pytest.approx(1.0), 0.0)


def one(line: str) -> np.ndarray:
    parts, _ = read_parts(line)
    assert len(parts) == 1
    return parts[0].to_body


def test_lines_of_single_shapes_by_hand():
    np.testing.assert_allclose(
        one("box red  1 2 3  2 4 6"), [[1, 0, 0, 1], [0, 2, 0, 2], [0, 0, 3, 3]]
    )
    np.testing.assert_allclose(one("box red  0 0 0  2 2 2  lean .5")[0], [1, 0, 0.5, 0])
    # Turned a quarter about z: what was along x is along y.
    turned = one("post red  0 0 1  2 4 6  turn 0 0 90")
    np.testing.assert_allclose(turned, [[0, -2, 0, 0], [1, 0, 0, 0], [0, 0, 3, 1]], atol=1e-12)
    rod = one("rod red  1 0 0  1 0 4  .5")
    np.testing.assert_allclose(rod @ [0, 0, 1, 1], [1, 0, 4])
    np.testing.assert_allclose(rod @ [0, 0, -1, 1], [1, 0, 0])
    disc = one("disc red  1 0 2  .5 .2")
    np.testing.assert_allclose(np.linalg.norm(disc[:, :3], axis=0), [0.5, 0.5, 0.1])
    plank = one("plank red  0 0 0  2 0 0  0 1 0  0 0 .5")
    np.testing.assert_allclose(np.abs(plank[:, :3]).max(axis=0), [0.5, 0.25, 1.0])


def places(text: str) -> list[tuple[float, ...]]:
    parts, _ = read_parts(text)
    return [tuple(np.round(part.to_body[:, 3], 6) + 0.0) for part in parts]


def test_one_line_may_be_many_parts():
    assert places("ball red  ±1 ±2 3  1 1 1") == [(1, 2, 3), (1, -2, 3), (-1, 2, 3), (-1, -2, 3)]
    assert places("ball red  0 0 0  1 1 1  times 3 0 .5 1") == [(0, 0, 0), (0, 0.5, 1), (0, 1, 2)]
    assert places("ball red  0 0 1  1 1 1  also 0 2 1  3 0 0") == [(0, 0, 1), (0, 2, 1), (3, 0, 0)]
    around = places("ball red  1 0 0  1 1 1  turned 4 z 90 0 0 0")
    assert around == [(1, 0, 0), (0, 1, 0), (-1, 0, 0), (0, -1, 0)]
    assert places("bits red  0 0 0  2 2 1  rows ##/.#") == [(0, 0, 0.5), (0, 0.5, -0.5)]
    assert len(places("ring red  0 0 1  1 1  .1  about x 0 360 12")) == 12
    assert len(places("chain red  .1  0 0 0  1 0 0\n    1 1 0  # goes on")) == 2
    assert places("lathe red  0 0 1  2  0 1  4 1") == [(0, 0, 2), (0, 0, 4)]
    assert len(places("frame red  0 0 1  2 1  .1 .1")) == 4


@pytest.mark.parametrize(
    ("line", "message"),
    [
        ("bax red 0 0 0 1 1 1", "unknown shape 'bax'"),
        ("box red 0 0 0 1 1", "6 numbers are needed but there are 5"),
        ("box red 0 0 0 1 1 0", "sizes must be positive"),
        ("box red 0 0 x 1 1 1", "could not convert"),
        ("box red 0 0 nan 1 1 1", "finite"),
        ("box red 0 0 0 1 1 1 twist 3", "could not convert"),
        ("box", "a line is a shape"),
    ],
)
def test_a_bad_line_is_named(tmp_path, line, message):
    file = tmp_path / "mine.toml"
    file.write_text(f'[thing]\nparts = "{line}"\n')
    (noun,) = read_nouns(file)
    with pytest.raises(FileFormatError, match=message) as caught:
        noun.build(colour=None, scale=1.0, seed=0)
    assert "mine.toml, 'thing'" in str(caught.value)
    assert repr(line) in str(caught.value)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("[a]\nsise = 3", "unknown key 'sise'"),
        ('[a]\nnames = "b"', "names must be a list but is 'b'"),
        ('[a]\nspeed = "fast"', "speed must be a float"),
        ('[a]\nhabitat = "moon"', "habitat must be one of"),
        ("[a\n", "mine.toml"),
    ],
)
def test_a_bad_file_is_one_clear_line(tmp_path, text, message):
    file = tmp_path / "mine.toml"
    file.write_text(text)
    with pytest.raises(FileFormatError, match=message) as caught:
        read_nouns(file)
    assert "\n" not in str(caught.value)


def test_surfaces_by_hand():
    hues = {"paint": (0.2, 0.4, 0.6)}
    assert read_surface("paint", hues) == Material((0.2, 0.4, 0.6))
    assert read_surface("paint*.5", hues).colour == pytest.approx((0.1, 0.2, 0.3))
    lit = read_surface("#ffffff plain glow 3", hues)
    assert (lit.colour, lit.texture, lit.emission) == ((1.0, 1.0, 1.0), Texture.PLAIN, 3.0)
    wood = read_surface("(.4 .2 .1) wood scale 2", hues)
    assert (wood.texture, wood.scale) == (Texture.WOOD, 2.0)
    assert wood.second_colour == pytest.approx((0.26, 0.13, 0.065))
    striped = read_surface("paint stripes (1 1 1) scale 3", hues)
    assert (striped.second_colour, striped.scale) == ((1.0, 1.0, 1.0), 3.0)
    assert read_surface("steel", hues) == shared_surfaces()["steel"]
    for bad in ("tartan", "(1 2)", "paint tartan"):
        with pytest.raises(ValueError, match=r"unknown|must be"):
            read_surface(bad, hues)


@given(st.tuples(*[st.floats(-0.5, 1.5).map(lambda one: round(one, 3))] * 3))
def test_each_channel_of_a_colour_is_from_0_to_1(channels):
    text = f"({' '.join(map(str, channels))})"
    if min(channels) >= 0.0 and max(channels) <= 1.0:
        assert read_surface(text, {}).colour == channels
    else:
        with pytest.raises(ValueError, match="three numbers from 0 to 1"):
            read_surface(text, {})


@pytest.mark.parametrize("angle_deg", [0.0, 1.0, 2.8, 2.9, 10.0, 90.0])
def test_a_hand_points_where_the_forearm_does_unless_it_holds_along_it(angle_deg):
    """Within asin 0.05 = 2.87 degrees of the forearm its direction is that of the trunk."""
    angle, held = math.radians(angle_deg), np.array([0.0, 0.6, 0.8])
    across, ahead = np.array([0.0, 0.8, -0.6]), np.array([1.0, 0.0, 0.0])
    trunk = np.c_[ahead, np.eye(3)[:, 1:], np.zeros(3)]
    axes = _held(trunk, math.cos(angle) * held + math.sin(angle) * across, 2.0 * held)
    first = ahead if angle_deg < 2.87 else across
    np.testing.assert_allclose(axes.T, [first, np.cross(held, first), held], atol=1e-9)


@given(*[st.floats(-2, 2)] * 2, st.floats(0.01, 1), st.floats(0.01, 2), st.sampled_from(range(3)))
def test_a_box_is_cut_off_at_two_planes(middle, low, half, width, axis):
    """What lies outside leaves a sliver inside, which is not seen."""
    box = part(Shape.BOX, Material((0.5, 0.5, 0.5)), np.c_[np.diag([half] * 3), [middle] * 3])
    found = _clip(box, axis, low, low + width).to_body
    first, last = max(middle - half, low), min(middle + half, low + width)
    if last - first > 2 * _SLIVER_M:
        expected = 0.5 * (first + last), 0.5 * (last - first)
    else:
        inside = min(max(middle, low + _SLIVER_M), low + width - _SLIVER_M)
        expected = inside, _SLIVER_M
    assert (found[axis, 3], found[axis, axis]) == pytest.approx(expected, abs=2e-4)
    others = [one for one in range(3) if one != axis]
    assert (found[others, 3] == middle).all()


def turned(text: str, pose: Pose, point: tuple[float, ...], seed: int = 0) -> list[float]:
    motion = read_joint(text).motion(Instant(pose, seed))
    where: list[float] = (motion @ [*point, 1.0]).round(6).tolist()
    return where


def test_joints_by_hand():
    quarter = Pose(0.25, 0.0, 0.0)
    assert turned("spin z 0 0 0 1hz", quarter, (1, 0, 0)) == [0, 1, 0]
    assert turned("swing z 1 0 0 90deg 1hz", quarter, (2, 0, 0)) == [1, 1, 0]
    assert turned("swing z 0 0 0 90deg 1hz below 0deg", quarter, (1, 0, 0)) == [1, 0, 0]
    assert turned("sway y .5 1hz", quarter, (0, 0, 0)) == [0, 0.5, 0]
    assert turned("belt x 2m 1m/s", Pose(1.5, 0, 0), (0, 0, 0)) == [0.5, 0, 0]
    assert turned("roll y 0 0 1 1m", Pose(0, math.pi, 1), (0, 0, 0)) == [0, 0, 2]
    spins = {tuple(turned("spin z 0 0 0 1hz start here", AT_REST, (1, 0, 0), k)) for k in range(4)}
    assert len(spins) == 4
    light = read_light("switched at .5hz between 0 .5 by signal 3")
    poses = [Pose(time_s, 0, 0) for time_s in (0.5, 1.5)]
    assert [light.level(Instant(one, 0)) for one in poses] == [1.0, 0.0]
    assert [light.level(Instant(poses[1], 0, {"signal": on})) for on in (1, 3)] == [0.0, 1.0]
    for bad in ("spin q 0 0 0 1hz", "whirl x 0 0 0 1hz", "spin x 0 0 0 1", "spin x 0"):
        with pytest.raises(ValueError, match="joint"):
            read_joint(bad)
