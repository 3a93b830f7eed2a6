"""Words of set-ups and of vehicles of the camera: shown where the staged scene holds them."""

import numpy as np
import pytest
from tests.scenes.checks.test_words import check, report
from tests.scenes.staged import in_image, stage, thing

OVERTAKEN = "overtakes us"


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
    ("text", "word", "is_shown"),
    [
        ("a dog comes out from behind a tree", "out from behind", True),
        ("a child runs out from behind a parked van", "out from behind", True),
        ("a cat walks out from behind a sofa", "out from behind", True),
        ("a boy stands out from behind a tree", "out from behind", False),
    ],
)
def test_from_behind_is_shown_if_it_is_so_in_the_image(text, word, is_shown):
    check(text, word, is_shown)


@pytest.mark.parametrize(
    "text",
    [
        "a truck overtakes us on the left, dashcam",
        "dashcam, a motorcycle overtakes us on a motorway",
        "a cyclist overtakes us on the right at dusk",
    ],
)
def test_what_overtakes_the_camera_comes_from_beside_it_and_gets_ahead(text):
    assert OVERTAKEN in report(text).shown


@pytest.mark.parametrize(
    ("text", "word", "is_shown"),
    [
        ("6-DoF motion over a poster", "over", True),
        ("handheld shake over a keyboard", "over", True),
        ("six degree of freedom motion over a desk with mugs", "over", True),
        ("a camera drives over a poster", "over", False),
    ],
)
def test_a_camera_over_things_has_them_in_sight(text, word, is_shown):
    check(text, word, is_shown)


@pytest.mark.parametrize(
    ("text", "word"),
    [
        ("a mobile robot carrying a box", "carrying"),
        ("a truck carrying a crate", "carrying"),
        ("a conveyor belt carrying boxes", "carrying"),
        ("a backlit hand waving", "backlit"),
        ("a man walking, backlit", "backlit"),
        ("a backlit spinning top", "backlit"),
        ("a drone flies between two poles", "flies"),
        ("a robot dog walks between two boxes", "between"),
        ("a robot dog walks down stairs", "walks"),
        ("dashcam, the car ahead brakes", "brakes"),
        ("a woman leading a child across a street", "leading"),
        ("water droplets leaving a nozzle one by one", "one by one"),
    ],
)
def test_words_of_set_ups_are_shown(text, word):
    assert word in report(text).shown


@pytest.mark.parametrize(
    ("text", "word"),
    [
        ("driving out of an underground car park", "out of"),
        ("a hand tilts a checkerboard", "tilts"),
        ("a hand turns a steering wheel", "turns"),
        ("a plane landing on a runway, nose camera", "nose camera"),
        ("a spinning fan occluded by a book", "occluded"),
        ("hand-held camera walking down a staircase", "down"),
    ],
)
def test_what_nothing_shows_is_told(text, word):
    check(text, word, False)


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


@pytest.mark.parametrize("place", ["a field", "a beach", "a street"])
def test_lamps_of_ceilings_hang_from_nothing_in_the_open(place):
    assert "hanging from nothing" in " ".join(
        report(f"flickering ceiling lamps in {place}").not_shown
    )


def test_who_passes_before_a_large_thing_covers_it():
    assert "occludes" in report("a person occludes a car").shown
