"""Words that depend on what the staged scene lacks, and words that are read as what is drawn."""

import itertools
from dataclasses import replace

import pytest
from tests.scenes.staged import SIZE
from tests.scenes.test_short_prompts import staged

from texvent_scenes.checks.bodies.phases import find_unfinished
from texvent_scenes.checks.clip.staged_clip import StagedClip
from texvent_scenes.checks.words import CHECKS
from texvent_scenes.description import Claim, SceneDescription
from texvent_scenes.models.activities import ACTIVITIES
from texvent_scenes.models.nouns import NOUNS
from texvent_scenes.read import read
from texvent_scenes.read.parsing.lexicon import word_set
from texvent_scenes.scene_input import list_nouns, understand
from texvent_scenes.spec.scene import Motion, SceneObject
from texvent_scenes.staged_prompt import stage


@pytest.mark.parametrize(
    ("text", "lost", "ties"),
    [("a dog runs beside a tree", "tree", {"beside"}),
     ("a dog runs beside a tree", "dog", {"runs", "beside"}),
     ("a cat sleeps on a table, a bird flies", "table", {"on"}),
     ("a bus waits, a car drives past a house", "car", {"drives", "past"})],
)  # fmt: skip
def test_how_things_go_together_is_uncertain_where_one_of_them_is_not_shown(text, lost, ties):
    nouns = list_nouns()
    scene = understand(text, nouns)
    index = [one.noun for one in scene.objects].index(lost)
    all_claims = ((), (Claim(lost, "fall", "", index),))
    told = [stage(replace(scene, claims=claims), scene.words, nouns, seed=0, size=SIZE,
                  duration_s=2.0)[1] for claims in all_claims]  # fmt: skip
    assert not told[0].uncertain
    assert {*told[1].uncertain} == ties


@pytest.mark.parametrize(
    "word", sorted(word_set("things", "stand_ins") - word_set("ambiguous", "words"))
)
def test_a_place_that_is_drawn_as_another_one_is_told(word):
    for text in (f"a man walks in a {word}", f"a man walks in {word}"):
        reading = read(text, NOUNS)
        if reading.scene.place.name:
            assert word not in reading.shown
            return
    pytest.fail(f"no place is read of {word}")


@pytest.mark.parametrize("word", ["subway platform", "metro platform", "underground station"])
def test_a_platform_below_the_ground_is_drawn_above_and_told(word):
    said = read(f"a train stops at a {word}", NOUNS).substituted
    assert word in [one.said for one in said]


@pytest.mark.parametrize(
    ("text", "count"),
    [("a candle burns on a table, its flame flickers", 0), ("a cake with flames", 0),
     ("the flame of a candle, a cat sleeps", 0), ("a fire burns beside a candle", 1),
     ("flames rise from a barrel", 1)],
)  # fmt: skip
def test_the_flame_of_what_burns_is_no_fire_beside_it(text, count):
    assert len(read(text, NOUNS).scene.effects) == count


@pytest.mark.parametrize(
    ("text", "kept"),
    [("a soccer player runs past two defenders, the camera follows the player", 2),
     ("a dog passes two dogs, the dog jumps", 2), ("a car overtakes three cars, the car turns", 2)],
)  # fmt: skip
def test_the_one_beside_several_of_its_kind_is_that_which_was_named(text, kept):
    scene = read(text, NOUNS).scene
    assert [one.count > 1 for one in scene.objects] == [False, True]
    assert len(scene.objects) == kept


@pytest.mark.parametrize("who", ["soccer player", "football player", "striker"])
def test_who_plays_football_dribbles_with_no_basketball(who):
    reading = read(f"a {who} dribbles", NOUNS)
    assert "football" in [one.noun for one in reading.scene.objects]
    assert "dribbles" not in reading.shown


@pytest.mark.parametrize("act", ["typing on a keyboard", "kneading dough", "washing dishes"])
def test_of_hands_at_work_no_more_than_these_is_seen(act):
    scene, said, _ = staged(f"hands {act}")
    assert understand(f"hands {act}", list_nouns()).camera.framing == "close"
    assert said.is_faithful
    assert understand(f"a woman {act}", list_nouns()).camera.framing is None
    assert scene.actors[0].noun.name == "person"


def test_an_act_that_takes_longer_than_the_clip_is_told():
    counted = {name: one.repeats_hz for name, one in ACTIVITIES.items() if one.repeats_hz}
    assert len(counted) > 10
    for (name, repeats_hz), pace in itertools.product(counted.items(), (0.1, 0.3, 0.6, 1.0)):
        man = SceneObject("man", motions=(Motion(name, pace=pace),))
        told = [*find_unfinished(SceneDescription(objects=(man,)), 2.0)]
        assert bool(told) == (pace < 1.0 and 2.0 * pace * repeats_hz < 0.7), name


@pytest.mark.parametrize("noun", ["window", "door"])
@pytest.mark.parametrize(
    ("place", "where"), [("kitchen", "room"), ("office", "room"), ("park", "open")]
)
def test_a_window_that_stands_in_no_house_is_noted(noun, place, where):
    notes = staged(f"a cat sits by a {noun} in a {place}")[1].notes
    assert f"the {noun} stands in the {where}, in a piece of wall of its own" in notes


@pytest.mark.parametrize(
    ("text", "is_told"),
    [
        ("a crab on a sandy beach, seen from above", True),
        ("a golden retriever runs along a beach in thick fog", True),
        ("a shell on a tropical beach, top view", True),
        ("a man walks on a beach", False),
        ("a boat sails on a foggy lake", False),
        ("a camel walks in a desert", False),
    ],
)
def test_a_beach_of_which_no_water_is_made_out_is_noted(text, is_told):
    assert any("cannot be made out" in one for one in staged(text)[1].notes) == is_told


@pytest.mark.parametrize("part", ["mane", "tail", "ears"])
def test_fine_parts_are_claimed_of_what_has_them(part):
    claims = read(f"a horse gallops, its {part} moving", NOUNS).claims
    assert {one.kind for one in claims if one.word == part} == {"part", "seen"}


@pytest.mark.parametrize(("share", "is_so"), [(0.5, True), (0.15, True), (0.08, False)])
def test_fine_parts_are_told_of_what_is_near(share, is_so):
    scene, said = staged("a horse stands")[0], understand("a horse stands", list_nouns())
    clip = StagedClip(scene, said, SIZE, 2.0)
    (own,) = clip.boxes[0]
    far_m = float(own.size.max()) / share
    clip.boxes[0][0] = own._replace(seen=own.seen * [1.0, 1.0, 0.0] + [0.0, 0.0, far_m])
    assert CHECKS["part"](clip, Claim("mane", "part", "", 0)) == is_so


@pytest.mark.parametrize(
    ("text", "noun", "is_thing"),
    [("a cat jumps onto a table and watches", "watch", False),
     ("two men stand behind a car and watch", "watch", False),
     ("a monkey climbs a tree and swings", "swing", False),
     ("a man sells hats and watches", "watch", True),
     ("a man holds a cup and a watch", "watch", True)],
)  # fmt: skip
def test_a_second_act_after_and_is_no_thing(text, noun, is_thing):
    nouns = [one.noun for one in read(text, NOUNS).scene.objects]
    assert (noun in nouns) == is_thing


@pytest.mark.parametrize(
    ("text", "is_so"),
    [("an ambulance with flashing blue lights", True), ("a police car with blue lights", True),
     ("dashcam view, an ambulance with flashing blue lights drives ahead at night", False)],
)  # fmt: skip
def test_the_colour_of_a_lamp_is_shown_where_the_image_has_that_lamp(text, is_so):
    assert ("blue" in staged(text)[1].shown) == is_so
