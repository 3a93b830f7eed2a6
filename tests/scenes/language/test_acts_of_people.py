"""What people do, as short captions say it: acts with their things, tricks, noun and gerund."""

from __future__ import annotations

import pytest

from texvent.scenes.language.parser import parse_prompt


@pytest.mark.parametrize(
    ("prompt", "kind"),
    [
        ("A girl is rinsing her hands.", "wash hands"),
        ("A woman gets a haircut.", "get haircut"),
        ("A man is sharpening a knife.", "sharpen knife"),
        ("A boy is counting his coins.", "count money"),
        ("A woman eats spaghetti.", "eat noodles"),
        ("A man receives a trophy.", "lift trophy"),
        ("A skater is roller skating.", "roller skate"),
        ("A woman is ice skating.", "ice skate"),
        ("A girl talks on her cell phone.", "phone"),
        ("A man stares at his phone.", "text"),
        ("A girl swings a green tennis racket on a court.", "swing racket"),
        ("A person is pull up.", "pull-up"),
        ("A man is clay pot making.", "make pottery"),
        ("A person is giving or receiving prize.", "lift trophy"),
        ("A woman is bandaging.", "bandage arm"),
        ("A girl tastes wine.", "drink"),
        ("A teenager does a stunt on a skateboard.", "skateboard trick"),
        ("A woman jumps in the air on a snowboard.", "snowboard trick"),
        ("A skier flies through the air.", "ski trick"),
        ("A woman leans against a fence.", "lean"),
        ("A girl blows out the candles on a birthday cake.", "blow out cake"),
        ("Two girls play Wii.", "play wii"),
        ("A man is making his bed.", "make bed"),
        ("A woman cooks sausages on a grill.", "barbecue"),
        ("A boy washes the dishes in a sink.", "wash dishes"),
    ],
)
def test_an_act_is_read_with_what_it_is_done_to(prompt: str, kind: str) -> None:
    description = parse_prompt(prompt)
    motions = [one.motion.kind for one in description.objects if one.motion is not None]
    assert kind in motions
    assert not description.not_understood


@pytest.mark.parametrize(
    ("prompt", "kind"),
    [("Children build a snowman.", "mould"),
     ("A cook is preparing a pizza.", "dab"), ("A girl reaches for a bottle.", "reach")],
)  # fmt: skip
def test_hands_are_at_what_is_made_or_reached_for(prompt: str, kind: str) -> None:
    description = parse_prompt(prompt)
    assert description.objects[0].motion is not None
    assert description.objects[0].motion.kind == kind
    assert [one.kind for one in description.relations] == ["work on"]


def test_what_is_brought_by_an_act_is_no_thing_of_its_own() -> None:
    for prompt in ("A man is tying his tie.", "A woman trims her nails.", "A boy deals the cards."):
        assert len(parse_prompt(prompt).objects) == 1, prompt


def test_what_one_alone_does_not_do_is_done_with_another_one() -> None:
    alone = parse_prompt("A woman is hugging.")
    assert [one.noun for one in alone.objects] == ["woman", "person"]
    assert len(parse_prompt("A woman is hugging a tree.").objects) == 2
    assert len(parse_prompt("A person is waving.").objects) == 1


def test_who_only_holds_or_wears_something_stands() -> None:
    for prompt in ("A man holding a cup.", "A woman wearing a hat.", "A man holding a baby."):
        kinds = {one.motion.kind for one in parse_prompt(prompt).objects if one.motion is not None}
        assert kinds == {"stand"}, prompt


def test_a_dog_is_walked_on_a_leash() -> None:
    relation = parse_prompt("A boy walks his dog on a leash.").relations[0]
    assert (relation.kind, relation.way) == ("with", "lead")
    assert not parse_prompt("A boy walks his dog on a leash.").not_understood


def test_riders_sit_on_the_back_of_what_they_ride() -> None:
    description = parse_prompt("Two women ride on the back of a camel.")
    assert description.relations[0].kind == "ride"
    assert not description.not_understood


def test_a_phone_is_looked_at_while_sitting() -> None:
    description = parse_prompt("A woman looks at her phone while sitting on a bench.")
    assert description.objects[0].motion is not None
    assert description.objects[0].motion.kind == "text"
    assert ("on", (1,)) in [(one.kind, one.targets) for one in description.relations]
