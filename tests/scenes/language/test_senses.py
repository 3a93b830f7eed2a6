"""Nouns with several senses, verbs with particles, and what carries the camera."""

from __future__ import annotations

import pytest

from texvent.scenes.language.parser import parse_prompt


@pytest.mark.parametrize(
    ("prompt", "word"),
    [
        ("A child stacks wooden blocks until the tower falls over.", "tower"),
        ("A boy builds a tower of cups.", "tower"),
        ("Vendors with tomatoes call out to shoppers.", "call"),
        ("People in the lobby shrink to dots.", "dots"),
        ("A man walks, the floors slide downward.", "floors"),
        ("A surfer rides along the face of a wave.", "face"),
        ("A blacksmith hammers a glowing iron bar.", "bar"),
        ("A swimmer glides down the lane of a pool.", "lane"),
        ("A crane spreads its wings beside a lake.", "crane"),
        ("A train crosses flat farmland.", "flat"),
        ("A potter pulls up the walls of a vase.", "walls"),
        ("A neon arrow blinks above a door.", "arrow"),
        ("A target on a linear stage.", "stage"),
        ("A pole vaulter sprints down the runway.", "runway"),
    ],
)
def test_what_a_word_does_not_mean_here_is_not_shown(prompt, word) -> None:
    found = parse_prompt(prompt)
    assert word not in found.shown
    assert word in found.not_understood


@pytest.mark.parametrize(
    ("prompt", "noun"),
    [
        ("A baseball player swings a bat.", "baseball bat"),
        ("A golfer swings a club.", "golf club"),
        ("A surfer stands on his board.", "surfboard"),
        ("A stone tower on a hill.", "tower"),
        ("A crane lifts a beam.", "crane"),
    ],
)
def test_other_words_tell_the_sense(prompt, noun) -> None:
    assert noun in {one.noun for one in parse_prompt(prompt).objects}


@pytest.mark.parametrize(
    ("prompt", "place"),
    [
        ("A woman throws a bowling ball down the lane.", "bowling alley"),
        ("A tennis player runs on a clay court.", "tennis court"),
        ("A train rolls along the track.", "railway"),
    ],
)
def test_other_words_tell_the_place(prompt, place) -> None:
    assert parse_prompt(prompt).surroundings.place == place


@pytest.mark.parametrize(
    ("prompt", "carrier"),
    [
        ("A drone flies through gates. The view is from the drone itself.", "drone"),
        ("View from the window of a train crossing farmland.", "train"),
        ("A city street filmed from the back seat of a taxi.", "taxi"),
    ],
)
def test_what_carries_the_camera_is_not_in_the_picture(prompt, carrier) -> None:
    found = parse_prompt(prompt)
    assert carrier not in {one.noun for one in found.objects}
    assert {one.shown for one in found.substituted if one.said == carrier} == {
        "the camera's view from it"
    }
    assert found.shot.moves[0].kind == "travel"


def test_who_looks_from_a_window_carries_no_camera() -> None:
    found = parse_prompt("A woman looks from the window of a car.")
    assert {"woman", "car"} <= {one.noun for one in found.objects}


@pytest.mark.parametrize(
    ("prompt", "lost"),
    [
        ("a woman is putting away her phone", "putting"),
        ("a man runs his thumb along a knife", "runs"),
        ("a circle of friends", "circle"),
        ("a coach shouts while the players run", "coach"),
    ],
)
def test_words_in_another_sense_show_nothing(prompt: str, lost: str) -> None:
    assert lost in parse_prompt(prompt).not_understood


def test_a_telescope_has_its_tripod() -> None:
    assert {one.noun for one in parse_prompt("a telescope on a tripod").objects} == {
        "telescope", "tripod"
    }  # fmt: skip


def test_a_drone_that_looks_down_is_not_in_the_picture() -> None:
    description = parse_prompt("a drone looking straight down at a road with cars")
    assert [one.noun for one in description.objects] == ["car"]


def test_what_stands_on_the_ground_is_not_in_the_sky() -> None:
    assert parse_prompt("a windmill turns, music hangs in the air").surroundings.place != "sky"
    assert parse_prompt("birds in the air").surroundings.place == "sky"


@pytest.mark.parametrize(
    ("prompt", "word"),
    [
        ("A crane stands in shallow water and catches a fish.", "crane"),
        ("A cook stirs the batter in a bowl.", "batter"),
        ("A woman paints her nails.", "nails"),
        ("A man beats his chest.", "chest"),
        ("A bride with a long train walks.", "train"),
        ("A farmer stands by a pen full of pigs.", "pen"),
        ("A violinist draws the bow over the strings.", "bow"),
        ("A tulip bulb lies in soil.", "bulb"),
        ("A spring flows from a rock.", "spring"),
        ("A hoop lies on the grass.", "hoop"),
        ("A skater grinds along a rail.", "rail"),
        ("Soldiers drill on a field.", "drill"),
        ("A man saw a bird.", "saw"),
        ("A boxer throws a party.", "throws"),
        ("A woman turns on a lamp.", "turns"),
        ("A teenager sits before a television; the screen turns green.", "screen"),
        ("A black sedan stops and its doors open.", "doors"),
        ("A rooster with a red comb stands on a wall.", "comb"),
    ],
)
def test_a_sense_that_is_not_shown_is_reported(prompt: str, word: str) -> None:
    found = parse_prompt(prompt)
    assert word in found.not_understood
    assert word not in found.shown


@pytest.mark.parametrize(
    ("prompt", "motion"),
    [("A skier carves down a slope.", "ski"), ("A surfer carves a wave.", "surf")],
)
def test_a_verb_takes_the_sense_that_its_subject_tells(prompt: str, motion: str) -> None:
    (one,) = parse_prompt(prompt).objects
    assert one.motion is not None
    assert one.motion.kind == motion


def test_what_is_put_on_is_not_stood_on() -> None:
    assert not parse_prompt("A man puts on a coat.").relations


@pytest.mark.parametrize(
    ("prompt", "lost"),
    [
        ("A wheel turns. A cooper hits it. He walks.", "walks"),
        ("A car stops. He waves.", "waves"),
        ("He spins a black disc.", "spins"),
        ("A statue stands in a park. She walks.", "walks"),
        ("A potter sits. It turns.", "turns"),
    ],
)
def test_a_pronoun_of_a_person_never_means_a_thing(prompt: str, lost: str) -> None:
    assert lost in parse_prompt(prompt).not_understood


@pytest.mark.parametrize(
    ("prompt", "kind"),
    [("A woman walks. She jumps.", "jump"), ("A dog runs. It jumps.", "jump")],
)
def test_a_pronoun_means_who_it_can(prompt: str, kind: str) -> None:
    (one,) = parse_prompt(prompt).objects
    assert kind in [motion.kind for motion in one.then]


@pytest.mark.parametrize(
    ("prompt", "nouns"),
    [
        ("a girl plays piano, her fingers flying over the keys", ["girl", "piano"]),
        ("A man sits. The left hand holds a cup.", ["man", "cup"]),
        ("a volleyball team celebrates", ["person"]),
        ("a girl plays the violin while her sister listens", ["girl", "violin", "girl"]),
        ("a bicycle stands upside down with a spinning wheel", ["parked bicycle"]),
        ("a laser dot moves across a wall", ["laser dot", "wall"]),
    ],
)
def test_no_parts_or_senses_stand_as_things(prompt: str, nouns: list[str]) -> None:
    assert [one.noun for one in parse_prompt(prompt).objects] == nouns


@pytest.mark.parametrize(
    ("prompt", "place"),
    [
        ("a man fills a bottle with water", "indoor"),
        ("a bottle is turned until the water runs out", "indoor"),
        ("a duck swims on the water", "sea"),
        ("a kayak in white water", "river"),
    ],
)
def test_water_in_a_vessel_is_no_sea(prompt: str, place: str) -> None:
    assert parse_prompt(prompt).surroundings.place == place


@pytest.mark.parametrize(
    ("prompt", "words"),
    [
        ("A girl is left alone in a room.", ("left", "alone")),
        ("A toilet in a cramped space.", ("cramped", "space")),
        ("A giraffe stands in a pen.", ("pen",)),
        ("Signs show where to park.", ("show", "park")),
        ("A bowl on a table with food present.", ("present",)),
        ("A cake with frosting.", ("frosting",)),
        ("A boy has one arm up.", ("up",)),
    ],
)
def test_words_of_captions_in_another_sense_are_reported(prompt: str, words: tuple[str]) -> None:
    assert set(words) <= set(parse_prompt(prompt).not_understood)


def test_left_is_a_way_where_something_goes() -> None:
    assert parse_prompt("a car drives left").summary()[0] == "1 car, drives left"
    assert parse_prompt("the camera pans left over a street").shot.moves[0].direction == "left"
    assert parse_prompt("The car left the house").summary()[0] == "1 car, drives, from 1 house"
    assert parse_prompt("an astronaut floats in space").surroundings.place == "space"


@pytest.mark.parametrize(
    ("prompt", "word", "noun"),
    [
        ("A horse whose body is made of glass.", "glass", "glass"),
        ("A street lamp with frosted glass.", "glass", "glass"),
        ("A rug bends under the weight of a box.", "weight", "barbell"),
        ("A bed with mosquito netting.", "mosquito", "mosquito"),
        ("A traffic pole on a street.", "traffic", "car"),
        ("A woman in ski gear.", "ski", "ski"),
        ("A man is body surfing in the sea.", "body surfing", "surfboard"),
    ],
)
def test_substances_and_parts_of_compounds_are_no_things(prompt, word, noun) -> None:
    found = parse_prompt(prompt)
    assert word in " ".join(found.not_understood)
    assert noun not in {one.noun for one in found.objects}


@pytest.mark.parametrize(
    ("prompt", "first"),
    [
        ("a man on skis", "1 man, does 'stand on skis'"),
        ("a man wearing skis poses", "1 man, does 'stand on skis'"),
        ("two people on skis going down a hill", "2 people, ski"),
    ],
)
def test_who_is_on_skis_has_them_on(prompt: str, first: str) -> None:
    found = parse_prompt(prompt)
    assert found.summary()[0] == first
    assert "ski" not in {one.noun for one in found.objects}


def test_the_baby_of_an_animal_is_no_child() -> None:
    found = parse_prompt("A koala with her baby")
    assert [one.noun for one in found.objects] == ["koala", "koala"]
    assert "baby" in {one.said for one in found.substituted}


def test_an_owner_without_its_apostrophe_is_one() -> None:
    assert [one.count for one in parse_prompt("A persons hand").objects] == [1]
