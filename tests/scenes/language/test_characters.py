"""Animals that do what only people do stand upright; what they do themselves, on four legs."""

from __future__ import annotations

import pytest

from texvent.scenes.language.parser import parse_prompt


@pytest.mark.parametrize(
    ("prompt", "noun", "kind"),
    [
        ("a panda strums a guitar on a bench", "upright panda", "play guitar"),
        ("a fox is reading a newspaper", "upright fox", "read"),
        ("a raccoon drinks tea", "upright raccoon", "drink"),
        ("a teddy bear walks along a street", "upright teddy bear", "walk"),
        ("a rabbit washes a window", "upright rabbit", "wash"),
        ("two foxes discuss a map", "upright fox", "talk"),
        ("a hamster eats a slice of pizza", "upright hamster", "eat"),
        ("a monkey surfs", "upright monkey", "surf"),
        ("a dog holds an umbrella and walks", "upright dog", "walk"),
    ],
)
def test_an_animal_that_does_what_only_people_do_stands_upright(
    prompt: str, noun: str, kind: str
) -> None:
    description = parse_prompt(prompt)
    first = description.objects[0]
    assert first.noun == noun
    assert first.motion is not None
    assert first.motion.kind == kind
    assert any("stands upright" in note for note in description.notes)


@pytest.mark.parametrize(
    "prompt",
    [
        "a dog runs in a park",
        "a cat eats from a bowl",
        "a cat washes itself",
        "a dog with a stick in its mouth",
        "a dog carries a newspaper in its mouth",
        "a bear climbs a tree",
        "a horse drinks water",
        "a cat sits on a chair",
        "a dog digs in the garden",
        "a cat wearing a hat",
        "a teddy bear sits on a bed",
        "a lion yawns",
    ],
)
def test_what_an_animal_does_itself_it_does_on_four_legs(prompt: str) -> None:
    assert not parse_prompt(prompt).objects[0].noun.startswith("upright")


@pytest.mark.parametrize(
    "prompt",
    ["a fox in a suit walks", "a bear wearing blue jeans", "a mouse dressed in a robe waves"],
)
def test_an_animal_in_peoples_clothes_stands_upright(prompt: str) -> None:
    description = parse_prompt(prompt)
    assert description.objects[0].noun.startswith("upright")
    assert any(one.kind == "wear" for one in description.relations)


def test_it_means_the_upright_animal_in_the_next_sentence() -> None:
    description = parse_prompt("A panda plays the piano. It wears a red hat.")
    assert [one.noun for one in description.objects][:1] == ["upright panda"]
    assert any(one.kind == "wear" and one.subject == 0 for one in description.relations)


def test_who_wears_several_things_does_what_follows() -> None:
    description = parse_prompt("a hippo wearing green trousers and boots taking a stroll")
    first = description.objects[0]
    assert first.motion is not None
    assert (first.noun, first.motion.kind) == ("upright hippo", "walk")
    assert len([n for one in description.relations for n in one.targets]) == 2


def test_who_stands_on_a_board_wears_the_vest() -> None:
    description = parse_prompt("a beaver stands on a surfboard wearing a red life jacket")
    wearers = [one.subject for one in description.relations if one.kind == "wear"]
    assert [description.objects[one].noun for one in wearers] == ["beaver"]


def test_who_plays_on_a_swing_sits_on_it() -> None:
    first = parse_prompt("a raccoon playing on a swing").objects[0]
    assert first.motion is not None
    assert (first.noun, first.motion.kind) == ("upright raccoon", "sit")
