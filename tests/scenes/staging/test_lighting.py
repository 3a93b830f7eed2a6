"""Light: which lamps are on, how they blink, and what light they shed."""

import itertools
from dataclasses import replace

import numpy as np
import pytest
from tests.scenes.every_row import for_every
from tests.scenes.staged import SIZE, stage, stage_text, thing

from texvent.sensor import SensorSize
from texvent.transfer import decode_srgb
from texvent_scenes.models.effects import LAMPS, LampKind, lamp_of
from texvent_scenes.models.nouns import NOUNS
from texvent_scenes.models.places import PLACES
from texvent_scenes.models.protocol import ModelPart
from texvent_scenes.raycast.render import render
from texvent_scenes.rendered_scene import Shape
from texvent_scenes.scene_input import describe_scene, list_nouns, understand
from texvent_scenes.spec.scene import (
    Camera,
    CameraMove,
    Lamp,
    Light,
    Motion,
    Place,
    Scene,
    SceneObject,
)
from texvent_scenes.staging.compose import compose_scene
from texvent_scenes.staging.surroundings.lamps import part_lamp
from texvent_scenes.staging.surroundings.lighting import choose_lighting, hidden_lamp

CAR = thing("car", ("drive", "left"))


def beams(scene):
    return [row for row in scene.environment(0.0).lamps if row["full"] >= -1.0]


def test_headlights_are_on_at_night_and_off_by_day():
    night, day = (stage(CAR, light=light, place="road") for light in ("night", "day"))
    assert len(beams(night)) == 4  # two in front, two behind
    assert len(day.environment(0.0).lamps) == 0
    front = max(beams(night), key=lambda row: row["light"].max())
    assert front["beam"][0] < -0.9  # it drives left


def test_lamps_move_with_what_carries_them():
    scene = stage(CAR, light="night", place="road")
    before, after = (scene.environment(t).lamps for t in (0.2, 0.4))
    car = scene.actors[0].track
    moved = np.subtract(car.at(0.4).position, car.at(0.2).position)
    carried = before["full"] >= -1.0
    np.testing.assert_allclose(
        (after["place"] - before["place"])[carried], np.tile(moved, (carried.sum(), 1)), atol=1e-12
    )
    np.testing.assert_array_equal(after[~carried], before[~carried])


def test_lamps_can_be_switched_on_by_day_and_off_at_night():
    on, off = replace(CAR, is_lit=True), replace(CAR, is_lit=False)
    assert len(stage(on, light="day", place="road").environment(0.0).lamps) == 4
    dark = stage(off, light="night", place="road")
    assert not beams(dark)
    glow = dark.primitives(0.0)
    assert glow.emission[glow.instance == 1].max() == 0.0


@pytest.mark.parametrize("time_s", [0.0, 0.05, 0.0999, 0.1, 0.15, 0.1999, 0.2, 0.71])
def test_a_blinking_lamp_is_on_in_the_first_half_of_its_period_exactly(time_s):
    drone = stage(thing("drone", ("hover",), blink_hz=5.0), light="day", place="sky")
    is_on = time_s % 0.2 < 0.1
    assert (drone.environment(time_s).lamps["light"].max() > 0.0) == is_on
    assert (drone.primitives(time_s).emission.max() > 0.0) == is_on
    assert drone.flicker_hz == 5.0


@pytest.mark.parametrize("noun", sorted(set(LAMPS) & set(NOUNS)))
def test_every_lamp_noun_sheds_light_when_it_is_lit(noun):
    scene = stage(thing(noun, is_lit=True), light="night", place="plain")
    levels, others = [], set()  # lamps but for those of its parts that shine at that instant
    for time_s in np.linspace(0.0, 1.9, 12):
        light, shapes = scene.environment(time_s).lamps["light"], scene.primitives(time_s)
        shining = shapes.colour[(shapes.instance == 1) & (shapes.emission > 0.0)]
        own = sum(lamp_of(noun, tuple(colour)) is not None for colour in shining)
        others.add(int((light.max(axis=1) > 0.0).sum()) - own)
        levels.append(light.max(initial=0.0))
    assert max(levels) > 0.0
    assert len(others) == 1
    rows = scene.environment(0.0).lamps
    assert (rows["casts"] > 0.0).sum() <= 4
    assert all(np.isfinite(rows[name]).all() for name in rows.dtype.names)


@pytest.mark.parametrize("half_angle", [1.0, 15.0, 60.0, 90.0, 150.0])
@pytest.mark.parametrize("soft_share", [0.0, 0.3, 1.0])
def test_a_beam_fades_out_at_its_half_angle_from_its_direction(half_angle, soft_share):
    part = ModelPart(Shape.BOX, np.eye(3, 4), (1.0, 1.0, 1.0))
    lamp = LampKind(1.0, (0.0, 3.0, 4.0), half_angle, soft_share)
    (row,) = part_lamp(lamp, part, np.eye(3, 4), 1.0)
    faded, full = np.degrees(np.arccos([row["dark"], row["full"]]))
    assert (faded, full) == pytest.approx((half_angle, half_angle * (1.0 - soft_share)), abs=1e-6)
    np.testing.assert_allclose(row["beam"], [0.0, 0.6, 0.8])


@pytest.mark.parametrize("reach_m", [1.0, 3.0, 20.0, 200.0])
def test_a_lamp_out_of_sight_stands_off_by_shares_of_the_distance_and_lights_alike(reach_m):
    target = np.array([5.0, -2.0, 0.3])
    (near,), (row,) = (hidden_lamp(target, one, 0.5) for one in (2.0, reach_m))
    off = (row["place"] - target) / reach_m
    np.testing.assert_allclose(off, (near["place"] - target) / 2.0)
    assert 0.3 < off[2] < np.linalg.norm(off) < 1.0
    light = row["light"] / row["place"][2] ** 2
    np.testing.assert_allclose(light, near["light"] / near["place"][2] ** 2)


def placed(*lamps):
    """A box at night with lamps at positions."""
    scene = Scene(
        objects=(SceneObject(noun="box", colour="white", position_m=(0.0, 0.0)),),
        camera=Camera(position_m=(0.0, -4.0, 1.5), look_at_m=(0.0, 0.0, 0.3)),
        light=Light(kind="night", lamps=lamps),
        place=Place(name="plain"),
    )
    return compose_scene(describe_scene(scene, list_nouns()), seed=1, size=SIZE, duration_s=1.0)


def test_a_lamp_lights_the_scene_less_so_from_far_away_and_through_shadows():
    near = Lamp(position_m=(-4.0, -4.0, 6.0), strength=40.0)
    far = replace(near, position_m=(-8.0, -8.0, 12.0))
    scenes = [placed(), placed(far), placed(replace(near, has_shadows=True)), placed(near)]
    dark, far_light, shadowed, lit = (render(one, 0.0, SIZE).mean() for one in scenes)
    assert lit > far_light + 5.0 > dark + 10.0
    assert lit > shadowed > dark + 10.0


@pytest.mark.parametrize(
    ("wave", "levels"),
    [("sine", (1.0, 0.5, 0.0)), ("switch", (1.0, 1.0, 0.0)), ("strobe", (1.0, 1.0, 0.0))],
)
def test_lamps_are_modulated_at_their_frequency(wave, levels):
    position = (-1.0, -2.0, 2.0)
    lamp = Lamp(position_m=position, colour="#ff0000", frequency_hz=125.0, wave=wave)
    scene = placed(lamp, Lamp(position_m=position))
    assert scene.flicker_hz == 125.0
    for share, level in zip((0.0, 0.25, 0.5), levels, strict=True):
        lamps = scene.environment((7.0 + share) / 125.0).lamps
        np.testing.assert_allclose(lamps["place"][0], position)
        np.testing.assert_allclose(lamps["light"][0], (level, 0.0, 0.0), atol=1e-6)
        np.testing.assert_allclose(lamps["light"][1], 1.0)


BEATS = {(lamp.wave, lamp.blink_hz, lamp.turns_hz): (noun, lamp.wave, lamp.turns_hz > 0)
         for noun, lamps in [*LAMPS.items()][::-1] for lamp in lamps
         if lamp.blink_hz or lamp.turns_hz}  # fmt: skip


@for_every(sorted(BEATS.values()))
def test_the_flicker_of_a_scene_is_the_fastest_beat_of_its_lamps(row):
    """Over 32 of its periods it is the highest line in the spectrum, but for harmonics."""
    noun, wave, turns = row
    scene = stage(thing(noun), light="night")
    times = np.arange(512) / 512 * 32 / (scene.flicker_hz or 1.0)
    lamps = np.stack([scene.environment(one).lamps for one in times])
    signal = lamps["beam"][..., 0] if turns else lamps["light"].sum(-1)
    power = abs(np.fft.rfft((signal - signal.mean(0)) * np.hanning(512)[:, None], axis=0))
    lines = np.flatnonzero(power.max(1, initial=0.0) > 0.2 * power.max(initial=1e-6))
    assert (scene.flicker_hz is None) == (not len(lines))
    if len(lines):
        assert abs((lines.max() if wave == "flame" else lines.min()) - 32) <= 1


@pytest.mark.parametrize("colour", ["white", "grey", "black", "red", "yellow"])
def test_edges_stand_out_from_a_backdrop_that_nobody_asked_for(colour):
    bar = SceneObject("bar", colour=colour)
    open_, said = (
        compose_scene(
            describe_scene(Scene(objects=(bar,), place=place), list_nouns()),
            seed=0, size=SIZE, duration_s=1.0,
        )
        for place in (Place(), Place("plain"))
    )  # fmt: skip
    image = 2.2 * np.log(render(open_, 0.0, SIZE).mean(axis=2) + 1e-3)  # log light
    assert np.ptp(np.quantile(image, [0.01, 0.99])) > 4 * 0.25
    greys = [float(one.environment(0.0).ground_colour[0]) for one in (open_, said)]
    assert (greys[0] == greys[1]) == (colour in ("black", "red"))


ROOMS = sorted(name for name, one in PLACES.items() if one.is_room)
NIGHTS = ("night", "moonlight")
SMALL = SensorSize(48, 36)


def compose_small(description):
    return compose_scene(description, seed=0, size=SMALL, duration_s=1.0)


def seen(place, kind, lamps=(), **fields):
    """Mean light of the picture at .1 and at .6 s."""
    one = SceneObject("box", motions=(Motion("stand"),), **fields)
    still = Camera(moves=(CameraMove("static"),))
    scene = Scene(objects=(one,), camera=still, light=Light(kind, lamps=lamps), place=Place(place))
    composed = compose_small(describe_scene(scene, NOUNS))
    return [float(np.mean(render(composed, time_s, SMALL))) for time_s in (0.1, 0.6)], composed


@for_every(itertools.product(ROOMS, NIGHTS))
def test_a_room_at_night_is_dark(row):
    place, kind = row
    (night, _), composed = seen(place, kind)
    (day, _), _ = seen(place, "day")
    assert night < 0.15 * day  # grey levels
    assert any("is dark" in note for note in composed.notes)


@for_every(itertools.product(ROOMS, NIGHTS))
def test_a_lamp_that_flickers_is_what_is_seen_of_a_room_at_night(row):
    place, kind = row
    lamp = Lamp((0.0, -1.0, 2.0), strength=2.0, frequency_hz=1.0, wave="switch")
    (on, off), _ = seen(place, kind, (lamp,))
    assert on > 3.0 * off
    (_, dark), _ = seen(place, kind)
    assert off == pytest.approx(dark, rel=1e-6)


@for_every(ROOMS)
def test_the_light_of_lamps_has_those_of_a_room_on(place):
    (lit, _), _ = seen(place, "lamp")
    (night, _), _ = seen(place, "night")
    assert lit > 2.0 * night


@pytest.mark.parametrize("room", ["an office", "a kitchen", "a laboratory"])
def test_in_a_room_of_a_sentence_the_light_is_on_at_night(room):
    said = understand(f"a man waves in {room} at night", NOUNS)
    lit = float(np.mean(render(compose_small(said), 0.1, SMALL)))
    unlit = replace(said, place=replace(said.place, is_lit=False))
    dark = float(np.mean(render(compose_small(unlit), 0.1, SMALL)))
    assert lit > 3.0 * dark


@for_every(itertools.product(ROOMS, NIGHTS))
def test_a_room_of_a_file_is_lit_at_night_where_it_says_so(row):
    place, kind = row
    one = SceneObject("box", motions=(Motion("stand"),))
    scene = Scene(objects=(one,), light=Light(kind), place=Place(place, is_lit=True))
    lit = float(np.mean(render(compose_small(describe_scene(scene, NOUNS)), 0.1, SMALL)))
    (dark, _), _ = seen(place, kind)
    assert lit > 2.0 * dark


DARKER = {"night": 0.75, "moonlight": 0.75, "dusk": 0.97}
"""Most light of a picture that is a scene's at night, as a share of that by day."""
SMALL = SensorSize(43, 32)


def luminance(place, light):
    """Mean light of a picture of a ball."""
    image = render(stage(thing("ball"), light=light, place=place), 0.0, SMALL)
    return float(decode_srgb(np.asarray(image, np.float64) / 255.0).mean())


@for_every(sorted(name for name, one in PLACES.items() if one.light != "space"))
def test_every_place_is_darker_at_night_than_by_day(place):
    day = luminance(place, "day")
    lights = DARKER if not PLACES[place].light else ("night", "moonlight")
    shares = {light: luminance(place, light) / day for light in lights}
    assert all(share < DARKER[light] for light, share in shares.items()), shares


@pytest.mark.parametrize("name", [name for name, one in PLACES.items() if one.light == "space"])
@pytest.mark.parametrize("kind", ["night", "moonlight", "lamp", "dusk", "overcast"])
def test_in_space_the_sun_shines_at_any_time(name, kind):
    assert choose_lighting(PLACES[name], Light(kind)) == choose_lighting(PLACES[name], Light(None))


@pytest.mark.parametrize("text", ["{}snow falls on a street", "{}snow in a park"])
def test_heavy_snow_hides_the_sky_and_what_is_far(text):
    usual, thick = (stage_text(text.format(one))[1].animated_environment.at(0.0)
                    for one in ("", "heavy "))  # fmt: skip
    assert thick.fog_distance < 0.4 * usual.fog_distance
    assert np.ptp(thick.sky_top) < 1e-6 < np.ptp(usual.sky_top)
