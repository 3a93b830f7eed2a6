"""What a clip shows of several acts and of a place: each check in unrelated sentences."""

from dataclasses import replace

import numpy as np
import pytest
from tests.scenes.checks.test_placement import SIZE, staged
from tests.scenes.checks.test_words import check, report, told
from tests.scenes.staged import stage

from texvent_scenes.checks.limbs import find_tiny
from texvent_scenes.checks.phases import find_unhurried
from texvent_scenes.description import SceneDescription
from texvent_scenes.spec.scene import Motion, SceneObject


@pytest.mark.parametrize(
    ("text", "word", "is_shown"),
    [
        ("a ball flies and rolls", "rolls", False),  # it is in the air all the time
        ("a dog runs and jumps", "jumps", True),
        ("a panda climbs a tree, slips and falls down", "slips", False),
        ("a squirrel climbs a tree", "climbs", True),
        ("a person dives and swims", "dives", False),
        ("a goalkeeper dives to the left", "dives", True),
        ("a whale dives", "dives", True),
        ("a car drives left and stops", "stops", True),
        ("a plane takes off, turns and flies away", "turns", True),
    ],
)
def test_an_act_of_a_sequence_is_shown_if_its_phase_shows_it(text, word, is_shown):
    check(text, word, is_shown)


@pytest.mark.parametrize(
    ("text", "word", "is_shown"),
    [
        ("a drone lands on a table", "lands", True),
        ("a plane lands on the runway", "lands", True),
        ("a helicopter flies over the city, then it lands on a building", "lands", False),
    ],
)
def test_what_lands_comes_to_the_ground_or_onto_something(text, word, is_shown):
    check(text, word, is_shown)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (
            "aerial view of a sailing boat, with mountains in the distance",
            "mountain in the distance",
        ),
        ("a ship sails past the mountains", "ship on land"),
        ("a street covered with snow at night", "snow"),
    ],
)
def test_a_place_of_which_the_image_shows_nothing_is_told(text, words):
    assert words in told(text)


@pytest.mark.parametrize(
    "text",
    [
        "a sailing boat crosses the sea, with mountains in the distance",
        "a car drives on a snowy road",
        "a dog runs through the snow",
        "a fish swims in an aquarium",
        "a car drives through a crossing",
    ],
)
def test_a_place_that_is_in_view_is_not_denied(text):
    assert not report(text).not_shown


@pytest.mark.parametrize(
    ("text", "word"),
    [
        ("a girl sits as her wug claps their hands", "claps their hands"),  # not the girl
        ("a man throws the wug and catches it", "catches"),
        ("a tram stops and passengers get on", "get on"),
        ("a skier falls, gets up and continues down the slope", "continues"),
    ],
)
def test_a_verb_without_its_subject_or_its_object_is_not_understood(text, word):
    assert word in report(text).not_understood


@pytest.mark.parametrize(
    "text",
    [
        "a horse is ridden by a girl, a dog running behind them",
        "a man walks, a dog walking behind him",
    ],
)
def test_what_goes_behind_what_goes_follows_it(text):
    assert any('"follow"' in line for line in report(text).scene)
    assert "behind" in report(text).shown


def test_who_rides_in_a_closed_vehicle_is_hidden():
    assert "man (hidden)" in report("a man drives a car").out_of_view
    assert not report("a woman rides a motorcycle").out_of_view


@pytest.mark.parametrize(
    ("text", "word", "is_shown"),
    [
        ("a girl swings on a swing in a playground", "on", True),
        ("a girl on a swing is pushed by her brother", "on", False),  # she is moved off it
        ("a tram passes a church and stops", "stops", True),
        ("a boy and a girl ride a seesaw", "ride", True),
        ("two children ride swings", "ride", True),
    ],
)
def test_a_swing_bears_on_its_seat_and_what_passes_may_stop(text, word, is_shown):
    said = " ".join(report(text).shown).split()
    assert (word in said) == is_shown


def test_the_head_of_a_compound_is_not_its_first_noun():
    assert "aircraft" in report("a jet takes off from an aircraft carrier").not_understood


def test_a_cyclist_has_one_bicycle():
    assert sum("bicycle" in line for line in report("a cyclist pushes his bicycle").scene) == 0
    said = report("a cyclist falls off his bike")
    assert "bike" in (*said.shown, *said.uncertain)


def test_what_flashes_is_hidden_by_nothing():
    text = "a square flashes at 2 Hz"
    assert "flashes" in report(text).shown
    assert not any("hidden" in note for note in report(text).notes)


@pytest.mark.parametrize(
    ("text", "word", "is_shown"),
    [
        ("a duck swims and then walks", "walks", False),  # on a sea without a shore
        ("a dog swims and then walks onto the beach", "walks", False),
        ("a man swims, then walks along the beach", "walks", False),
        ("a man swims, then walks along the beach", "swims", True),
        ("a bird eats", "eats", True),  # on grass, not in the sky
        ("a bird eats in the sky", "eats", False),
        ("a cow eats", "eats", True),
        ("a chicken eats", "eats", True),
        ("a box moves up and down", "up and down", True),
        ("a ball goes up and down", "up and down", True),
        ("a cube moves up", "up", True),
        ("a girl rides a scooter across the road", "across", False),
        ("a boy rides a skateboard across the street", "across", False),
        ("a man walks across the road", "across", True),
        ("a man runs down the stairs", "down", True),
        ("a woman walks down the stairs", "down", True),
        ("a ball bounces down the stairs", "down", True),
        ("a house with a red roof", "red", False),
    ],
)
def test_an_act_is_shown_where_its_body_can_do_it(text, word, is_shown):
    check(text, word, is_shown)


@pytest.mark.parametrize(
    ("text", "word", "is_shown"),
    [
        ("a man walks in the distance", "in the distance", False),  # he fills the image
        ("a distant house", "distant", False),
        ("a boat sails far away", "far away", True),
    ],
)
def test_what_is_large_in_the_image_is_not_far(text, word, is_shown):
    check(text, word, is_shown)


@pytest.mark.parametrize(
    ("text", "is_shown"),
    [
        ("a car without wheels", False),
        ("a tree without leaves", False),
        ("a house with no windows", False),
        ("a street without cars", True),
        ("a man without a hat walks", True),
    ],
)
def test_what_a_body_has_is_not_said_to_be_absent(text, is_shown):
    word = text.split(" ")[-1] if "hat" not in text else "hat"
    check(text, word, is_shown)


@pytest.mark.parametrize(
    ("text", "word", "is_shown"),
    [
        ("a dog knocks over a chair", "knocks over", True),
        ("a man knocks down a stack of boxes", "knocks down", True),
        ("a cat knocks over a glass on a table", "knocks over", False),  # it stands below
        ("a robot bumps into a chair and turns around", "turns around", True),
        ("a man turns to the camera", "turns", True),
        ("a train leaving the station", "leaving", True),
        ("a woman enters a shop", "enters", False),  # whose door nobody goes through
        ("customers stand in line in front of a counter", "in line", True),
        ("a ship sinks in the sea", "sinks", True),
        ("a horse rises", "rises", False),
    ],
)
def test_what_an_act_changes_is_seen_to_change(text, word, is_shown):
    check(text, word, is_shown)


@pytest.mark.parametrize(("share", "lost"), [(1.0, []), (0.01, ["wave"])])
def test_an_act_whose_limbs_hardly_move_in_the_image_is_said(share, lost):
    said, scene = staged("a woman waves in the street")
    times = [0.0, 0.5, 1.0]
    cameras = [replace(each, focal=share * each.focal) for each in map(scene.camera, times)]
    found = find_tiny(said, scene.actors, cameras, times, SIZE)
    assert [one.value for one in found] == lost


@pytest.mark.parametrize(("noun", "kind"), [("car", "drive"), ("dog", "run"), ("bird", "fly")])
@pytest.mark.parametrize("pace", [1.0, 1.7, 3.0])
def test_haste_is_shown_of_who_has_it(noun, kind, pace):
    actors = stage(SceneObject(noun, motions=(Motion(kind, pace=pace),)), place="plain").actors
    for said in (1.7, 3.0, 9.0):
        words = SceneDescription(objects=(SceneObject(noun, motions=(Motion(kind, pace=said),)),))
        is_slower = bool([*find_unhurried(words, actors, np.linspace(0.0, 2.0, 9))])
        assert is_slower == (pace < 0.75 * said)
