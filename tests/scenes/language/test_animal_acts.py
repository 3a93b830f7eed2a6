"""Acts of animals that a sentence says in several words are read as the one that is shown."""

from __future__ import annotations

import pytest

from texvent.scenes.language.parser import parse_prompt


@pytest.mark.parametrize(
    ("prompt", "kind"),
    [
        ("a deer bends down to drink from a lake", "drink"),
        ("a pony bending down to drink water from a pond", "drink"),
        ("a goat lowers its head to graze", "graze"),
        ("a donkey takes a quiet walk", "walk"),
        ("a fox enjoying a nap", "lie"),
        ("a puppy laying on a rug", "lie"),
        ("a lion rests under a tree", "lie"),
        ("a kitten licks its paw", "groom"),
        ("a lion grooming itself with its tongue", "groom"),
        ("an elephant showers itself with water using its trunk", "spray"),
        ("a goat chews cud", "chew"),
        ("a cow chewing cud while lying in a field", "lie and chew"),
        ("a wolf yawns", "yawn"),
        ("a puppy sticks out its tongue", "pant"),
        ("a dog looks up at the sky", "look up"),
        ("a deer raises its head towards the sky", "look up"),
        ("a bear stands on its hind legs", "rear"),
        ("two goats fight", "fight"),
        ("a giraffe munches leaves from a tree", "eat high"),
        ("a robin builds a nest", "peck"),
    ],
)
def test_an_act_in_several_words_is_the_one_that_is_shown(prompt: str, kind: str) -> None:
    description = parse_prompt(prompt)
    motion = description.objects[0].motion
    assert motion is not None
    assert motion.kind == kind
    assert not {"down", "using", "trunk", "tongue", "water", "cud"} & {*description.not_understood}


def test_who_runs_to_join_a_herd_runs_towards_some_of_its_kind() -> None:
    description = parse_prompt("a bison runs to join a herd of its kind")
    one, herd = description.objects[:2]
    assert (one.noun, herd.noun, one.count) == ("bison", "bison", 1)
    assert herd.count > 2
    assert [(each.kind, each.targets) for each in description.relations] == [("towards", (1,))]


@pytest.mark.parametrize(
    ("prompt", "noun"),
    [("a beagle drinks water", "water bowl"), ("a zebra drinks water", "puddle")],
)
def test_water_that_an_animal_drinks_is_in_a_bowl_or_a_puddle(prompt: str, noun: str) -> None:
    description = parse_prompt(prompt)
    assert [one.noun for one in description.objects[1:]] == [noun]
    assert [one.kind for one in description.relations] == ["work on"]


def test_an_animal_at_work_as_someone_has_no_second_figure_beside_it() -> None:
    description = parse_prompt("a dog works as a waiter in a garden")
    assert [one.noun for one in description.objects] == ["dog"]
    assert "waiter" in description.not_understood


def test_what_is_worn_is_reported_as_what_it_is_called() -> None:
    description = parse_prompt("a woman in a pink tutu dances")
    assert not description.substituted
    assert {one.said for one in parse_prompt("a tutu lies on a chair").substituted} == {"tutu"}


def test_an_animal_that_wears_something_stands_to_be_seen() -> None:
    description = parse_prompt("a cat wearing a red hat")
    assert description.objects[0].motion is not None
    assert description.objects[0].motion.kind == "stand"


def test_the_mother_of_a_young_animal_is_a_grown_one_of_its_kind() -> None:
    description = parse_prompt("a lamb stands near its mother")
    assert [one.noun for one in description.objects] == ["lamb", "sheep"]
    assert [one.noun for one in parse_prompt("a girl stands near her mother").objects] == [
        "girl",
        "woman",
    ]


def test_a_toy_bear_that_sits_is_shown_as_it_says() -> None:
    assert not parse_prompt("a teddy bear sits on a shelf").substituted
