"""What words of a sentence hang on: each rule in three sentences that have nothing in common."""

import pytest
from tests.scenes.read.expected import say

from texvent_scenes.models.nouns import NOUNS
from texvent_scenes.read import read

RULES = {
    "a phrase ends before a preposition of several words": [
        ("a windmill turns on top of a hill", "windmill, turn, on hill; hill"),
        ("a coin spins on top of a box", "coin, spin, on box; box"),
        ("a robot comes in front of a wall", "robot, move, front wall; wall"),
    ],
    "a relative after a comma is about the last thing": [
        ("a hand drops a coin, which spins", "person, drop coin; coin, spin; as hand: person"),
        ("a man passes a dog, which barks", "man, move, past dog; dog, bark"),
        ("a girl pushes a car, that turns", "girl, move, push car; car, turn"),
    ],
    "who is led along does what follows": [
        ("a man walks with a dog running alongside", "man, walk, with dog; dog, run, beside man"),
        ("a boy hikes with a cat jumping beside him",
         "child, walk 0.9, with cat; cat, jump, beside child"),
        ("a nurse walks with a child running behind her",
         "nurse, walk, with child; child, run, follow nurse"),
    ],
    "a clip is slow wherever it is said": [
        ("slow motion of a dog running", "dog, run 0.3"),
        ("in slow motion, a vase breaks", "vase, break 0.3"),
        ("A ball falls. The footage is in slow motion.", "ball, fall 0.3"),
    ],
    "rooms from outside are buildings": [
        ("a tram rolls past a cafe", "tram, roll, past shop; shop; as cafe: shop"),
        ("a dog sits next to a pub", "dog, sit, beside shop; shop; as pub: shop"),
        ("a bus in front of a school", "bus, front building; building; as school: building"),
    ],
    "a place is behind who is in it": [
        ("a flower with a garden behind it", "flower; place name backyard"),
        ("a dog sits with a park behind it", "dog, sit; place name park"),
        ("a man cooks with a kitchen behind him", "man, cook; place name kitchen"),
    ],
    "a place from which something is seen is that of the scene": [
        ("a boat seen from a beach", "boat; place name beach"),
        ("a train filmed from a field", "train; place name grass"),
        ("a horse seen from a road", "horse; place name road"),
    ],
    "a shot is of what it names": [
        ("a shot of a vase breaking", "vase, break"),
        ("a clip of two dogs running", "2 dog, run"),
        ("a sequence of a robot arm lifting a box", "robot arm, lift box; box"),
    ],
}  # fmt: skip


@pytest.mark.parametrize(("text", "expected"), [one for each in RULES.values() for one in each])
def test_words_hang_on_what_they_are_said_of(text, expected):
    assert say(read(text, NOUNS)) == expected


@pytest.mark.parametrize("text", ["a fish swims around", "gulls fly above", "a dog runs around"])
def test_particles_that_name_nothing_are_left_to_the_staged_scene(text):
    assert text.split()[-1] in read(text, NOUNS).open_words
