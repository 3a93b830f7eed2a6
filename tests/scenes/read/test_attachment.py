"""What words of a sentence hang on: each rule in three sentences that have nothing in common."""

import itertools

import pytest
from tests.scenes.every_row import for_every
from tests.scenes.read.expected import say

from texvent_scenes.models.nouns import NOUNS
from texvent_scenes.read import read
from texvent_scenes.read.parsing.lexicon import lexicon_of

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
        ("a boy walks, a cat jumping alongside", "child, walk; cat, jump, beside child"),
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
        ("a man walks along a corridor", "man, walk; place name corridor"),
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
    "what is done with a thing that is held": [
        ("a mechanic tightens a bolt with a wrench",
         "mechanic, hold wrench; bolt; wrench; lost tightens"),
        ("a boy films a dog with a phone", "child, hold cell phone; dog; cell phone; lost films"),
        ("a man cuts a rope with a knife", "man, hold knife; rope; knife; lost cuts"),
    ],
    "what stays moves in the wind in its place": [
        ("a flag moves in the wind", "flag"),
        ("a scarf is moving in the wind", "scarf, sway"),
        ("tall grass moves in the breeze", "grass tuft; as tall grass: grass tuft"),
    ],
    "a hall or a floor is that of the place before it": [
        ("a statue in a museum hall", "statue; place name museum"),
        ("a cat sleeps on a kitchen floor", "cat, sleep; place name kitchen"),
        ("a dog runs across an office floor", "dog, run across; place name office"),
    ],
    "what is above a thing is not on what bears that": [
        ("a bird flies over a man on a bench", "bird, fly, above man; man, on bench; bench"),
        ("a drone hovers above a box on a table", "drone, hover, above box; box, on table; table"),
        ("bees fly above a dog on a rug", "3 bee, fly, above dog; dog, on rug; rug"),
    ],
    "what is put down is put there": [
        ("a man lowers a box to the floor", "man, set down box; box; place name indoor"),
        ("a worker puts a crate onto a road", "worker, set down crate; crate; place name road"),
        ("a robot arm lowers a cup to the floor",
         "robot arm, set down cup; cup; place name indoor"),
    ],
    "effects after a comma begin a clause": [
        ("a man works, sparks flying from a grinder",
         "man, work; angle grinder; effect sparks angle grinder"),
        ("a cook stands, smoke rising from a pan",
         "chef, stand; frying pan; effect smoke frying pan"),
        ("a car turns, dust rising behind it", "car, turn; effect dust; lost behind"),
    ],
    "a shot goes through what has a way through": [
        ("forward motion through a tunnel", "tunnel; camera travel forward"),
        ("dashcam view through a tunnel", "tunnel; camera travel forward drive"),
        ("forward walk through a gate", "gate, stand open; camera travel forward walk"),
    ],
    "a noun of a way before a preposition is the camera's": [
        ("night drive through a tunnel",
         "tunnel; camera travel forward drive; light kind night"),
        ("a walk through a forest", "camera travel forward walk; place name forest"),
        ("a flight over a city", "camera travel forward fly; view aerial; place name city"),
        ("a man takes a walk through a park", "man, walk; place name park"),
    ],
    "what rocks turns back by itself": [
        ("a checkerboard is tilted back and forth", "checkerboard, tilt"),
        ("a tree sways to and fro", "tree, sway"),
        ("a sign tilts up and down", "sign, tilt"),
    ],
    "her before a phrase is a pronoun": [
        ("a woman stands, cars pass behind her with headlights",
         "woman, stand; 3 car, is_lit True, move, behind woman"),
        ("a girl sits as a dog runs behind her at night",
         "girl, sit; dog, run, behind girl; light kind night"),
        ("a woman reads, a cat beside her in the rain",
         "woman, read; cat, beside woman; place weather rain"),
    ],
    "an act after another one that is named is its doer's": [
        ("a dancer on a carpet performs a pirouette followed by a bow and waves",
         "person, pirouette, bow, wave, on rug; rug; as dancer: person"),
        ("a boy on a bench jumps, followed by a wave, and claps",
         "child, jump, wave, clap, on bench; bench"),
        ("a gymnast on a mat performs a cartwheel followed by a backflip and jumps",
         "gymnast, cartwheel, backflip, jump, on rug; rug"),
    ],
    "what an act with a particle is done to is its object": [
        ("a car drives on a dirt road, throwing up dust",
         "car, drive; effect dust car; place name dirt road; lost throwing up"),
        ("a woman skis down a hill, throwing up powder snow",
         "woman, ski, on hill; hill; place has_snow True; lost throwing up powder"),
        ("a man kicks up sand", "man, stand; lost kicks up sand"),
        ("a boy throws up a ball", "child, throw ball; ball; lost up"),
    ],
    "what a camera sees besides is said of nobody": [
        ("A train passes. The camera follows it, with people under umbrellas in the background.",
         "train, move; 3 person, hold umbrella; 3 umbrella, placement far; camera follow"),
        ("A bus drives. The camera pans, with a dog on a bench.",
         "bus, drive; dog, on bench; bench; camera pan"),
        ("A cat sleeps. The camera zooms in, with a boat in the background.",
         "cat, sleep; boat, placement far; camera zoom in"),
    ],
    "who is under what is borne above them holds it": [
        ("a woman under an umbrella walks", "woman, walk, hold umbrella; umbrella"),
        ("pedestrians under umbrellas stand", "3 person, stand, hold umbrella; 3 umbrella"),
        ("a table under an umbrella", "table, under umbrella; umbrella"),
    ],
    "a cloud is of the sky unless it is of something": [
        ("clouds of dust rise from a truck", "truck; effect dust truck"),
        ("clouds of wugs float over a lake", "place name lake; lost clouds of wugs float over"),
        ("a cloud of butterflies flies over a meadow",
         "3 butterfly, fly; place name grass; lost cloud"),
    ],
    "a view from the front of a vehicle is that of who is in it": [
        ("view from the front of a car driving along a road",
         "camera travel forward drive; place name road"),
        ("a forest road seen from the cab of a truck driving through it",
         "camera travel forward drive; place name road; place backdrops ['forest']"),
        ("view out of the front window of a bus driving through a city",
         "camera travel forward drive; place name city"),
        ("view from the front of a train moving along a river",
         "camera travel forward; place name river"),
        ("a car seen from the front drives on a road", "car, drive; view front; place name road"),
    ],
    "light from above is no view": [
        ("spotlights shine from above on a stage",
         "3 spotlight, stand; place name stage; lost shine from above"),
        ("lamps glow from above in a warehouse",
         "3 lamp, switch_s 1.0, is_lit True; place name warehouse; lost from above"),
        ("a dog lies on a road, seen from above",
         "dog, placement lane, lie; view aerial; place name road"),
    ],
    "a shot is of what it names": [
        ("a shot of a vase breaking", "vase, break"),
        ("a clip of two dogs running", "2 dog, run"),
        ("a sequence of a robot arm lifting a box", "robot arm, lift box; box"),
    ],
}  # fmt: skip


@for_every([one for each in RULES.values() for one in each], is_quick=True)
def test_words_hang_on_what_they_are_said_of(row):
    text, expected = row
    assert say(read(text, NOUNS)) == expected


@pytest.mark.parametrize("text", ["a fish swims around", "gulls fly above", "a dog runs around"])
def test_particles_that_name_nothing_are_left_to_the_staged_scene(text):
    assert text.split()[-1] in read(text, NOUNS).open_words


def shots():
    """Phrases of shots that name no thing."""
    for words, senses in lexicon_of(NOUNS).items():
        kinds = {one.kind for one in senses}
        if "shot" in kinds and "noun" not in kinds:
            yield " ".join(words)


@for_every([*shots()][::701])
def test_a_shot_is_read_with_an_article_as_without(phrase):
    for article, scene in itertools.product(("a", "the"), ("a red car", "two dogs on a beach")):
        led = "" if phrase.endswith(" of") else "of "
        bare, full = (read(f"{one}{phrase} {led}{scene}", NOUNS) for one in ("", f"{article} "))
        assert say(full) == say(bare)
