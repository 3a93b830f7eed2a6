"""A place that the prompt does not say fits its nouns; buildings passed are no setting."""

from __future__ import annotations

import pytest

from texvent.scenes.language.parser import parse_prompt
from texvent.scenes.language.vocabulary.place_cues import BUILDINGS, ENCLOSED, ROOMS
from texvent.scenes.models.nouns import NOUNS
from texvent.scenes.staging.placement.tables.tabletop import set_on_table
from texvent.scenes.staging.surroundings.places import PLACES, is_room


def test_enclosed_places_are_those_with_walls() -> None:
    assert not ROOMS & BUILDINGS
    assert {place for place in PLACES if is_room(place)} == ENCLOSED


@pytest.mark.parametrize(
    "prompt",
    [
        "A city bus drives past a row of shops.",
        "Two men play chess outside a cafe.",
        "A dog sits in front of a shop.",
        "A fire truck leaves the station.",
        "A woman walks past the library.",
        "A monkey peels a banana while sitting on a branch.",
        "A woman reads a book under the sun.",
        "A referee blows his whistle during a match.",
        "A street musician plays the guitar.",
        "Candles in the wind.",
        "A surfer rides along a big wave.",
    ],
)
def test_what_is_outdoors_is_in_no_room(prompt) -> None:
    assert parse_prompt(prompt).surroundings.place not in ENCLOSED


@pytest.mark.parametrize(
    ("prompt", "place"),
    [
        ("A man peels a potato over a sink.", "kitchen"),
        ("A cat sleeps on a carpet.", "indoor"),
        ("A girl dances in a studio.", "indoor"),
        ("A cup rolls over the floor.", "indoor"),
        ("A man hammers on an anvil.", "workshop"),
        ("A man buys bread in a shop.", "supermarket"),
        ("A woman kneads dough.", "kitchen"),
        ("A man cracks an egg into a bowl.", "kitchen"),
    ],
)
def test_what_is_inside_is_in_a_room(prompt, place) -> None:
    assert parse_prompt(prompt).surroundings.place == place


@pytest.mark.parametrize(
    ("prompt", "place"),
    [
        ("A shark passes a diver.", "underwater"),
        ("An octopus crawls over a rock.", "underwater"),
        ("A shark circles a boat.", "sea"),
        ("A tractor ploughs.", "soil"),
        ("A combine harvester drives.", "wheat field"),
        ("A tractor drives.", "road"),
        ("A car passes a farmhouse.", "road"),
        ("An astronaut floats.", "space"),
        ("A spacecraft passes a planet.", "space"),
        ("An astronaut rides a horse.", "grass"),
        ("A drone lifts off from a picnic table.", "grass"),
        ("A cup falls off a garden table.", "grass"),
        ("A woman whisks cream by a campfire.", "grass"),
        ("A man chops wood.", "grass"),
        ("A pitch-black cat runs.", "grass"),
        ("A waiter drops ice into a glass.", "indoor"),
        ("A polar bear walks over ice.", "snow"),
    ],
)
def test_what_lives_and_is_done_in_one_place_is_there(prompt, place) -> None:
    assert parse_prompt(prompt).surroundings.place == place


def test_a_place_that_the_program_chose_is_noted() -> None:
    notes = parse_prompt("A monkey sits on a branch.").notes
    assert "no place is said: a forest is chosen" in notes
    said = parse_prompt("A monkey sits on a branch in a forest.").notes
    assert not any("no place" in note for note in said)


def test_a_table_is_added_only_inside_and_noted() -> None:
    inside = set_on_table(parse_prompt("A woman stands in a kitchen. Three tomatoes."), NOUNS)
    assert "a table is added, on which is: tomato" in inside.notes
    outside = set_on_table(parse_prompt("A woman stands in a field. Three tomatoes."), NOUNS)
    assert "table" not in {one.noun for one in outside.objects}


def test_what_is_seen_at_sunset_is_outdoors() -> None:
    assert parse_prompt("A toy robot slides at sunset.").surroundings.place == "grass"
    assert parse_prompt("A cat on a sofa at sunset.").surroundings.place in ENCLOSED


@pytest.mark.parametrize(
    ("prompt", "place", "backdrops"),
    [
        ("a bus on a mountain road", "road", ("mountain",)),
        ("a mountain lake", "lake", ("mountain",)),
        ("a village in the mountains", "village", ("mountain",)),
        ("a farm with mountain peaks", "farmyard", ("mountain",)),
        ("snow-capped mountains behind a lake", "lake", ("mountain",)),
        ("a misty mountain valley", "mountain", ()),
        ("rugged mountains", "mountain", ()),
        ("a desert with sand dunes", "dunes", ()),
    ],
)
def test_mountains_stand_behind_other_places(prompt, place, backdrops) -> None:
    said = parse_prompt(prompt)
    assert (said.surroundings.place, said.surroundings.backdrops) == (place, backdrops)
    assert set(said.not_understood) <= {"behind"}


def test_counted_mountains_are_things() -> None:
    assert parse_prompt("two mountains").objects[0].count == 2


def test_snow_lies_around_mountains_that_are_not_just_capped() -> None:
    assert parse_prompt("snowy mountains").surroundings.has_snow
    assert parse_prompt("a snowy mountain behind a house").surroundings.has_snow
    assert not parse_prompt("snow-capped mountains").surroundings.has_snow


def test_one_stands_in_front_of_mountains_and_is_not_seen_behind_them() -> None:
    assert not parse_prompt("a barn in front of mountains").not_understood
    assert parse_prompt("a car drives behind the mountains").not_understood == ("behind",)


@pytest.mark.parametrize(
    ("prompt", "place"),
    [
        ("restaurant", "restaurant"),
        ("an office with two chairs", "office"),
        ("indoor swimming pool", "pool hall"),
        ("golf course", "golf course"),
        ("a bakery", "bakery"),
    ],
)
def test_a_place_that_the_prompt_is_all_about_is_the_scene(prompt: str, place: str) -> None:
    assert parse_prompt(prompt).surroundings.place == place


@pytest.mark.parametrize("prompt", ["the library", "a barn", "a dog in front of a library"])
def test_a_building_that_is_looked_at_stays_a_thing(prompt: str) -> None:
    nouns = {one.noun for one in parse_prompt(prompt).objects}
    assert nouns & {"building", "barn"}


@pytest.mark.parametrize(
    "prompt", ["a dog on train tracks", "a train travels along railroad tracks", "a rail yard"]
)
def test_tracks_that_something_is_on_are_a_railway(prompt: str) -> None:
    assert parse_prompt(prompt).surroundings.place == "railway"


def test_a_plane_of_which_only_an_airport_is_said_is_on_the_ground() -> None:
    (plane,) = parse_prompt("an airplane on a runway").objects
    assert plane.motion is not None
    assert plane.motion.kind == "stand"
    (other,) = parse_prompt("an airplane takes off from a runway").objects
    assert other.motion is not None
    assert other.motion.kind != "stand"


def test_a_space_is_that_of_the_stars_only_where_the_words_tell() -> None:
    assert parse_prompt("a sink in a cramped space").surroundings.place != "space"
    assert parse_prompt("an astronaut floats in the space").surroundings.place == "space"
    assert parse_prompt("a rock drifts through space").surroundings.place == "space"


def test_a_city_before_another_noun_is_reported_as_a_city() -> None:
    report = parse_prompt("a cat on a tokyo street at night").report()
    assert [(one.said, one.shown) for one in report.substituted] == [("tokyo", "city")]


def test_to_park_is_no_park() -> None:
    assert parse_prompt("an arrow shows where to park").surroundings.place != "park"
    assert parse_prompt("a man walks to the park").surroundings.place == "park"


def test_the_backdrop_of_a_landscape_is_that_landscape() -> None:
    assert parse_prompt("a mill against the backdrop of the hills").surroundings.place == "hills"


@pytest.mark.parametrize(
    "prompt", ["a clock on a tall building", "a clock and a traffic light", "a cup before a shop"]
)
def test_what_stands_outdoors_is_in_no_room(prompt: str) -> None:
    assert parse_prompt(prompt).surroundings.place not in (None, "indoor", "kitchen")


def test_snow_that_is_said_is_no_choice_of_the_program() -> None:
    notes = parse_prompt("a boy stands in the snow").notes
    assert not [one for one in notes if one.startswith("no place is said")]
