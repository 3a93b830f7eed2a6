"""Clouds hide the stars and the moon; rain at night is seen."""

import numpy as np
import pytest
from tests.scenes.staged import thing

from texvent.sensor import SensorSize
from texvent_scenes.description import SceneDescription
from texvent_scenes.raycast.render import render_light
from texvent_scenes.spec.scene import Camera, Light, Place
from texvent_scenes.staging.compose import compose_scene

SIZE = SensorSize(96, 72)
UP = Camera(position_m=(0.0, -6.0, 1.5), look_at_m=(-4.5, 3.0, 9.0), field_of_view_deg=70.0)
PLACES = ("grass", "road")


def light_of(kind, *, camera=UP, place="grass", **fields):
    description = SceneDescription(
        objects=(thing("box"),), relations=(), effects=(), camera=camera, light=Light(kind),
        place=Place(place, is_empty=True, **fields),
    )  # fmt: skip
    scene = compose_scene(description, seed=0, size=SIZE, duration_s=1.0)
    return render_light(scene, 0.5, SIZE, samples=1, shadows=False).mean(axis=2)


def sparkle(light):
    """Brightest pixel over the usual one."""
    return float(light.max() / np.median(light))


@pytest.mark.parametrize("kind", ["night", "moonlight"])
@pytest.mark.parametrize("place", PLACES)
def test_a_covered_sky_has_no_stars_and_no_moon(kind, place):
    assert sparkle(light_of(kind, place=place, clouds=0.0)) > 5.0
    assert sparkle(light_of(kind, place=place, clouds=1.0)) < 2.0


@pytest.mark.parametrize("weather", ["rain", "snow"])
@pytest.mark.parametrize("place", PLACES[:2])
def test_rain_and_snow_at_night_are_seen_before_a_sky_without_stars(weather, place):
    ahead = Camera(position_m=(0.0, -6.0, 1.5), look_at_m=(0.0, 6.0, 3.0), field_of_view_deg=60.0)
    wet, dry = (light_of("night", camera=ahead, place=place, clouds=1.0, weather=one)
                for one in (weather, None))  # fmt: skip
    upper = slice(0, SIZE.height // 2)
    gain = wet[upper] / np.median(wet[upper])
    assert (gain > 1.3).mean() > 0.004
    assert (dry[upper] / np.median(dry[upper]) > 1.3).mean() < 0.004
