"""What a prompt is understood as, and which words are reported."""

from __future__ import annotations

import cProfile
import pstats

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from texvent.errors import InputError
from texvent.scenes.description import SceneDescription
from texvent.scenes.language.meaning.draft import MAX_OBJECTS
from texvent.scenes.language.parser import parse_prompt
from texvent.scenes.language.phrases.set_phrases import SET_PHRASES
from texvent.scenes.language.vocabulary.objects import MAX_COUNT
from texvent.scenes.language.words.lexicon import Lexicon
from texvent.scenes.language.words.tokens import tokenize_prompt
from texvent.scenes.models.kinds.looks import LOOKS
from texvent.scenes.models.nouns import NOUNS

from ..every_row import for_every

SUV_PROMPT = (
    "The camera follows behind a white SUV with a black roof rack as it speeds up a steep dirt "
    "road surrounded by pine trees on a steep mountain slope, dust kicks up from it's tires, the "
    "sunlight shines on the SUV as it speeds along the dirt road. The dirt road curves gently "
    "into the distance, with no other cars or vehicles in sight."
)

THINGS: list[tuple[str, list[str]]] = [
    ("a red car drives left past two trees at dusk", ["1 car red drive left", "2 tree stand"]),
    ("two dogs run right", ["2 dog run right"]),
    ("3 dogs and a cat walk to the left", ["3 dog walk left", "1 cat walk left"]),
    ("a couple of birds fly away", ["2 bird fly away"]),
    ("several cows graze in a field", ["5 cow graze"]),
    ("a flock of birds", ["9 bird fly"]),
    ("many balloons rise into the sky", ["8 balloon rise"]),
    ("ostriches crossing the grassland", ["3 ostrich walk across"]),
    ("a light blue van is parked", ["1 van light blue stand"]),
    ("a dark green bus moves from right to left", ["1 bus dark green drive left"]),
    ("the car is yellow and drives towards the camera", ["1 car yellow drive towards"]),
    ("a huge elephant walks slowly", ["1 elephant x2 walk @0.5"]),
    ("a tiny rabbit hops", ["1 rabbit x0.4 jump @0.7"]),
    ("a running dog", ["1 dog run"]),
    ("a parked truck and a moving bus", ["1 truck stand", "1 bus drive"]),
    ("a spinning cube", ["1 cube spin"]),
    ("a wheel spins at 2 Hz", ["1 wheel spin @4"]),
    ("a car at 50 km/h", ["1 car drive 13.89m/s"]),
    ("a car drives right at 36 kph", ["1 car drive right 10m/s"]),
    ("a man runs at 3 m/s", ["1 man run 3m/s"]),
    ("a train travels at 60 mph", ["1 train drive 26.82m/s"]),
    ("a fast motorcycle", ["1 motorcycle drive @2.4"]),
    ("a boat sails very slowly", ["1 boat sail @0.3"]),
    ("a ball bounces", ["1 ball bounce"]),
    ("a boy kicks a ball", ["1 child stand", "1 ball stand"]),
    ("a man rides a horse", ["1 man sit", "1 horse walk"]),
    ("a man rides a bicycle to the left", ["1 man sit", "1 bicycle drive left"]),
    ("a woman drives a blue car", ["1 woman sit", "1 open car blue drive"]),
    (
        "a car drives left past a tree and a dog runs right",
        ["1 car drive left", "1 tree stand", "1 dog run right"],
    ),
    ("a boat with dolphins jumping", ["1 boat sail", "3 dolphin jump"]),
    ("a wild-eyed horse gallops in circles", ["1 horse run circle @1.3"]),
    ("a drone hovers", ["1 drone hover"]),
    ("an airplane takes off", ["1 airplane rise"]),
    ("a well-made balloon floats upwards", ["1 balloon hover up"]),
    ("the kid on the left jumps", ["1 child <left jump"]),
    ("a car at night drives left", ["1 car drive left"]),
    ("on the right, a house", ["1 house <right stand"]),
    ("a house on the left and a tree on the right", ["1 house <left stand", "1 tree <right stand"]),
    (
        "on the left a man waves, on the right a woman claps",
        ["1 man <left wave", "1 woman <right clap"],
    ),
    (
        "a man on the left waves and a woman on the right claps",
        ["1 man <left wave", "1 woman <right clap"],
    ),
    ("a lamp next to a chair on the right", ["1 lamp stand", "1 chair <right stand"]),
    ("a cup and a bottle in a row", ["1 cup <row stand", "1 bottle <row stand"]),
    ("a wolf approaches a sheep", ["1 wolf walk", "1 sheep stand"]),
    ("a wolf approaches", ["1 wolf walk towards"]),
    ("a fish does not move", ["1 fish stand"]),
    ("a person stands still", ["1 person stand"]),
    ("a flag waves", ["1 flag work"]),
    ("a pendulum swings", ["1 pendulum work"]),
    ("fifteen penguins", ["15 penguin walk"]),
    ("100 sheep", [f"{MAX_COUNT} sheep walk"]),
    ("a dark car", ["1 car dark drive"]),
    ("police cars speed by", ["3 police car drive @2.4"]),
    ("a woman in the middle dances", ["1 woman <centre dance"]),
    ("a dog chases a cat", ["1 dog run @1.2", "1 cat walk"]),
    ("a bird without trees", ["1 bird fly"]),
    ("not a car but a bus drives left", ["1 bus drive left"]),
    (SUV_PROMPT, ["1 suv white drive @2.4", "14 pine stand"]),
]


def describe_things(description: SceneDescription) -> list[str]:
    lines = []
    for scene_object in description.objects:
        motion = scene_object.motion
        assert motion is not None
        words = [str(scene_object.count), scene_object.noun]
        words += [f"x{scene_object.scale:g}"] if scene_object.scale != 1.0 else []
        words += [f"<{scene_object.side}"] if scene_object.side else []
        words += [scene_object.colour.name] if scene_object.colour else []
        words += [motion.kind]
        words += [motion.direction] if motion.direction else []
        words += [f"{motion.speed_m_s:.4g}m/s"] if motion.speed_m_s is not None else []
        words += [f"@{motion.pace:.3g}"] if motion.pace != 1.0 else []
        lines.append(" ".join(words))
    return lines


@pytest.mark.parametrize(("prompt", "objects"), THINGS)
def test_things_counts_colours_sizes_and_motions(prompt: str, objects: list[str]) -> None:
    assert describe_things(parse_prompt(prompt)) == objects


@pytest.mark.parametrize(
    ("prompt", "relations"),
    [
        ("a car drives past two trees", [("past", "car", ["tree"])]),
        ("a cup on a table", [("on", "cup", ["table"])]),
        ("a dog next to a house", [("beside", "dog", ["house"])]),
        ("a cat is behind the sofa", [("behind", "cat", ["sofa"])]),
        ("a cow between a house and a tree", [("between", "cow", ["house", "tree"])]),
        ("between a house and a tree stands a cow", [("between", "cow", ["house", "tree"])]),
        ("a boat under a bridge", [("under", "boat", ["bridge"])]),
        ("a helicopter orbits a building", [("around", "helicopter", ["building"])]),
        ("a lion chases a zebra", [("follow", "lion", ["zebra"])]),
        ("a cup and a bottle on a table", [("on", "cup", ["table"]), ("on", "bottle", ["table"])]),
        ("a man with a dog walks", [("with", "man", ["dog"])]),
        ("a road sign to the left of a house", [("left of", "sign", ["house"])]),
        ("a house surrounded by trees", [("surround", "house", ["tree"])]),
        ("a car passes a tree and a house", [("past", "car", ["tree", "house"])]),
        ("a man rides a horse", [("ride", "man", ["horse"])]),
        ("a boy kicks a ball", [("kick", "child", ["ball"])]),
    ],
)
def test_relations(prompt: str, relations: list[tuple[str, str, list[str]]]) -> None:
    description = parse_prompt(prompt)
    names = [scene_object.noun for scene_object in description.objects]
    found = [
        (r.kind, names[r.subject], [names[t] for t in r.targets]) for r in description.relations
    ]
    assert found == relations


@pytest.mark.parametrize(
    ("prompt", "moves", "view"),
    [
        ("the camera pans left over a street", [("pan", "left")], None),
        ("a car, camera slowly zooms in", [("zoom", "in")], None),
        ("zoom out from a house", [("zoom", "out")], None),
        ("the camera follows a dog", [("follow", None)], None),
        ("the camera follows behind a red car", [("follow", "behind")], None),
        ("the camera orbits around a statue of a horse", [("orbit", None)], None),
        ("handheld camera, a man walks", [("handheld", None)], None),
        ("static camera, a man walks", [("static", None)], None),
        ("the camera moves forward through a forest", [("travel", "forward")], None),
        ("the camera moves right past houses", [("truck", "right")], None),
        ("the camera tilts up and a bird flies", [("tilt", "up")], None),
        ("aerial view of a city with cars", [], "aerial"),
        ("drone shot of a running horse", [], "aerial"),
        ("a runner is followed", [], None),
        ("low angle shot of a truck driving right", [], "low"),
        (SUV_PROMPT, [("follow", "behind")], None),
    ],
)
def test_camera(prompt: str, moves: list[tuple[str, str | None]], view: str | None) -> None:
    shot = parse_prompt(prompt).shot
    assert [(move.kind, move.direction) for move in shot.moves] == moves
    assert shot.view == view


@pytest.mark.parametrize(
    ("prompt", "place", "light", "weather"),
    [
        ("a car on a highway at night", "motorway", "night", None),
        ("a dog on a dirt road at sunset", "dirt road", "dusk", None),
        ("cars in a city street by moonlight", "city", "moonlight", None),
        ("sharks in the ocean", "underwater", None, None),
        ("a boat at sea at dawn", "sea", "dawn", None),
        ("a house by the sea", "beach", None, None),
        ("a man walks in a dark street", "city", "night", None),
        ("a child plays ball on a sunny beach", "beach", "sunny", None),
        ("a fox in the snow", "snow", None, None),
        ("a deer in a foggy forest", "forest", None, "fog"),
        ("it rains on a bus in the city", "city", None, "rain"),
        ("snow falls on a cabin", "snow", None, "snow"),
        ("a car under an overcast sky", "road", "overcast", None),
        ("a cat sleeps on a bed", "indoor", None, None),
        ("an airplane flies left", "sky", None, None),
        ("a construction site", "construction site", None, None),
        ("a cube in outer space", "space", None, None),
        ("a zebra walks", "savanna", None, None),
        (SUV_PROMPT, "dirt road", "sunny", None),
    ],
)
def test_place_light_and_weather(
    prompt: str, place: str, light: str | None, weather: str | None
) -> None:
    description = parse_prompt(prompt)
    assert description.surroundings.place == place
    assert description.light.kind == light
    assert description.surroundings.weather == weather


@pytest.mark.parametrize(
    ("prompt", "hertz"),
    [
        ("a room with light flickering at 1 kHz", 1000.0),
        ("a chair, the light flickers", 10.0),
        ("a chair in steady light", None),
    ],
)
def test_flicker(prompt: str, hertz: float | None) -> None:
    assert parse_prompt(prompt).light.flicker_hz == hertz


@pytest.mark.parametrize(
    ("prompt", "words"),
    [
        ("a red car drives left past two trees at dusk", ()),
        ("a purple wug drives left past a car", ("purple", "wug", "drives", "left", "past")),
        ("a car with a wug", ("wug",)),
        ("a car on a unicorn path drives left", ("unicorn",)),
        ("the roof of the horse", ("roof",)),
        ("a cat and 7", ("7",)),
        ("a dog 🚗 runs", ("🚗",)),
        (SUV_PROMPT, ("up", "gently")),
    ],
)
def test_words_without_effect_are_reported_in_order(prompt: str, words: tuple[str, ...]) -> None:
    assert parse_prompt(prompt).not_understood == words


def test_excluded_things_are_not_added() -> None:
    description = parse_prompt(SUV_PROMPT)
    assert description.absent == ("car",)
    assert [scene_object.noun for scene_object in description.objects] == ["suv", "pine"]
    assert parse_prompt("a street without any people or cars").objects == ()
    assert parse_prompt("a street without any people or cars").absent == ("person", "car")


@pytest.mark.parametrize(
    ("prompt", "first", "words"),
    [
        ("a white vintage SUV drives left", "1 suv, white, drives left", ("vintage",)),
        (
            "three shiny rugged red cars stop",
            "3 cars, red, drive, then stand still",
            ("shiny", "rugged"),
        ),
        ("a red wug, a blue car", "1 car, blue, drives", ("red", "wug")),
    ],
)
def test_an_unknown_adjective_does_not_part_the_others_from_their_noun(
    prompt: str, first: str, words: tuple[str, ...]
) -> None:
    description = parse_prompt(prompt)
    assert description.summary()[0] == first
    assert description.not_understood == words


@pytest.mark.parametrize(
    ("prompt", "shown", "absent"),
    [
        ("no cars, only 3 bicycles", ["parked bicycle"], ("car",)),
        ("no cars, people or dogs but a horse walks left", ["horse"], ("car", "person", "dog")),
        ("no cars, no bicycles", [], ("car", "bicycle")),
    ],
)
def test_a_contrast_ends_what_is_left_out(
    prompt: str, shown: list[str], absent: tuple[str, ...]
) -> None:
    description = parse_prompt(prompt)
    assert [scene_object.noun for scene_object in description.objects] == shown
    assert description.absent == absent
    assert description.not_understood == ()


def test_a_construction_site_is_at_work_unless_the_prompt_says_otherwise() -> None:
    site = "a construction site with workers, an excavator and a crane"
    assert kinds_of_motion(site) == {"worker": "walk", "excavator": "work", "crane": "work"}
    assert kinds_of_motion(f"{site}. The excavator stands still")["excavator"] == "stand"


def test_what_cannot_travel_leaves_a_shared_verb_to_the_others() -> None:
    kinds = kinds_of_motion("a construction site with a crane, workers walking around")
    assert kinds == {"crane": "work", "worker": "walk"}


def kinds_of_motion(prompt: str) -> dict[str, str | None]:
    objects = parse_prompt(prompt).objects
    return {
        scene_object.noun: scene_object.motion.kind if scene_object.motion else None
        for scene_object in objects
    }


def test_the_suv_sentence_is_a_mountain_road_with_dust() -> None:
    surroundings = parse_prompt(SUV_PROMPT).surroundings
    assert surroundings.backdrops == ("mountain",)
    assert surroundings.has_dust


@pytest.mark.parametrize(
    ("prompt", "named"),
    [
        ("qwerty zxcv", "qwerty, zxcv;"),
        ("the of a", "no word of it names a thing"),
        ("wug " * 9 + " ".join(f"blorp{'abcdefghij'[i % 10] * (i + 1)}" for i in range(60)), "wug"),
    ],
)
def test_a_prompt_with_nothing_understood_is_an_error(prompt: str, named: str) -> None:
    with pytest.raises(
        InputError, match=r"nothing in the prompt was understood|not to be English"
    ) as caught:
        parse_prompt(prompt)
    assert named in str(caught.value)
    assert "texvent generators" in str(caught.value)
    assert len(str(caught.value)) < 300


@pytest.mark.parametrize("prompt", ["", "   ", "\n\t"])
def test_a_blank_prompt_is_an_error(prompt: str) -> None:
    with pytest.raises(InputError, match="the prompt is empty"):
        parse_prompt(prompt)


def test_something_always_moves() -> None:
    still = parse_prompt("a house")
    assert [move.kind for move in still.shot.moves] == ["handheld"]
    assert any("the camera sways a little" in line for line in still.summary())
    dog = parse_prompt("a dog")
    assert dog.objects[0].motion is not None
    assert dog.objects[0].motion.kind == "walk"
    assert any("does what it usually does" in line for line in dog.summary())


def test_the_summary_reads_as_what_will_be_shown() -> None:
    assert parse_prompt("a red car drives left past two trees at dusk").summary() == [
        "1 car, red, drives left, past 2 trees",
        "2 trees, stand still",
        "place: road",
        "light: dusk",
        "camera: static",
        "no place is said: a road is chosen",
    ]


def test_no_more_bodies_than_fit_are_shown_and_it_is_said() -> None:
    description = parse_prompt("24 cows, 24 sheep and 24 pigs walk left")
    assert [scene_object.count for scene_object in description.objects] == [24, 24, 12]
    assert "no more than 60 bodies are shown" in description.notes


def test_what_is_left_out_of_a_long_list_is_said() -> None:
    nouns = [name for name in NOUNS if " " not in name][: MAX_OBJECTS + 3]
    description = parse_prompt(", ".join(f"a {noun}" for noun in nouns))
    assert len(description.objects) == MAX_OBJECTS
    assert any("only the first" in note for note in description.notes)
    assert description.not_understood == tuple(nouns[MAX_OBJECTS:])


@for_every(sorted(NOUNS))
def test_every_noun_and_synonym_is_known_in_singular_and_plural(name: str) -> None:
    noun = NOUNS[name]
    for word in (name, *noun.synonyms, *noun.plurals):
        description = parse_prompt(f"a {word}")
        nouns = [scene_object.noun for scene_object in description.objects]
        assert nouns in ([name], [f"parked {name}"]), word
        shown = [one.shown for one in description.substituted]
        assert word not in noun.synonyms or shown == [LOOKS[name] for _ in (name,) if name in LOOKS]


SET_FORMS = frozenset(form for forms in SET_PHRASES.values() for form in forms)
KNOWN_WORDS = Lexicon(NOUNS).words.union(*(form.split() for form in SET_FORMS))
INVENTED = "wug"
WORDS = st.sampled_from(
    (
        *("a", "the", "red", "car", "dogs", "two", "no", "without", "camera", "pans", "left"),
        *("right", "drives", "on", "under", "between", "and", ",", ".", "trees", "at", "night"),
        *("50", "Hz", "km", "/", "h", "fast", "light", "dark", "snow", "falls", "rain", "it"),
        *("which", "zoom", "in", INVENTED, "7", "'", '"', "-", "é", "the sky", "blue", "roof rack"),
        *("follows", "behind", "very", "slowly", "past"),
    )
)
PHRASES = st.sampled_from(sorted(Lexicon(NOUNS).phrases | SET_FORMS))


@settings(max_examples=150)
@given(
    st.one_of(
        st.text(max_size=200),
        st.lists(WORDS, max_size=40).map(" ".join),
        st.lists(st.one_of(PHRASES, WORDS), max_size=8).map(" ".join),
    )
)
@example("skate#boarding")
@example("a dude on the side of the road beside")
@example("a heavy city traffic sign")
@example("a lamp blinks at 10 seconds")
@example("a swing, its umbrella in rush hour traffic, a traffic pup, a traffic fleet")
def test_any_text_is_read_and_every_word_is_understood_or_reported(text: str) -> None:
    try:
        description = parse_prompt(text)
    except InputError:
        return  # compounds such as "car vat" are refused as a whole
    assert description == parse_prompt(text)
    lost = description.not_understood
    assert len(set(lost)) == len(lost)
    substituted = [one.said for one in description.substituted]
    listed = {word for part in (*lost, *substituted, *description.shown) for word in part.split()}

    for token in tokenize_prompt(text):
        corrected = f"'{token.written}' is read as"
        if any(note.startswith(corrected) for note in description.notes):
            continue
        is_word = not (token.is_punctuation or token.is_number)
        if is_word and token.text not in KNOWN_WORDS:
            assert token.text in (lost if token.text == INVENTED else listed)
    for scene_object in description.objects:
        assert 1 <= scene_object.count <= MAX_COUNT
        assert scene_object.motion is not None


def test_a_phrase_of_the_camera_before_a_noun_is_read_to_its_end() -> None:
    description = parse_prompt("a tree between in camera zoom dark / roof rack")
    assert "tree" in description.shown


def test_a_very_long_prompt_is_read() -> None:
    description = parse_prompt("a red car drives left past a tree and " * 500 + "stops")
    assert len(description.objects) == MAX_OBJECTS


def test_a_prompt_of_twice_the_length_takes_about_twice_the_work() -> None:
    calls = []
    for number in (1, 150, 300):  # the first one fills the caches
        profile = cProfile.Profile()
        profile.runcall(parse_prompt, "a red car drives left past a tree and " * number + "stops")
        calls.append(pstats.Stats(profile).total_calls)
    assert calls[2] < 2.5 * calls[1]


def test_no_word_of_the_lexicon_is_lost() -> None:
    """Each word of a prompt of known words ends up understood, reported, or is a stop word."""
    description = parse_prompt("gibberish1 car blorp drives flurb left")
    assert description.not_understood == ("gibberish", "blorp", "flurb")


def test_a_verb_after_a_comma_and_a_word_after_an_object_are_no_nouns() -> None:
    thrown = parse_prompt("a woman tosses the ball high")
    assert [one.noun for one in thrown.objects] == ["woman", "ball"]
    assert thrown.not_understood == ("high",)
    bent = parse_prompt("a woman throws a ball, arches her back and walks left")
    assert [one.noun for one in bent.objects] == ["woman", "ball"]


@pytest.mark.parametrize(
    ("prompt", "noun"),
    [
        ("hands peeling an orange", "person"),
        ("fingers playing the piano", "person"),
        ("a hand waving", "hand"),
        ("a hand opens and closes", "hand"),
        ("hands clapping", "person"),
    ],
)
def test_hands_at_work_are_those_of_a_person(prompt: str, noun: str) -> None:
    description = parse_prompt(prompt)
    assert description.objects[0].noun == noun
    assert bool(description.report().substituted) == (noun == "person")
