"""What a sentence means: whose verb it is, in which order, what is reported."""

from __future__ import annotations

from pathlib import Path

import cv2
import numpy as np
import pytest

from texvent.errors import InputError
from texvent.scenes.description import Picture, SceneDescription
from texvent.scenes.language.grammar.clauses import read_clauses
from texvent.scenes.language.grammar.syntax import Clause
from texvent.scenes.language.parser import parse_prompt
from texvent.scenes.language.vocabulary.motion import WORK_RATES_HZ
from texvent.scenes.language.words.english import correct_spelling, list_verb_forms
from texvent.scenes.language.words.lexicon import Lexicon
from texvent.scenes.language.words.tagging import tag_words
from texvent.scenes.language.words.tokens import tokenize_prompt
from texvent.scenes.models.nouns import NOUNS
from texvent.scenes.models.protocol import Pose

KNOWN = Lexicon(NOUNS)


def clauses_of(prompt: str) -> list[Clause]:
    words, _ = tag_words(tokenize_prompt(prompt), KNOWN)
    return read_clauses(words)


def who_does_what(prompt: str) -> list[tuple[str, str, str]]:
    """Subjects, verb and objects of every clause with a verb."""
    return [
        (
            " & ".join(group.text for group in clause.subjects),
            clause.verb.text,
            " & ".join(group.text for group in clause.objects),
        )
        for clause in clauses_of(prompt)
        if clause.verb is not None
    ]


@pytest.mark.parametrize(
    ("prompt", "clauses"),
    [
        (
            "a dog barks while two cats chase a mouse",
            [("dog", "barks", ""), ("two cats", "chase", "mouse")],
        ),
        ("a woman holding a baby waves from the window", [
            ("woman", "holding", "baby"), ("woman", "waves", "")]),
        ("the rabbit that eats a carrot hops away", [
            ("rabbit", "eats", "carrot"), ("rabbit", "hops", "")]),
        ("a cat crouches, wiggles its tail and leaps", [
            ("cat", "crouches", ""), ("cat", "wiggles", "tail"), ("cat", "leaps", "")]),
        ("a boat sails past, water spraying from its bow", [
            ("boat", "sails", ""), ("water", "spraying", "")]),
        ("a boat with dolphins jumping", [("dolphins", "jumping", "")]),
        ("when the light changes, the bus goes left", [
            ("light", "changes", ""), ("bus", "goes", "")]),
        ("behind the house stands a cow", [("cow", "stands", "")]),
        ("a hoop held by a boy", [("hoop", "held", "")]),
        ("a flock of birds crosses the frame", [("a flock of birds", "crosses", "frame")]),
        ("a deer stands in the road", [("deer", "stands", "")]),
        ("a chair, the light flickers", [("light", "flickers", "")]),
        ("a boy is eating soup and talking", [("boy", "eating", "soup"), ("boy", "talking", "")]),
        ("rain, with people crossing", [("people", "crossing", "")]),
        ("clouds drift below", [("clouds", "drift", "")]),
        ("the glow lights up a face", [("glow", "lights", "face")]),
        ("a cat tosses a ball, closes it in a box", [
            ("cat", "tosses", "ball"), ("cat", "closes", "it")]),
        ("it loops once and drifts", [("it", "loops", ""), ("it", "drifts", "")]),
        ("a runner stops to tie his shoe", [("runner", "stops", ""), ("runner", "tie", "shoe")]),
    ],
)  # fmt: skip
def test_a_verb_belongs_to_the_subject_of_its_own_clause(
    prompt: str, clauses: list[tuple[str, str, str]]
) -> None:
    assert who_does_what(prompt) == clauses


def motions(description: SceneDescription) -> dict[str, list[tuple[str, str | None]]]:
    return {
        one.noun: [(motion.kind, motion.direction) for motion in (one.motion, *one.then) if motion]
        for one in description.objects
    }


@pytest.mark.parametrize(
    ("prompt", "expected"),
    [
        ("a car turns left, then stops", {"car": [("turn", "left"), ("stand", None)]}),
        ("a dog runs. It stops and jumps", {
            "dog": [("run", None), ("stand", None), ("jump", None)]}),
        ("a car drives left while a dog sits", {
            "car": [("drive", "left")], "dog": [("sit", None)]}),
        ("a man on a horse gallops to the right", {
            "man": [("stand", None)], "horse": [("run", "right")]}),
        ("a truck backs up", {"truck": [("reverse", None)]}),
        ("a man turns around", {"man": [("turn", "around")]}),
        ("a person does jumping jacks", {"person": [("jumping jack", None)]}),
        ("right arm clockwise", {"person": [("right arm clockwise", None)]}),
        ("hand waving", {"hand": [("wave", None)]}),
    ],
)  # fmt: skip
def test_motions_follow_each_other(
    prompt: str, expected: dict[str, list[tuple[str, str | None]]]
) -> None:
    found = motions(parse_prompt(prompt))
    assert found == expected


def test_speeds_change_and_begin_when_they_are_said_to() -> None:
    faster = parse_prompt("a car accelerates").objects[0].motion
    assert faster is not None
    assert faster.end_pace is not None
    assert faster.end_pace > faster.pace
    late = parse_prompt("after two seconds the dog jumps").objects[0].motion
    assert late is not None
    assert late.start_s == 2.0


@pytest.mark.parametrize(
    ("prompt", "shown", "reported"),
    [
        ("a wug shark swims", ["shark"], ("wug",)),
        ("a red and blue ball bounces", ["ball"], ("blue",)),
        ("a man saws a wug", ["man"], ("wug",)),
        ("a car drives through a wug", ["car"], ("through", "wug")),
        ("a statue of a horse", ["statue"], ("of", "horse")),
        ("an excavator swings its arm", ["excavator"], ("swings", "arm")),
        ("a hedgehog curls into a ball", ["hedgehog"], ("curls", "ball")),
        ("a boy turns a bottle upside down", ["child", "bottle"], ("turns", "upside", "down")),
        (
            "a man lifts a wug and drops it",
            ["man"],
            ("lifts", "wug", "drops", "it"),
        ),
        ("a baker slides a peel into an oven", ["baker", "oven"], ("slides", "peel", "into")),
    ],
)
def test_what_is_not_shown_is_reported_and_does_nothing_else(
    prompt: str, shown: list[str], reported: tuple[str, ...]
) -> None:
    if not all(noun in NOUNS for noun in shown):
        pytest.fail(f"the nouns of this test are missing: {shown}")
    description = parse_prompt(prompt)
    assert [one.noun for one in description.objects] == shown
    assert description.not_understood == reported


def test_kinds_are_shown_as_what_they_are_kinds_of_and_named() -> None:
    description = parse_prompt("a barista waves in an attic")
    pairs = [(one.said, one.shown) for one in description.substituted]
    assert pairs == [("barista", "person"), ("attic", "storeroom")]
    assert "waves" in description.shown


@pytest.mark.parametrize(
    ("prompt", "pairs"),
    [
        ("a cat runs in a wheel", [("wheel", "wheel of a car")]),
        ("a wheel rolls beside a truck", []),
        ("a wheel", []),
        ("a white circle moves left", []),
        ("a man holds a star", [("star", "star with five points")]),
    ],
)
def test_the_drawn_sense_of_a_noun_is_named_where_nothing_tells_it(
    prompt: str, pairs: list[tuple[str, str]]
) -> None:
    assert [(one.said, one.shown) for one in parse_prompt(prompt).substituted] == pairs


def test_every_word_is_in_one_list() -> None:
    description = parse_prompt("a purple wug and a chef drive left past two trees at dusk")
    said = [one.said for one in description.substituted]
    lists = (*description.shown, *said, *description.not_understood)
    assert sorted(lists) == sorted(set(lists))
    assert set(lists) >= {"purple", "wug", "chef", "drive", "left", "two", "trees", "dusk"}


@pytest.mark.parametrize(
    ("prompt", "moves"),
    [
        ("driving through a city", [("travel", "forward", 0)]),
        ("first-person view riding a bicycle through a forest", [("travel", "forward", 0)]),
        ("the camera pans left, then tilts up at a house", [("pan", "left", 0), ("tilt", "up", 1)]),
        ("the camera turns left in a street", [("pan", "left", 0)]),
        ("the camera cranes up over a house", [("crane", "up", 0)]),
        ("the camera does not move, a dog runs", [("static", None, 0)]),
        ("tracking shot of a running dog", [("follow", None, 0)]),
        ("a car drives, zoom in", [("zoom", "in", 0)]),
    ],
)
def test_cameras(prompt: str, moves: list[tuple[str, str | None, int]]) -> None:
    shot = parse_prompt(prompt).shot
    assert [(move.kind, move.direction, move.phase) for move in shot.moves] == moves


def test_acts_bind_people_to_things() -> None:
    def acts(prompt: str) -> list[tuple[str, str, list[str]]]:
        description = parse_prompt(prompt)
        names = [one.noun for one in description.objects]
        return [(r.kind, names[r.subject], [names[t] for t in r.targets])
                for r in description.relations]  # fmt: skip

    assert acts("a girl carries a box") == [("carry", "girl", ["box"])]
    assert acts("a man in a red hat waves") == [("wear", "man", ["hat"])]
    assert acts("a woman with an umbrella walks") == [("hold", "woman", ["umbrella"])]
    assert acts("a ball held by a boy") == [("hold", "child", ["ball"])]
    assert acts("a car kicks a ball") == []


def test_pictures_by_file_squares_and_text(tmp_path: Path) -> None:
    path = tmp_path / "photo.png"
    cv2.imwrite(str(path), np.zeros((4, 6, 3), np.uint8))
    assert parse_prompt(f"a poster of {path}").objects[0].picture == Picture("file", str(path))
    board = parse_prompt("a 9x6 checkerboard tilts").objects[0]
    assert board.picture == Picture("checkerboard", "9x6")
    sign = parse_prompt('a billboard with the text "SALE 50"').objects[0]
    assert sign.picture == Picture("text", "SALE 50")
    digit = parse_prompt("the digit 7 moves right").objects[0]
    assert (digit.noun, digit.picture) == ("poster", Picture("text", "7"))
    with pytest.raises(InputError, match="does not exist"):
        parse_prompt(f"a poster of {tmp_path / 'none.png'}")


def test_spelling_is_corrected_with_a_note() -> None:
    description = parse_prompt("a bycicle drives left")
    assert description.objects[0].noun == "bicycle"
    assert any("'bycicle' is read as 'bicycle'" in note for note in description.notes)
    assert correct_spelling("lamplighter", ["lamplight", "lamplights"]) is None
    assert correct_spelling("hat", ["cat"]) is None


@pytest.mark.parametrize(
    "prompt",
    ["ein Hund läuft über die Wiese", "ein roter Ball springt", "una mujer corre", "das Auto"],
)
def test_a_prompt_in_another_language_is_refused(prompt: str) -> None:
    with pytest.raises(InputError, match="not to be English"):
        parse_prompt(prompt)


def test_verb_forms_are_english() -> None:
    assert [word for word, _ in list_verb_forms("swim")] == [
        "swim", "swims", "swimming", "swam", "swum",
    ]  # fmt: skip


def test_lamps_blink_and_things_smoke() -> None:
    lamp = parse_prompt("a lamp flickering at 50 Hz on a table").objects[0]
    assert lamp.blink_hz == 50.0
    smoke = parse_prompt("smoke rises from a house").effects[0]
    assert (smoke.kind, smoke.source) == ("smoke", 0)
    cup = parse_prompt("a cup of steaming coffee").effects
    assert [one.kind for one in cup] == ["steam"]


def test_crossings_and_bends_of_roads() -> None:
    assert parse_prompt("a car at a junction").surroundings.road == "crossing"
    assert parse_prompt("a truck on a winding road").surroundings.road == "curved"


@pytest.mark.parametrize(
    ("prompt", "lines"),
    [
        ("A striker kicks the ball and the goalkeeper catches it.",
         ["kicking 1 ball", "1 ball", "catching 1 ball"]),
        ("A girl holds a balloon, which rises. She jumps.", ["1 girl, jumps", "1 balloon"]),
        ("A man sits on a bench near pigeons. They all fly up. He waves.",
         ["then waves", "1 bench", "3 pigeons, fly up"]),
        ("A drone hovers. It then flies forward and lands.", ["then flies forward, then sinks"]),
        ("Two dogs chase a cat. It jumps.", ["2 dogs, run", "1 cat, jumps"]),
        ("A dog chases a ball and catches it.", ["catching 1 ball", "1 ball"]),
        ("Neither the dog nor the cat moves.", ["1 dog, stands still", "1 cat, stands still"]),
        ("Two people with umbrellas walk.", ["holding 2 umbrellas", "2 umbrellas"]),
        ("Six eggs roll off the table.", ["6 eggs, roll", "1 table, stands still"]),
        ("Half a dozen ducks swim.", ["6 ducks, swim"]),
        ("1,000 birds fly.", ["24 birds, fly"]),
        ("Two balls collide.", ["2 balls, meeting each other"]),
        ("Cars crash into each other.", ["3 cars, meeting each other"]),
        ("A man and a woman meet.", ["meeting 1 woman", "1 woman"]),
        ("A car crashes into a tree.", ["meeting 1 tree", "1 tree"]),
        ("A red car hits a blue car.", ["1 car, red, meeting 1 car", "1 car, blue"]),
        ("A man hits a ball.", ["hitting 1 ball", "1 ball"]),
        ("A ball falls from above.", ["1 ball, falls down"]),
        ("A ball is thrown.", ["1 ball, flies through the air"]),
        ("A penguin colony walks.", ["8 penguins, walk"]),
        ("A duck runs followed by two dogs.", ["1 duck", "2 dogs, walk, following 1 duck"]),
        ("People sit around a table eating pizza.", ["people, eat, at 1 table", "table", "pizza"]),
        ("A man stands on a bridge looking at a dog.", ["looking at 1 dog", "bridge", "1 dog"]),
        ("A dog jumps through a hoop.", ["1 dog, jumps, through 1 hula hoop", "1 hula hoop"]),
        ("A flag flutters.", ["1 flag, moves in place"]),
        ("An eagle dives.", ["1 eagle, flies down"]),
        ("A ball bounces five times and comes to rest.", ["1 ball, bounces, then stands still"]),
        ("**A car** _drives_ to the `left`.", ["1 car, drives left"]),
        ("# Cars\n- a red car\n- a blue van", ["3 cars", "1 car, red", "1 van, blue"]),
    ],
)  # fmt: skip
def test_who_does_what_in_everyday_sentences(prompt: str, lines: list[str]) -> None:
    description = parse_prompt(prompt)
    said = description.report().scene[: len(description.objects)]
    assert len(said) == len(lines), said
    assert all(line in found for line, found in zip(lines, said, strict=True)), said


@pytest.mark.parametrize(
    ("prompt", "objects", "reported"),
    [
        ("a car with black wheels drives", ["car"], ("black",)),
        ("a bird with red wings flies", ["bird"], ("red",)),
        ("a boy kicks a ball and then throws a stone", ["child", "ball", "stone"], ("throws",)),
        ("0 cars and a dog", ["dog"], ()),
        ("a car starts", ["car"], ("starts",)),
        ("a car crashes", ["car"], ("crashes",)),
        ("nothing moves but a dog", ["dog"], ("nothing",)),
        ("lava fountains glow while a boat rocks", ["boat"], ("lava", "fountains")),
        ("a stream of cars moves", ["car"], ("stream",)),
        ("a sea of flags waves", ["flag"], ("sea",)),
        ("a tower of light behind a car", ["car"], ("tower",)),
        ("a bowl of apples stands", ["bowl", "apple"], ()),
        ("a camel caravan of five animals crosses a dune", ["camel"], ()),
        ("a man saws the trunk of a birch", ["man", "tree"], ("trunk",)),
        ("a potter with clay-covered hands sits", ["potter"], ("clay", "covered")),
        ("a three-legged dog runs", ["dog"], ("three", "legged")),
        ("a four-legged robot dog walks", ["robot dog"], ("four", "legged")),
        ("a six-wheeled rover drives", ["mobile robot"], ("six", "wheeled")),
        ("a dog runs to steer a dozen sheep", ["dog", "sheep"], ("steer",)),
        ("a shepherd drives his sheep", ["shepherd", "sheep"], ("drives",)),
        ("an elephant walks, a calf follows", ["elephant", "elephant"], ()),
        ("a boy juggles three oranges", ["child"], ()),
        ("the red team's goal stands", ["goal"], ("red", "team")),
        ("a van with flashing lights drives", ["van"], ()),
        ("a bowl of tomato soup stands", ["bowl"], ("soup",)),
        ("a waiter serves a cake", ["waiter", "cake"], ("serves",)),
        ("a door painted orange opens", ["door"], ("painted",)),
        ("Two dogs run. The brown dog jumps.", ["dog", "dog"], ()),
        ("A farmer digs. The man waves.", ["farmer"], ()),
        ("a boy is cycling", ["child", "bicycle"], ()),
        ("a man takes a bow", ["man"], ()),
        ("a man drills a hole", ["man"], ()),
        ("a cat plays with a ball of yarn", ["cat", "yarn ball"], ()),
        ("A toddler walks. The child falls.", ["toddler"], ()),
    ],
)
def test_no_part_count_second_act_or_other_sense_is_invented(
    prompt: str, objects: list[str], reported: tuple[str, ...]
) -> None:
    description = parse_prompt(prompt)
    assert [one.noun for one in description.objects] == objects
    assert set(reported) <= set(description.not_understood)


@pytest.mark.parametrize(
    ("prompt", "nouns"),
    [
        ("a batter waits while the catcher crouches behind him", ["baseball batter", "catcher"]),
        ("a collie barks and the dog runs", ["border collie"]),
        ("a flock of sheep stands, then the sheep run", ["sheep"]),
        ("people and stalls slide by", ["person"]),
        ("the lamps of a lorry blind the driver", ["person"]),
    ],
)
def test_each_thing_named_is_one_thing(prompt: str, nouns: list[str]) -> None:
    found = [one.noun for one in parse_prompt(prompt).objects if one.noun in (*nouns, "slide")]
    assert found == nouns


@pytest.mark.parametrize(
    ("prompt", "kind"),
    [
        ("a goalkeeper dives late", "stand"),
        ("a batter swings at a ball", "swing bat"),
        ("a man rises from a chair", "stand"),
        ("a jeep climbs a slope", "drive"),
        ("an excavator dumps its load", "stand"),
        ("a woman pulls out two loaves", "pull out"),
    ],
)
def test_a_verb_of_several_senses_has_the_one_that_fits(prompt: str, kind: str) -> None:
    description = parse_prompt(prompt)
    assert description.objects[0].motion is not None
    assert description.objects[0].motion.kind == kind
    assert all(move.kind != "dolly" for move in description.shot.moves)


def test_it_is_no_person() -> None:
    description = parse_prompt("two men run towards a ball, and a boy kicks it")
    kicked = [one for one in description.relations if one.kind == "kick"]
    assert [description.objects[i].noun for i in kicked[0].targets] == ["ball"]


@pytest.mark.parametrize(
    ("prompt", "objects"),
    [
        ("a train of mules rests", ["donkey"]),
        ("a seal pup sleeps", ["seal"]),
        ("a cow follows its mother", ["cow"]),
        ("a third one watches from a bench", ["bench"]),
        ("spray flies over the bow of a boat", ["boat"]),
    ],
)
def test_words_beside_others_are_not_shown_by_themselves(prompt: str, objects: list[str]) -> None:
    assert [one.noun for one in parse_prompt(prompt).objects] == objects


@pytest.mark.parametrize("prompt", ["a cook flips a plate", "a woman raises a flag"])
def test_what_is_done_to_a_thing_is_no_motion_of_oneself(prompt: str) -> None:
    description = parse_prompt(prompt)
    assert description.objects[0].motion is not None
    assert description.objects[0].motion.kind == "stand"


@pytest.mark.parametrize("prompt", ["a cat climbs a tree", "a man climbs a ladder"])
def test_who_climbs_a_thing_does_so_at_it(prompt: str) -> None:
    description = parse_prompt(prompt)
    motion = description.objects[0].motion
    assert motion is not None
    assert motion.kind == "climb"
    assert description.substituted == ()
    assert [one.kind for one in description.relations] == ["work on"]
    assert parse_prompt("a plane climbs").substituted == ()


def test_what_is_shown_in_part_is_noted() -> None:
    (lifts,) = parse_prompt("a crane lifts a box").substituted
    assert (lifts.said, lifts.shown) == ("lifts", "box untouched")
    note = "the traffic light goes through all its colours"
    assert note in parse_prompt("a traffic light turns green").notes


def test_nouns_before_a_letter_are_reported() -> None:
    assert {"sign", "language"} <= set(parse_prompt("sign language letter B").not_understood)


def test_things_that_pass_each_other_come_from_opposite_sides() -> None:
    description = parse_prompt("three trains pass each other")
    moved = [(one.count, one.motion and one.motion.direction) for one in description.objects]
    assert moved == [(2, "right"), (1, "left")]
    assert [(one.kind, one.subject, one.targets) for one in description.relations] == [
        ("past", 1, (0,))
    ]


def test_things_that_chase_each_other_follow_one_ahead() -> None:
    for prompt in ("two dogs chase each other", "a cat and a dog chase each other"):
        description = parse_prompt(prompt)
        assert [one.count for one in description.objects] == [1, 1]
        assert [(one.kind, one.subject, one.targets) for one in description.relations] == [
            ("follow", 1, (0,))
        ]


@pytest.mark.parametrize(("noun", "own_hz"), WORK_RATES_HZ.items())
def test_a_stated_rate_is_kept_by_what_spins_by_itself(noun: str, own_hz: float) -> None:
    motion = parse_prompt(f"a {noun} rotates at 300 rpm").objects[0].motion
    assert motion is not None
    assert (motion.kind, motion.pace * own_hz) == ("work", pytest.approx(5.0))
    model = NOUNS[noun].build(colour=None, scale=1.0, seed=0)
    poses = [Pose(time / own_hz, 0.0, 0.0, "work") for time in (0.0, 0.3, 1.0)]
    start, part, turn = (np.array([one.to_body for one in model.parts(each)]) for each in poses)
    assert np.allclose(start, turn)
    assert not np.allclose(start, part)


def test_a_rate_that_is_not_shown_is_reported() -> None:
    assert {"300", "rpm"} <= set(parse_prompt("a windmill turns at 300 rpm").not_understood)


@pytest.mark.parametrize(
    ("prompt", "note"),
    [
        ("3.5 cars drive", "a count of 3.5 is shown as 4"),
        ("a ball rolls left and hits a box", "the ball may go another way than left: to the hit"),
    ],
)
def test_what_is_rounded_or_turned_is_noted(prompt: str, note: str) -> None:
    assert note in parse_prompt(prompt).notes


@pytest.mark.parametrize(
    ("prompt", "noun"),
    [
        ("a pitcher throws a baseball", "baseball player"),
        ("a woman pours from a pitcher", "jug"),
        ("a tray of glasses", "glass"),
        ("a man with glasses", "glasses"),
        ("a picture of a car on a wall", "poster"),
        ("a picture of a car on a road", "car"),
        ("a glass on a table", "glass"),
    ],
)
def test_a_word_of_several_senses_fits_its_neighbours(prompt: str, noun: str) -> None:
    assert noun in [one.noun for one in parse_prompt(prompt).objects]


def test_the_glass_of_a_window_is_no_vessel() -> None:
    description = parse_prompt("a car with a crack in the glass")
    assert [one.noun for one in description.objects] == ["car"]
    assert "glass" in description.not_understood


def test_hands_of_a_person_are_that_person() -> None:
    description = parse_prompt("gloved hands of a surgeon tie a suture")
    assert [one.noun for one in description.objects] == ["surgeon"]
    assert "suture" in description.not_understood
    assert "tie → handle nothing" in map(str, description.substituted)


def test_both_words_beside_a_slash_do_it() -> None:
    description = parse_prompt("a car/truck drives")
    assert [one.motion and one.motion.kind for one in description.objects] == ["drive", "drive"]


def test_sprinkling_from_above_is_no_view() -> None:
    assert parse_prompt("a chef sprinkles sugar from above").shot.view is None
    assert parse_prompt("a dog runs, from above").shot.view is not None


@pytest.mark.parametrize(("prompt", "kind"), [("a bell", "stand"), ("a bell rings", "work")])
def test_a_bell_swings_if_it_rings(prompt: str, kind: str) -> None:
    motion = parse_prompt(prompt).objects[0].motion
    assert motion is not None
    assert motion.kind == kind


def test_a_game_without_players_is_one_person_and_reported() -> None:
    description = parse_prompt("table tennis rally on a beach")
    assert [one.noun for one in description.objects] == ["person"]
    assert description.surroundings.place == "beach"
    assert {one.shown for one in description.substituted} == {"one person, swing racket"}


@pytest.mark.parametrize(
    ("prompt", "noun", "kind"),
    [
        ("fans wave flags", "person", "wave"),
        ("a fan spins", "fan", "work"),
        ("a police car chases a van", "police car", "drive"),
        ("a dog chases a cat", "dog", "run"),
        ("a turtle glides above a diver", "turtle", "swim"),
        ("an eagle glides", "eagle", "fly"),
        ("a boat rolls", "boat", "sway"),
        ("a ball rolls", "ball", "roll"),
    ],
)
def test_a_verb_is_done_as_its_subject_does_it(prompt: str, noun: str, kind: str) -> None:
    first = parse_prompt(prompt).objects[0]
    assert first.motion is not None
    assert (first.noun, first.motion.kind) == (noun, kind)


def test_from_behind_a_thing_is_no_view() -> None:
    description = parse_prompt("a man watches from behind a fence")
    assert description.shot.view is None
    assert [one.kind for one in description.relations] == ["behind"]
    assert parse_prompt("a man walks, seen from behind").shot.view == "back"


@pytest.mark.parametrize(
    ("prompt", "place"),
    [
        ("firefighters spray water on a burning house", "grass"),
        ("a clock in heavy rain", "grass"),
        ("a clock", "indoor"),
        ("rain on a window", "indoor"),
        ("a fish in the water", "underwater"),
    ],
)
def test_water_that_is_sprayed_and_rain_on_things_fit_the_place(prompt: str, place: str) -> None:
    assert parse_prompt(prompt).surroundings.place == place


@pytest.mark.parametrize(
    ("prompt", "nouns"),
    [
        ("a parked motorcycle", ["parked motorcycle"]),
        ("two bicycles are parked by a fence", ["parked bicycle", "fence"]),
        ("a bicycle leans against a wall", ["parked bicycle", "wall"]),
        ("a bicycle drives left", ["bicycle"]),
        ("a cyclist waits at a sign", ["bicycle", "sign"]),
        ("a man on a bike waits", ["man", "bicycle"]),
    ],
)
def test_what_is_parked_has_no_rider(prompt: str, nouns: list[str]) -> None:
    assert [one.noun for one in parse_prompt(prompt).objects] == nouns


@pytest.mark.parametrize(
    ("prompt", "kind", "unread"),
    [
        ("two women play badminton over a net", "beside", ("over",)),
        ("a horse jumps over a fence", "above", ()),
        ("a bird flies over a fence", "above", ()),
    ],
)
def test_who_stays_on_the_ground_is_not_above_a_thing(prompt, kind, unread) -> None:
    description = parse_prompt(prompt)
    assert [one.kind for one in description.relations] == [kind]
    assert description.not_understood == unread


def test_parts_that_a_model_has_and_places_of_a_still_camera_are_reported() -> None:
    assert "wheel" in parse_prompt("a car with no wheel").not_understood
    assert "behind" in parse_prompt("a dog runs. The camera is behind a tree.").not_understood


def test_mountains_around_are_a_backdrop_and_no_objects() -> None:
    lake = parse_prompt("a sailboat on a lake surrounded by mountains")
    assert [one.noun for one in lake.objects] == ["sailboat"]
    assert lake.surroundings.backdrops == ("mountain",)


@pytest.mark.parametrize(
    ("prompt", "kinds"),
    [
        ("thunderstorm with lightening at night", ["lightning"]),
        ("a singer under changing spotlights", ["stage lights"]),
        ("a house with blinking lights", ["blinking lights"]),
        ("a van with blue flashing lights", ["beacon"]),
        ("leaves blowing in the wind", ["leaves"]),
        ("a child blows soap bubbles", ["bubbles"]),
        ("a truck drives on a dirt road leaving a cloud of dust", ["dust"]),
        ("water runs from a tap", ["pour"]),
        ("a shirt with vertical stripes", []),
    ],
)
def test_what_moves_by_itself_is_an_effect(prompt: str, kinds: list[str]) -> None:
    assert [effect.kind for effect in parse_prompt(prompt).effects] == kinds


def test_a_colour_that_half_of_the_lamps_have_is_reported() -> None:
    assert "blue" in parse_prompt("a police car with flashing blue lights").not_understood
    assert "blue" not in parse_prompt("a fire engine with blue lights").not_understood


def test_what_a_hand_moves_without_touching_it_is_told() -> None:
    found = parse_prompt("a checkerboard tilted by hand").substituted
    assert [one.shown for one in found] == ["checkerboard untouched"]


@pytest.mark.parametrize(
    ("prompt", "verb"),
    [
        ("toddler chasing soap bubbles", "chasing"),
        ("a girl pops bubbles", "pops"),
        ("a man throws snow", "throws"),
    ],
)
def test_nothing_that_is_drawn_acts_on_an_effect(prompt: str, verb: str) -> None:
    found = parse_prompt(prompt)
    assert verb in found.not_understood
    assert all(effect.source is None for effect in found.effects)
    assert found.objects[0].motion is None or found.objects[0].motion.kind == "stand"


def test_patterns_are_read_beside_what_they_are_part_of() -> None:
    def nouns(prompt: str) -> list[str]:
        return [one.noun for one in parse_prompt(prompt).objects]

    assert nouns("a black square moving on a white background") == ["square"]
    assert nouns("people crossing a square") == ["person"]
    assert nouns("a disc with black and white stripes spins") == ["spinning disc"]
    assert nouns("an expanding white ring") == ["expanding ring"]
    assert nouns("eye blinking close up") == ["eye"]
    assert nouns("a man closes his eyes") == ["man"]


def test_all_that_is_worn_is_on_who_is_named_before() -> None:
    found = parse_prompt("a woman in a black dress and red boots dances")
    (worn,) = [one for one in found.relations if one.kind == "wear"]
    assert [found.objects[i].noun for i in worn.targets] == ["dress", "boot"]


def test_stars_above_are_those_of_the_night_sky() -> None:
    found = parse_prompt("a man walks under the stars")
    assert [one.noun for one in found.objects] == ["man"]
    assert found.light.kind == "night"


@pytest.mark.parametrize(
    ("prompt", "count"),
    [("sheep graze", 3), ("a sheep grazes", 1), ("the sheep grazes", 1), ("two sheep graze", 2)],
)
def test_a_noun_without_a_plural_form_is_many_where_nothing_stands_before_it(
    prompt: str, count: int
) -> None:
    assert [one.count for one in parse_prompt(prompt).objects] == [count]


@pytest.mark.parametrize(
    ("prompt", "kind", "is_shown"),
    [
        ("a motorcycle roars past a tree", "drive", True),
        ("a fox streaks across a field", "run", True),
        ("a bus pulls away from a bus stop", "drive", True),
        ("a van trundles along a road", "drive", True),
        ("a school of fish changes direction", "turn", True),
        ("a drone threads through a gate", "fly", True),
        ("a man runs toward the lens", "run", True),
        ("a newton's cradle swings", "work", True),
        ("a dog in front of a gorblefrax runs", "run", False),
    ],
)
def test_how_things_go(prompt: str, kind: str, is_shown: bool) -> None:
    description = parse_prompt(prompt)
    assert description.objects[0].motion is not None
    assert description.objects[0].motion.kind == kind
    assert (description.not_understood == ()) == is_shown


@pytest.mark.parametrize(
    ("prompt", "colour", "material"),
    [
        ("a ball made of steel rolls", None, "steel"),
        ("a table made out of red plastic", "red", "plastic"),
        ("two statues made from marble", None, "marble"),
    ],
)
def test_a_thing_is_made_of_a_material(prompt: str, colour: str | None, material: str) -> None:
    description = parse_prompt(prompt)
    assert description.not_understood == ()
    named = description.objects[0].colour
    assert (named.name if named and named.name in prompt else None) in (colour, material)
    assert any(one.word == material and one.aspect == "material" for one in description.claims)


def test_what_gains_speed_accelerates():
    for verb in ("accelerates to gain speed", "picks up speed", "gathers speed"):
        motion = parse_prompt(f"a truck {verb}").objects[0].motion
        assert motion is not None
        assert (motion.pace, motion.end_pace) == (0.5, 1.8)


def test_what_pulls_into_a_place_comes_to_rest_there():
    said = parse_prompt("a truck pulls into a parking lot")
    assert said.surroundings.place == "parking lot"
    assert said.objects[0].motion is not None
    assert said.objects[0].motion.end_pace == 0.0


def test_boats_that_are_moored_lie_still():
    for verb in ("docked", "moored", "anchored"):
        said = parse_prompt(f"two boats {verb} in a harbour")
        assert not said.not_understood
        assert said.objects[0].motion is not None
        assert not said.objects[0].motion.is_moving


def test_what_leans_on_something_stands_at_it():
    said = parse_prompt("a bicycle leans against a wall")
    assert [one.kind for one in said.relations] == ["beside"]
    assert [(one.said, one.shown) for one in said.substituted] == [("leans", "stand")]


def test_things_sit_where_they_are():
    assert not parse_prompt("a vase sitting on a table").substituted
    assert not parse_prompt("a train sits beside a platform").substituted
    assert parse_prompt("a doll sits on a chair").substituted


@pytest.mark.parametrize("noun", ["bear", "horse", "wolf", "lizard"])
def test_a_colour_before_an_animal_is_its_colour(noun):
    said = parse_prompt(f"a white {noun} walks")
    assert said.objects[0].colour is not None
    assert not said.substituted


@pytest.mark.parametrize("prompt", ["a van stuck in traffic", "a traffic jam on a highway"])
def test_traffic_that_holds_somebody_up_stands(prompt):
    objects = parse_prompt(prompt).objects
    assert len(objects) > 2
    assert all(one.motion is not None and one.motion.is_stuck for one in objects)


@pytest.mark.parametrize(
    ("prompt", "word"),
    [("a woman walks down a mountain path", "down"), ("a car drives up a steep road", "up")],
)
def test_up_and_down_a_slope_are_lost_on_level_ground(prompt, word):
    assert word in parse_prompt(prompt).not_understood
    assert not parse_prompt("a car drives down a street").not_understood


def test_trains_run_along_the_tracks_of_a_railway():
    said = parse_prompt("a train travels along railroad tracks")
    assert said.surroundings.place == "railway"
    assert [one.noun for one in said.objects] == ["train"]


def test_who_walks_under_an_umbrella_holds_it():
    assert [one.kind for one in parse_prompt("a girl walks under an umbrella").relations] == [
        "hold"
    ]
    assert [one.kind for one in parse_prompt("a girl sits under an umbrella").relations] == [
        "under"
    ]


def test_petals_and_caps_belong_to_what_has_them():
    assert not parse_prompt("a flower with its petals").effects
    assert len(parse_prompt("mushrooms with brown caps").objects) == 1


def test_a_rain_jacket_is_no_rain():
    assert parse_prompt("a man in a rain jacket").surroundings.weather is None


def test_a_dog_with_a_boat_is_aboard():
    said = parse_prompt("two people on a sailboat with a dog on open water")
    assert said.surroundings.place == "sea"
    nouns = [one.noun for one in said.objects]
    assert {nouns[one.subject] for one in said.relations if one.kind == "on"} >= {"dog"}


def test_a_bicycle_that_is_only_named_has_no_rider():
    assert [one.noun for one in parse_prompt("a pink bicycle").objects] == ["parked bicycle"]
    assert [one.noun for one in parse_prompt("a cyclist").objects] == ["bicycle"]
    assert [one.noun for one in parse_prompt("a bicycle speeds past").objects] == ["bicycle"]


def test_a_pull_out_is_a_move_of_the_camera():
    said = parse_prompt("A pull-out from a house by a lake")
    assert [one.noun for one in said.objects] == ["house"]
    assert [one.kind for one in said.shot.moves] == ["dolly"]


def test_people_with_umbrellas_hold_one_each():
    said = parse_prompt("A couple get caught in the rain with umbrellas")
    assert [one.kind for one in said.relations] == ["hold"]
    assert [one.count for one in said.objects] == [2, 2]


def test_evening_wear_is_no_evening():
    assert parse_prompt("a couple in evening wear walk home").light.kind is None


def test_who_falls_down_the_stairs_does_not_climb():
    fallen, climber = (
        parse_prompt(f"a person {verb} down the stairs") for verb in ("falls", "walks")
    )
    assert fallen.objects[0].motion is not None
    assert climber.objects[0].motion is not None
    assert (fallen.objects[0].motion.kind, climber.objects[0].motion.kind) == ("fall over", "climb")
    assert "down" in fallen.not_understood


@pytest.mark.parametrize("prompt", ["a street after the rain", "a field before a storm"])
def test_rain_of_another_time_does_not_fall(prompt):
    assert parse_prompt(prompt).surroundings.weather is None


def test_a_time_lapse_of_things_is_reported():
    assert "time lapse" in {
        one.said for one in parse_prompt("a time-lapse of a flower").substituted
    }
    assert not parse_prompt("a time-lapse of clouds over a mountain").substituted


@pytest.mark.parametrize(
    ("prompt", "place"),
    [
        ("a bottle floats down a river", "river"),
        ("three bottles drift on a lake", "lake"),
        ("a bottle floats in the sea", "sea"),
    ],
)
def test_things_that_float_are_on_the_water(prompt, place):
    said = parse_prompt(prompt)
    assert said.surroundings.place == place
    assert (said.objects[0].motion.kind, said.objects[0].motion.shore) == ("slide", "in")
    assert parse_prompt("a balloon floats over a lake").objects[0].motion.shore is None
