"""Words of film: the camera's moves, views and gear are no things; elsewhere they are."""

from __future__ import annotations

import pytest

from texvent.scenes.language.parser import parse_prompt


@pytest.mark.parametrize(
    ("prompt", "noun"),
    [
        ("A woman waits at a bus stop, camera on a tripod.", "tripod"),
        ("A man walks on a beach while the camera tracks him.", "railway track"),
        ("Slow dolly past the desks of an office.", "trolley"),
        ("Quick pan from the window to the door of a living room.", "frying pan"),
        ("Pan across a desert.", "frying pan"),
        ("Aerial view of a road. The drone hovers, looking straight down.", "drone"),
        ("A crane shot rises over two houses.", "crane"),
        ("Pedestal up from a box to a lamp.", "column"),
        ("A house, shot from a crane.", "crane"),
    ],
)
def test_words_of_film_are_no_things(prompt, noun) -> None:
    assert noun not in {one.noun for one in parse_prompt(prompt).objects}


@pytest.mark.parametrize(
    ("prompt", "noun"),
    [
        ("A man carries a tripod across a field.", "tripod"),
        ("A cook holds a pan.", "frying pan"),
        ("A crane lifts a car.", "crane"),
        ("A drone flies over a field.", "drone"),
        ("A truck drives past a house.", "truck"),
        ("A truck left on a beach.", "truck"),
        ("A truck left to rust in a field.", "truck"),
        ("A pan over a fire.", "frying pan"),
        ("A pan left in a sink.", "frying pan"),
    ],
)
def test_the_same_words_elsewhere_are_things(prompt, noun) -> None:
    assert noun in {one.noun for one in parse_prompt(prompt).objects}


@pytest.mark.parametrize(
    ("prompt", "move"),
    [
        ("A dog runs, camera on a tripod.", ("static", None)),
        ("A locked shot of a street with cars.", ("static", None)),
        ("A static camera captures two dogs.", ("static", None)),
        ("The camera arcs around a statue.", ("orbit", None)),
        ("The camera pushes forward through a forest.", ("travel", "forward")),
        ("A slow pan to the right over a valley.", ("pan", "right")),
        ("Slow tilt up a tower.", ("tilt", "up")),
        ("Rain pours. The camera slowly tilts toward the street.", ("tilt", "down")),
        ("Smooth lateral camera movement past a row of houses.", ("truck", None)),
        ("Slow dolly past two houses.", ("truck", None)),
        ("The camera starts on a cat and tilts up to a dog.", ("tilt", "up")),
        ("A steadicam follows a dog.", ("follow", None)),
        ("A pan left through a market with two dogs.", ("pan", "left")),
        ("A truck left along a row of houses.", ("truck", "left")),
        ("The camera trucks right along a beach.", ("truck", "right")),
        ("A pedestal down from the top of a tower.", ("pedestal", "down")),
        ("A tilt up to reveal a tower.", ("tilt", "up")),
        ("An arc left around a statue.", ("orbit", "left")),
        ("A dolly left past a shelf.", ("dolly", "left")),
        ("A jib up from a lake.", ("crane", "up")),
        ("A slow push-in on a man who eats soup.", ("dolly", "in")),
        ("A pullback from a child.", ("dolly", "out")),
        ("A flyover of a forest.", ("travel", "forward")),
        ("The camera yaws to the right in a kitchen.", ("pan", "right")),
        ("Pitch motion before a bookshelf.", ("tilt", None)),
        ("The camera rotates about the optical axis before a house.", ("roll", None)),
        ("Rotation of the camera around its optical axis.", ("roll", None)),
        ("The camera rotates to the left in an office.", ("pan", "left")),
        ("The camera turns in place in a workshop.", ("pan", None)),
        ("6-DoF camera motion above a table.", ("handheld", "all axes")),
        ("The camera translates left past a fence.", ("truck", "left")),
        ("The camera moves sideways along a shelf.", ("truck", "right")),
        ("Backward ego-motion in a corridor.", ("travel", "backward")),
        ("Forward ego-motion towards a statue.", ("dolly", "in")),
        ("The camera rotates around a vase.", ("orbit", None)),
    ],
)
def test_moves_of_the_camera(prompt, move) -> None:
    assert move in [(one.kind, one.direction) for one in parse_prompt(prompt).shot.moves]


@pytest.mark.parametrize(
    ("prompt", "moves"),
    [
        ("The camera pans left and right in a kitchen.", [("pan", "right"), ("pan", "left")]),
        ("The camera pitches up and down.", [("tilt", "up"), ("tilt", "down")]),
        ("The camera pans left, then right.", [("pan", "left"), ("pan", "right")]),
    ],
)
def test_a_camera_goes_one_way_and_back(prompt, moves) -> None:
    found = parse_prompt(prompt).shot.moves
    assert [(one.kind, one.direction) for one in found] == moves
    assert [one.phase for one in found] == [0, 1]


def test_what_the_camera_looks_at_is_understood() -> None:
    found = parse_prompt("The camera rolls while facing a statue.")
    assert found.not_understood == ()
    assert [one.noun for one in found.objects] == ["statue"]


@pytest.mark.parametrize(
    ("prompt", "view"),
    [
        ("A bird's-eye view of a road.", "aerial"),
        ("A drone shot, looking straight down, of a boat on a lake.", "top"),
        ("Two boys swing. The camera sits low on the grass.", "low"),
        ("At wheel height, the camera follows a bicycle.", "low"),
        ("An over-the-shoulder shot of a man.", "shoulder"),
        ("A cat sits, at eye level.", "level"),
        ("A dog runs, filmed from the side.", "side"),
        ("A dog runs. The camera is right behind the dog.", None),
        ("The camera is placed behind the dog.", "back"),
        ("A woman pushes a child on a swing from behind.", None),
        ("A rooster watches a dog from above.", None),
        ("A street filmed from the back seat of a taxi.", None),
    ],
)
def test_views_of_the_camera(prompt, view) -> None:
    assert parse_prompt(prompt).shot.view == view


@pytest.mark.parametrize(
    ("prompt", "framing"),
    [
        ("A medium static shot of a woman.", "medium"),
        ("A wide locked shot of a beach.", "wide"),
        ("An extreme close-up of an eye.", "close"),
        ("A full-body shot of a woman.", "full"),
    ],
)
def test_framings(prompt, framing) -> None:
    assert parse_prompt(prompt).shot.framing == framing


def test_words_of_style_are_no_things_and_noted() -> None:
    found = parse_prompt("A dog runs, shallow depth of field, cinematic, 4k, shot on 35mm film.")
    assert found.surroundings.place != "field"
    assert not found.not_understood
    assert any("cinematic, 4 k, 35 mm film" in note for note in found.notes)


def test_who_is_filmed_films_nobody() -> None:
    (swimmer,) = parse_prompt("A swimmer in a pool, filmed from the side.").objects
    assert swimmer.motion is None or swimmer.motion.kind != "photograph"


def test_a_fronted_place_is_no_subject() -> None:
    found = parse_prompt("At a skate park a man jumps.")
    assert [one.noun for one in found.objects] == ["man"]
    assert "park" in found.shown


@pytest.mark.parametrize(
    ("prompt", "noun"),
    [
        ("A black sedan moves through a car wash. The camera sits inside the car.", "car"),
        ("A camera mounted on the bow of a kayak looks ahead at two rocks.", "kayak"),
        ("The camera is attached to the hood of a car that drives through a desert.", "car"),
        ("Dashcam view of a car driving on a country road.", "car"),
        ("POV of a skier going down a slope.", "skier"),
        ("The view from a moving car shows two houses.", "car"),
    ],
)
def test_what_carries_the_camera_is_not_in_the_picture_and_the_camera_goes(prompt, noun) -> None:
    found = parse_prompt(prompt)
    assert noun not in {one.noun for one in found.objects}
    assert "travel" in {move.kind for move in found.shot.moves}


def test_other_vehicles_of_a_dashcam_are_there() -> None:
    found = parse_prompt("Dashcam footage of a truck that overtakes on a highway.")
    assert [one.noun for one in found.objects] == ["truck"]


def test_a_camera_move_has_the_pace_that_is_said_before_or_after_it() -> None:
    slow, fast = (parse_prompt(f"a {pace} camera pan over a village").shot.moves[0]
                  for pace in ("slow", "fast"))  # fmt: skip
    assert slow.pace < 1.0 < fast.pace


def test_who_looks_down_a_street_sees_along_it() -> None:
    assert parse_prompt("the camera looks down a narrow street").shot.view is None
    assert parse_prompt("the camera looks down at a street").shot.view == "aerial"


@pytest.mark.parametrize("move", ["push-in on", "pull-out from", "zoom out from"])
def test_moves_to_and_from_what_is_named_are_listed_and_add_nobody(move) -> None:
    found = parse_prompt(f"A {move} a woman reading on a bench")
    assert [one.noun for one in found.objects] == ["woman", "bench"]
    assert move.rsplit(" ", 1)[0].replace("-", " ") in found.shown


def test_what_is_left_somewhere_goes_nowhere() -> None:
    found = parse_prompt("a dog left alone in a car")
    assert all(one.motion is None or one.motion.direction is None for one in found.objects)
    assert "left" in found.not_understood


def test_who_turns_on_a_road_switches_nothing_on() -> None:
    car = parse_prompt("a car turns left on a road").objects[0]
    assert (car.motion.kind, car.motion.direction, car.blink_hz) == ("turn", "left", None)
    assert parse_prompt("a car turns on its headlights").objects[0].blink_hz is not None
