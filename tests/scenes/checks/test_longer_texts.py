"""Captions of several sentences: who is named again, what a camera passes, what a report tells."""

import numpy as np
import pytest
from tests.scenes.staging.test_distances_on_supports import place_by_id
from tests.scenes.test_short_prompts import report, staged

from texvent.errors import ConfigError
from texvent_scenes.colours import name_colour
from texvent_scenes.defaults import complete
from texvent_scenes.description import to_description
from texvent_scenes.models.nouns import NOUNS
from texvent_scenes.read import read
from texvent_scenes.spec.data import scene_from_data
from texvent_scenes.spec.scene import Relation, SceneObject


def nouns_of(text):
    return [(one.noun, one.count) for one in read(text, NOUNS).scene.objects]


DRAWN = {
    "a red car and a blue car drive, both cars turn left": "car, car",
    "a man and a woman stand. Both people wave": "man, woman",
    "a tennis ball and a basketball roll. Both balls stop": "tennis ball, basketball",
    "a boxer and a referee walk. The two men jump": "boxer, referee",
    "three dogs run. The three dogs jump": "3 dog",
    "a cat sits. Two dogs sit. The two dogs bark": "cat, 2 dog",
    "a girl on a mat jumps, the camera shows the whole mat": "girl, rug",
    "a lighthouse on a cliff, the camera circles the tower": "lighthouse, cliff",
    "two balls roll": "2 ball",
    "a dog and a cat run. Two dogs bark": "dog, cat, 2 dog",
    "a car and a bus drive. Both trucks stop": "car, bus, 2 truck",
    "the sky is orange, a car drives": "car",
    "a dog runs, the walls are orange": "dog, 3 wall",
    "a lamp, the leaves are orange": "lamp, 3 leaf",
    "a dog runs, the camera is mounted on a car": "dog",
    "a man runs, the camera is attached to a bicycle": "man",
    "a bird flies, the camera is strapped to a drone": "bird",
    "two boys play table tennis. The ball flies over the net":
        "2 child, ping-pong ball, table tennis table",
    "two boys play ping pong. The ball flies over the net":
        "2 child, ping-pong ball, table tennis table",
    "The net swings. A man runs": "man",
    "The lamp swings and a dog runs": "lamp, dog",
    "The bell rocks, a man runs": "bell, man",
    "a dog runs, the camera is on a motorboat": "dog",
    "a cat runs. The camera is in a car": "cat",
    "a horse gallops, the camera is on a table": "horse",
    "a tennis player hits the ball over the net": "tennis player, tennis ball, tennis net",
    "a player on a tennis court waits, a ball rolls": "tennis player, tennis ball",
    "a player kicks the ball": "football player, football",
    "a fish stands. The fish swims": "fish",
    "a sheep stands. The sheep runs": "sheep",
    "a deer stands. The deer jumps": "deer",
    "a girl sketches a horse": "girl",
    "a man draws a ship": "man",
    "a child is drawing a house": "child",
}  # fmt: skip
"""Text → the things that it draws: named again, of one game, on paper, that bear a camera."""


def test_each_text_draws_its_things_once():
    for text, drawn in DRAWN.items():
        found = (f"{count} {noun}" if count > 1 else noun for noun, count in nouns_of(text))
        assert ", ".join(found) == drawn, text


@pytest.mark.parametrize(
    ("text", "fixed", "move"),
    [("trees and houses rush by", ("tree", "house"), "truck"),
     ("a boy rides a bicycle while trees pass by", ("tree",), "follow"),
     ("street lamps pass. The shot is taken from a car driving", ("street lamp",), "travel"),
     ("first-person view of a man walking. Shelves slide past", ("shelf",), "travel")],
)  # fmt: skip
def test_a_camera_goes_past_what_is_fixed_which_stays(text, fixed, move):
    scene = read(text, NOUNS).scene
    own = [one for one in scene.objects if one.noun in fixed]
    assert len(own) == len(fixed)
    assert not any(one.motions for one in own)
    assert move in [one.kind for one in scene.camera.moves]


@pytest.mark.parametrize("text", ["a car passes by", "a chair slides past a table",
                                  "a bottle slides by on a conveyor belt"])  # fmt: skip
def test_what_can_go_or_has_a_goal_goes_past_itself(text):
    objects = read(text, NOUNS).scene.objects
    assert any(one.motions for one in objects)
    assert not read(text, NOUNS).scene.camera.moves


@pytest.mark.parametrize("text", ["hills rise behind a lake", "skyscrapers rise over a road",
                                  "a tower rises beside a river"])  # fmt: skip
def test_high_things_that_rise_stand(text):
    assert not any(one.kind == "rise" for each in read(text, NOUNS).scene.objects
                   for one in each.motions)  # fmt: skip


@pytest.mark.parametrize(
    ("text", "noun"),
    [("children chase a kite. The camera pans to keep it in the frame", "kite"),
     ("a dog chases a ball, the camera keeps the ball in view", "ball"),
     ("a man throws a frisbee, the camera keeping him in the center of the frame", "man"),
     ("two men spar in a ring with ropes, the camera keeping both of them in frame", "man"),
     ("two dogs run past a fence. The camera pans, keeping them in frame", "dog")],
)  # fmt: skip
def test_what_is_kept_in_the_image_is_followed_and_held(text, noun):
    reading = read(text, NOUNS)
    claims = [one for one in reading.claims if one.kind == "in image"]
    assert {reading.scene.objects[one.subject].noun for one in claims} == {noun}
    assert len({one.word for one in claims}) == 2
    assert "follow" in [one.kind for one in reading.scene.camera.moves]


@pytest.mark.parametrize(
    ("text", "kinds"),
    [("a girl on a swing wugs", ["sit"]), ("a man on a chair wugs", ["sit"]),
     ("a boy on a horse wugs", ["sit"]), ("a man on a road wugs", ["stand"])],
)  # fmt: skip
def test_who_is_on_a_seat_sits_whatever_else_is_said(text, kinds):
    assert [one.kind for one in read(text, NOUNS).scene.objects[0].motions] == kinds


@pytest.mark.parametrize("noun", ["helicopter", "bird", "man"])
def test_the_roof_of_a_building_is_in_no_room(noun):
    assert read(f"a {noun} on the roof of a hospital", NOUNS).scene.place.name is None


@pytest.mark.parametrize("who", ["elderly man", "elderly woman", "clown"])
def test_who_is_told_by_the_head_is_not_shown_without_it(who):
    said = report(f"a {who} repairs a watch at a workbench, extreme close-up")
    assert who not in said.shown
    assert any(one.startswith(f"the {who}: the head") for one in said.not_shown)


@pytest.mark.parametrize("text", ["a woman in a red coat stands with an umbrella",
                                  "a man in a blue jacket walks with a flag",
                                  "a girl in a hat stands with a bucket"])  # fmt: skip
def test_who_wears_something_has_hands_for_another_thing(text):
    scene, said, _ = staged(text)
    assert not scene.missing
    assert "with" in said.shown


@pytest.mark.parametrize(
    ("colour", "name"),
    [((0.02, 0.03, 0.07), "blue"), ((0.09, 0.06, 0.04), "brown"), ((0.02, 0.06, 0.02), "green"),
     ((0.05, 0.02, 0.08), "purple"), ((0.3, 0.25, 0.15), "beige"), ((0.02, 0.1, 0.1), "blue-green"),
     ((0.15, 0.02, 0.02), "red"), ((0.55, 0.4, 0.28), "beige")],
)  # fmt: skip
def test_a_dark_colour_is_named_by_its_hue(colour, name):
    assert name_colour(colour) == name


def test_a_machine_keeps_its_stated_position_and_things_come_to_it():
    lift = (Relation("lift", ("cup",)),)
    arm = SceneObject("robot arm", id="arm", relations=lift, position_m=(1.1, 1.9))
    on = (Relation("on", ("table",)),)
    things = (SceneObject("table", id="table"), SceneObject("cup", id="cup", relations=on))
    placed = place_by_id(arm, *things)
    np.testing.assert_allclose(placed["arm"].track.at(0.0).position[:2], (1.1, 1.9), atol=0.02)
    hand = placed["arm"].anchor("hands", 2.0)[:, 3]
    assert np.linalg.norm(placed["cup"].middle(2.0) - hand) < 0.2
    borne = SceneObject("robot arm", id="arm", relations=(*lift, *on), position_m=(1.1, 1.9))
    with pytest.raises(ConfigError, match=r"position_m is .*, but .* needs it .* away; leave"):
        place_by_id(borne, *things)


@pytest.mark.parametrize("noun", ["suitcase", "trailer", "office chair"])
def test_what_rolls_on_castors_is_echoed_as_it_is_said(noun):
    data = {"objects": [{"noun": noun, "motions": [{"kind": "roll", "direction": "left"}]}]}
    said = complete(to_description(scene_from_data(data)), NOUNS)
    assert [one.kind for one in said.objects[0].motions] == ["roll"]


@pytest.mark.parametrize(
    "text", ["two sailboats race, white clouds move across the sky",
             "a duck swims, the sky is above it", "a ship, a deep blue sky"],
)  # fmt: skip
def test_what_floats_is_on_water_under_a_sky(text):
    assert read(text, NOUNS).scene.place.name != "sky"


@pytest.mark.parametrize(
    ("text", "colour"),
    [("a scientist in a lab coat walks", "white"), ("a bride in a wedding dress dances", "white"),
     ("a man in a denim jacket runs", "blue")],
)  # fmt: skip
def test_a_compound_that_tells_a_colour_has_it(text, colour):
    reading = read(text, NOUNS)
    assert reading.scene.objects[1].colour == colour
    assert reading.scene.place.name is None
    assert not reading.not_understood


@pytest.mark.parametrize(
    ("text", "word"), [("a truck hits the leg of a chair", "leg"), ("a couple sits", "couple"),
                       ("a horse runs, its mane waves", "mane")],
)  # fmt: skip
def test_a_word_for_a_part_or_for_some_goes_with_its_thing(text, word):
    assert any(one.word == word and one.kind == "seen" for one in read(text, NOUNS).claims)


@pytest.mark.parametrize("noun", ["hot air balloon", "zebra", "football"])
def test_a_caption_names_both_colours_of_a_pattern(noun):
    lines = report(f"a {noun} in a meadow").caption
    line = next(one for one in lines if one.startswith(noun))
    assert " and " in line[: line.index(" m ")]


@pytest.mark.parametrize(
    ("text", "place"),
    [("a cat looks at a bird on a branch", [(), ("on",), ()]),
     ("a cat stares at a goldfish in a bowl", [(), ("in",), ()]),
     ("a dog barks at a cat on a wall", [(), ("on",), ()]),
     ("a man watches a bird on a fence", [(), ("on",), ()])],
)  # fmt: skip
def test_what_follows_the_one_looked_at_says_where_that_is(text, place):
    said = [tuple(each.kind for each in one.relations if each.kind in ("in", "on"))
            for one in read(text, NOUNS).scene.objects]  # fmt: skip
    assert said == place


@pytest.mark.parametrize(
    ("text", "line"),
    [("a pianist plays a grand piano", "the grand piano: a piano is drawn"),
     ("a woman kneads dough on a table", "the table: a kitchen counter is drawn")],
)  # fmt: skip
def test_a_thing_that_an_act_brings_as_another_one_is_told(text, line):
    assert line in report(text).not_shown


@pytest.mark.parametrize(
    ("colour", "is_dark"), [("black", True), ("orange", False), ("blue", False)]
)
def test_a_black_sky_is_so_down_to_the_horizon(colour, is_dark):
    sky = staged(f"a rocket on mars under a {colour} sky")[0].environment(0.0)
    assert (max(sky.sky_horizon) < 0.1) == is_dark


@pytest.mark.parametrize("text", ["a woman kneads dough", "a chef chops carrots",
                                  "a man repairs a watch at a workbench"])  # fmt: skip
def test_a_push_in_that_nobody_sees_is_told(text):
    said = report(f"{text}, extreme close-up, slow push in")
    assert "push in" not in said.shown
    assert "dolly of the camera: it stays where it is" in said.not_shown
    assert "push in" in report("a dog runs, slow push in").shown
