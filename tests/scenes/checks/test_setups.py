"""Words of set-ups and of vehicles of the camera: shown where the staged scene holds them."""

import itertools

import numpy as np
import pytest
from tests.scenes.checks.test_pictures import SMALL
from tests.scenes.every_row import for_every
from tests.scenes.staged import in_image, stage, thing
from tests.scenes.test_short_prompts import report

from texvent_scenes.models.places import PLACES


@pytest.mark.parametrize(
    ("noun", "target"), [("dog", "tree"), ("child", "van"), ("ball", "box"), ("cat", "sofa")]
)
def test_who_comes_from_behind_a_thing_is_hidden_first_and_then_clear_of_it(noun, target):
    scene = stage(
        thing(noun, ("move",)), thing(target, ("stand",)), relations=(("from behind", 0, 1),)
    )
    one, other = scene.actors
    first, last = (in_image(scene, one, at) for at in (0.0, 2.0))
    cover = in_image(scene, other, 0.0)
    low, high = cover[:, 0].min(), cover[:, 0].max()
    assert low <= first[:, 0].mean() <= high
    gone = last[:, 0].mean() - first[:, 0].mean()
    assert abs(gone) > 0.5 * np.ptp(first[:, 0])


@pytest.mark.parametrize(
    ("text", "means"),
    [
        ("first person view of a drone flying through a forest", "fly"),
        ("first-person view of a man walking through a market", "walk"),
        ("pov of a car driving through a city", "drive"),
    ],
)
def test_a_first_person_view_goes_with_the_camera(text, means):
    said = report(text)
    assert any(f'means = "{means}"' in one for one in said.scene)
    assert "objects" not in " ".join(said.scene)


ROOMS = [name for name, one in PLACES.items() if one.is_room and name not in ("indoor", *SMALL)]


@for_every(zip(ROOMS, itertools.cycle(("walking", "flying"))))
def test_a_camera_that_goes_through_a_room_sees_its_furniture(row):
    name, how = row
    assert not report(f"{how} through a {name}").not_shown
