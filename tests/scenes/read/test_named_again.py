"""Things that are named again by words for several, by their colour, or some of several."""

import itertools
from collections import Counter

import pytest
from tests.scenes.every_row import for_every

from texvent_scenes.description import to_description
from texvent_scenes.models.nouns import NOUNS
from texvent_scenes.read import read
from texvent_scenes.scene_input import understand


@pytest.mark.parametrize(
    ("prompt", "going"),
    [
        ("A truck and a car stand at a traffic light. The vehicles pull away.", {"truck", "car"}),
        ("A truck and a bus stand on a road. Both vehicles pull away.", {"truck", "bus"}),
        ("A dog and a cat sit on a lawn. Both animals run away.", {"dog", "cat"}),
        ("A dog, a cat and a man sit on a lawn. The animals run away.", {"dog", "cat"}),
        ("A horse, a dog and a man stand on a lawn. The man runs away.", {"man"}),
        ("A bus and a taxi wait at a bus stop, then the two drive off.", {"bus", "taxi"}),
        ("A bus and a taxi wait at a bus stop, then both drive off.", {"bus", "taxi"}),
        ("A dog sits on a lawn. The animals run away.", set()),
    ],
)
def test_a_word_for_several_nouns_means_all_that_it_names(prompt, going):
    objects = understand(prompt, NOUNS).objects
    assert {one.noun for one in objects if one.motions[-1].direction == "away"} == going
    assert all(one.count == 1 for one in objects)


@pytest.mark.parametrize(
    ("prompt", "ways"),
    [
        ("A red ball lies on the floor. The red ball rolls away.", {"red": "away"}),
        (
            "A red ball and a blue ball lie on the floor. The blue one rolls away.",
            {"red": None, "blue": "away"},
        ),
        (
            "A black dog and a white dog sit on a lawn. The white one stays, the other runs away.",
            {"white": None, "black": "away"},
        ),
    ],
)
def test_a_colour_names_one_of_several_again(prompt, ways):
    objects = understand(prompt, NOUNS).objects
    assert {one.colour: one.motions[-1].direction for one in objects} == ways
    assert len(objects) == len(ways)


def test_one_of_several_copies_is_parted_by_its_colour():
    objects = understand("Two cars stand on a road. The red one drives off.", NOUNS).objects
    assert [(one.count, one.colour) for one in objects] == [(1, None), (1, "red")]


@pytest.mark.parametrize("phrase", ["a tram", "a green tram", "a green and white tram"])
def test_a_verb_after_a_single_noun_is_no_plural(phrase):
    objects = understand(f"{phrase} stops at a church".capitalize(), NOUNS).objects
    assert [one.noun for one in objects] == ["tram", "church"]


@pytest.mark.parametrize(
    ("prompt", "nouns"),
    [
        ("A cake with five candles stands on a table.", {"cake", "table"}),
        ("A cake and three candles stand on a table.", {"cake", "candle", "table"}),
        ("Three candles stand on a cake.", {"cake"}),
        ("Three candles stand on a plate.", {"candle", "plate"}),
    ],
)
def test_candles_of_a_cake_are_its_own(prompt, nouns):
    assert {one.noun for one in understand(prompt, NOUNS).objects} == nouns


@pytest.mark.parametrize(
    ("prompt", "bodies"),
    [
        (
            "Two children build a sandcastle. The older girl waves while the toddler jumps.",
            {"girl": 1, "toddler": 1, "sandcastle": 1},
        ),
        ("A herd of horses gallops. The camera follows the lead brown horse.", {"horse": 7}),
        ("Three vehicles wait on a road. The truck drives off.", {"car": 2, "truck": 1}),
        ("Four people play volleyball. One player jumps past a defender.", {"person": 4}),
        ("Two boys play on a lawn. One runs past the other.", {"child": 2}),
        ("Two red cars stand on a road. The blue car drives off.", {"car": 3}),
        ("Two boys play on a lawn. The girl watches.", {"child": 2, "girl": 1}),
        ("Two cars stand on a road. The car ahead drives off.", {"car": 3}),
        ("Two people sit on a lawn. A woman runs.", {"person": 2, "woman": 1}),
    ],
)
def test_a_member_of_several_who_are_named_is_no_new_body(prompt, bodies):
    found = Counter[str]()
    for one in understand(prompt, NOUNS).objects:
        found[one.noun] += one.count
    assert found == bodies


@pytest.mark.parametrize(
    ("prompt", "acts"),
    [
        ("Two men play basketball. The ball rolls away.", ["dribble", "run"]),
        ("Five girls play basketball. The tall girl dribbles the ball.", ["dribble", "run"]),
        ("A boy and a girl play basketball, then the ball drops.", ["dribble", "run"]),
        ("A boy bounces a ball. The camera follows the ball.", ["bounce"]),
        ("Two boys dribble basketballs.", ["dribble"]),
    ],
)
def test_who_play_together_have_one_ball_which_is_named_again(prompt, acts):
    objects = understand(prompt, NOUNS).objects
    assert sorted(each.kind for one in objects for each in one.motions) == acts
    assert {one.noun for one in objects}.isdisjoint({"ball", "basketball"})
    holders = [one.count for one in objects if one.motions[0].kind != "run"]
    assert holders == [2 if "basketballs" in prompt else 1]


@pytest.mark.parametrize(
    "prompt",
    [
        "A herd of horses gallops across a plain. The camera follows the brown horse.",
        "Birds fly over a lake. The white bird sings.",
        "Two people walk in a park. The man waves.",
    ],
)
def test_a_member_goes_the_way_of_the_others(prompt):
    objects = understand(prompt, NOUNS).objects
    assert [one.motions[0].direction for one in objects] == ["right", "right"]


SAID = (
    "a dog chases {} cats", "{} cats chase a dog", "a man walks past {} dogs",
    "{} dogs run towards a man", "a ball lies behind {} horses", "a bird flies over {} cows",
    "{} cats sit on a sofa", "a girl stands between {} robots", "a van overtakes {} buses",
    "{} robots stand next to {} men", "a woman follows {} goats", "{} balls roll past {} boxes",
)  # fmt: skip
AFTERWARDS = (
    ", one of which jumps", ", one of them jumps", ". One of them jumps.", ", one jumps",
    ". One jumps and the other sits.", ", one of which is red", "; one of them is white",
    " and one of them falls", ", two of them spin", ", the others wait",
)  # fmt: skip


def count(text):
    """Bodies by their nouns; and by relations and nouns those that have them, and to how many."""
    said = to_description(read(text, NOUNS).scene)
    bodies, related = Counter(), Counter()
    for one in said.objects:
        bodies[one.noun] += one.count
    for one in said.relations:
        who, to = said.objects[one.subject], [said.objects[n] for n in one.targets]
        related[one.kind, who.noun, to[0].noun, sum(each.count for each in to)] += who.count
    return bodies, related


@for_every(itertools.product(SAID, ("two", "three", "5"), AFTERWARDS), is_quick=True)
def test_what_some_do_takes_none_from_what_all_do(row):
    said, number, afterwards = row
    usual = said.format(number, number)
    assert count(usual + afterwards) == count(usual)
