"""Set phrases, names and styles."""

import pytest

from texvent.scenes.language.parser import parse_prompt


def first_of(prompt: str) -> str:
    return parse_prompt(prompt).summary()[0]


def styles_of(prompt: str) -> dict[str, str]:
    return {one.word: one.value for one in parse_prompt(prompt).claims if one.aspect == "style"}


@pytest.mark.parametrize(
    ("prompt", "first", "style"),
    [
        ("a dog runs on a beach, oil painting", "1 dog, runs", "oil painting"),
        ("a dog runs on a beach, in steampunk style", "1 dog, runs", "steampunk style"),
        ("an oil painting of a dog that runs", "1 dog, runs", "oil painting"),
        ("a dog runs on a beach by Monet, in the style of Japan", "1 dog, runs", "by monet"),
        ("a dog runs on a beach, Van Gogh style", "1 dog, runs", "van gogh style"),
        ("a red bus drives left, black and white", "1 bus, red, drives left", "black and white"),
        ("a black and white photo of a bus", "1 bus, drives", "black and white"),
    ],
)
def test_a_style_is_said_once_and_takes_nothing_from_the_sentence(
    prompt: str, first: str, style: str
) -> None:
    assert first_of(prompt) == first
    assert style in styles_of(prompt)
    assert parse_prompt(prompt).not_understood == ()
    assert all(one.noun not in ("picture frame", "poster") for one in parse_prompt(prompt).objects)


@pytest.mark.parametrize(
    "prompt", ["a painting of a horse on a wall", "a black and white dog", "the oil painting"]
)
def test_pictures_that_hang_and_colours_of_things_are_no_styles(prompt: str) -> None:
    assert not styles_of(prompt)


def test_an_unusual_frame_of_the_prompt_changes_nothing() -> None:
    description = parse_prompt("A serene tableau of in the desert, a camel walks")
    assert description.surroundings.place == "desert"
    assert first_of("A serene tableau of in the desert, a camel walks") == "1 camel, walks"


def test_words_of_mood_are_noted_and_do_not_take_the_verb() -> None:
    description = parse_prompt("a cute happy dog runs joyfully")
    assert description.not_understood == ()
    assert "words of mood change nothing here: cute, happy, joyfully" in description.notes
    assert not any(one.lost for one in description.claims)


@pytest.mark.parametrize(
    ("prompt", "first", "said"),
    [
        ("Anna Berg reads a book", "1 woman, reads", ("anna berg", "woman")),
        ("Mr. Berg walks", "1 man, walks", ("mr berg", "man")),
        ("Zorblax Quimby is waving", "1 person, waves", ("zorblax quimby", "person")),
        ("a car drives through Lisbon", "1 car, drives", ("lisbon", "city")),
    ],
)
def test_names_are_persons_and_cities(prompt: str, first: str, said: tuple[str, str]) -> None:
    description = parse_prompt(prompt)
    assert description.summary()[0] == first
    assert [(one.said, one.shown) for one in description.substituted] == [said]


@pytest.mark.parametrize(
    ("prompt", "first"),
    [
        ("a cup on the top of a box", "1 cup, stands still, on 1 box"),
        ("a cup on the bottom of a table", "1 cup, stands still, under 1 table"),
        ("a cat sits inside of a box", "1 cat, sits, in 1 box"),
        ("There are two red cars in a garage", "2 cars, red, stand still"),
        ("a dog laying on a rug", "1 dog, lies, on 1 rug"),
        ("a horse taking a peaceful walk", "1 horse, walks"),
        ("a bus making its way down a road", "1 bus, drives"),
        ("a table has a cup and a plate on it", "1 table, stands still"),
        ("a wall that has two signs on it", "1 wall, stands still, with 2 signs"),
        ("two couples walk", "4 people, walk"),
        ("a sheep running to join a herd of its kind", "1 sheep, runs, towards 7 sheep"),
        ("a bench in the shade of a tree", "1 bench, stands still, under 1 tree"),
    ],
)
def test_set_phrases_are_read_as_the_plain_words_they_mean(prompt: str, first: str) -> None:
    assert first_of(prompt) == first
    assert parse_prompt(prompt).not_understood == ()


def test_a_set_phrase_is_reported_as_the_prompt_has_it() -> None:
    assert "making its way" in parse_prompt("a bus making its way down a road").shown


def test_what_is_only_prepared_is_not_done() -> None:
    description = parse_prompt("a man preparing to swing a bat")
    assert "swing" in description.not_understood
    assert description.summary()[0] == "1 man, stands still"


@pytest.mark.parametrize(
    ("prompt", "first"),
    [
        ("a suit case on a table", "1 suitcase, stands still, on 1 table"),
        ("a green house beside a tree", "1 house, green, stands still, beside 1 tree"),
        ("a truck turning a corner", "1 truck, turns"),
        ("a cow bending down to drink water from a lake", "1 cow, drinks"),
        (
            "a man with a long coat wearing a hat",
            "1 man, stands still, wearing 1 coat, wearing 1 hat",
        ),
        ("a boat with dolphins jumping", "1 boat, sails, with 3 dolphins"),
        ("a group of people windsurfing", "5 people, stand still"),
    ],
)
def test_who_and_what_is_meant_in_captions(prompt: str, first: str) -> None:
    assert first_of(prompt) == first


@pytest.mark.parametrize(
    ("prompt", "place"),
    [
        ("a goat in a deep rocky canyon", "canyon"),
        ("an indoor museum", "museum"),
        ("a goat on top of a snowy hill", "hills"),
        ("a man stands next to some water", "beach"),
        ("a dog lies on the floor in a kitchen", "kitchen"),
        ("busy highway at night", "motorway"),
    ],
)
def test_what_a_place_is_anyway_costs_no_word(prompt: str, place: str) -> None:
    description = parse_prompt(prompt)
    assert description.surroundings.place == place
    assert description.not_understood == ()


def test_snow_on_a_thing_lies_all_around_it() -> None:
    assert parse_prompt("a snow covered tree").surroundings.has_snow
    assert parse_prompt("a foggy lighthouse").surroundings.weather == "fog"


def test_a_name_is_not_corrected_to_a_word() -> None:
    description = parse_prompt("a boat sails along the Seine river")
    assert description.not_understood == ("seine",)
    assert not any(claim.lost for claim in description.claims)


@pytest.mark.parametrize(
    ("prompt", "first", "count"),
    [
        ("On a narrow street people wave", "3 people, wave", 1),
        ("people are riding on horses", "3 people, sit, riding 3 horses", 2),
        ("a sign with a number written on it", "1 sign, stands still", 1),
        ("open suitcase on a table", "1 suitcase, stands still, on 1 table", 2),
        ("a women walks", "1 woman, walks", 1),
        ("a vase beside two other vases", "1 vase, stands still, beside 2 vases", 2),
        (
            "a man on a motorcycle with people watching",
            "1 man, stands still, riding 1 motorcycle",
            3,
        ),
        ("dolls sitting on a table on display", "3 dolls, stand still, on 1 table", 2),
        ("a man sits at a laptop wearing a hat", "1 man, sits, beside 1 laptop, wearing 1 hat", 3),
    ],
)
def test_nothing_is_added_that_a_caption_does_not_name(prompt: str, first: str, count: int) -> None:
    description = parse_prompt(prompt)
    assert description.summary()[0] == first
    assert len(description.objects) == count


@pytest.mark.parametrize(
    ("prompt", "first"),
    [
        ("A 19th century soldier runs", "1 soldier, runs"),
        ("a 1940s bus drives", "1 bus, drives"),
        ("a 24 year old woman walks", "1 woman, walks"),
    ],
)
def test_ages_and_times_are_no_counts(prompt: str, first: str) -> None:
    assert first_of(prompt) == first
    assert parse_prompt(prompt).not_understood == ()


def test_a_setting_is_the_place_before_it() -> None:
    assert parse_prompt("an ocean scene").surroundings.place == "sea"
    assert parse_prompt("a bus in a desert landscape").surroundings.place == "desert"


@pytest.mark.parametrize(
    ("prompt", "first"),
    [
        ("This is a picture of two horses on a lawn.", "2 horses, walk"),
        ("this is people walking on a lawn", "3 people, walk"),
        ("It's a dog that runs", "1 dog, runs"),
        ("There's a dog that runs", "1 dog, runs"),
        ("this is how I do makeup", "1 person, does 'put on makeup'"),
        ("a film of a dog that runs", "1 dog, runs"),
    ],
)
def test_openings_that_name_nothing_are_left_out(prompt: str, first: str) -> None:
    assert first_of(prompt) == first
    assert parse_prompt(prompt).not_understood == ()


@pytest.mark.parametrize(
    ("prompt", "move"),
    [
        ("A pan right over a city at dusk", ("pan", "right")),
        ("A truck left past a row of wind turbines", ("truck", "left")),
        ("A pedestal down from the top of a waterfall", ("pedestal", "down")),
        ("A tilt up from a cup", ("tilt", "up")),
    ],
)
def test_a_move_of_the_camera_that_opens_a_sentence_is_no_thing(
    prompt: str, move: tuple[str, str]
) -> None:
    found = parse_prompt(prompt)
    assert [(one.kind, one.direction) for one in found.shot.moves] == [move]
    assert {"frying pan", "truck", "column"}.isdisjoint(one.noun for one in found.objects)


def test_a_pan_that_was_left_on_a_stove_is_a_pan() -> None:
    assert first_of("A pan left on a stove") == "1 frying pan, stands still, on 1 oven"


@pytest.mark.parametrize(
    ("prompt", "first", "lost"),
    [
        ("two slices of cake on a plate", "2 cakes, stand still, on 1 plate", ("slices",)),
        ("a two story house and a tree", "1 house, stands still", ("two", "story")),
        ("two other dogs run", "2 dogs, run", ()),
        ("a man snow boarding", "1 man, snowboards", ()),
        ("a man has on a hat", "1 man, stands still, wearing 1 hat", ()),
    ],
)
def test_measures_and_split_words(prompt: str, first: str, lost: tuple[str, ...]) -> None:
    assert first_of(prompt) == first
    assert parse_prompt(prompt).not_understood == lost


def test_what_a_phrase_stands_for_is_reported_as_the_prompt_has_it() -> None:
    assert "women" in parse_prompt("a women walks").shown
    assert "wearing skis" in parse_prompt("a man wearing skis").shown


def test_a_room_in_black_and_white_is_no_film() -> None:
    assert not parse_prompt("a kitchen decorated in black and white").is_grey
    assert parse_prompt("a dog filmed in black and white").is_grey


@pytest.mark.parametrize(
    ("prompt", "nouns"),
    [
        ("A close-up and moody portrait of a fox in a wood", {"fox"}),
        ("close-up portrait of a fox", {"fox"}),
        ("a portrait of a queen hangs on a wall", {"picture frame", "wall"}),
    ],
)
def test_who_is_portrayed_is_shown_unless_the_picture_hangs(prompt: str, nouns: set[str]) -> None:
    assert {one.noun for one in parse_prompt(prompt).objects} == nouns


def test_skies_that_one_is_on_are_skis() -> None:
    assert first_of("a woman on skies in the snow") == "1 woman, does 'stand on skis'"
    assert "ski" not in {one.noun for one in parse_prompt("a gull under blue skies").objects}
