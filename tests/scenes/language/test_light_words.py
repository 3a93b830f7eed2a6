"""Words of light: read beside nouns of light, and left alone elsewhere."""

from __future__ import annotations

import pytest

from texvent.scenes.language.parser import parse_prompt


@pytest.mark.parametrize(
    ("prompt", "light"),
    [
        ("a dog runs across a lawn in warm evening light", "dusk warm"),
        ("a cat sits in a kitchen, cold white light", "cold"),
        ("a truck drives along a road, flat cloudy light", "overcast soft"),
        ("a herd of zebras in harsh midday light", "day hard"),
        ("a dancer in a blue light", "blue"),
        ("a boxer under bright lights", "bright"),
        ("The hall is bright. A man walks.", "bright"),
        ("a man hammers in a dim workshop", "dim"),
        ("a car on a gloomy street", "overcast gloomy"),
        ("a man walks. The light is soft and warm.", "warm soft"),
        ("a horse gallops, backlit by low sun", "dusk back"),
        ("a vase on a table, soft window light comes from the left", "soft left"),
        ("The sun is low behind them. Two men walk.", "sunny back low"),
        ("a fox in cold blue light", "blue"),
        ("a knight walks, low golden light", "golden low"),
        ("a car on a road, grey daylight", "overcast"),
    ],
)
def test_words_of_light_say_how_it_is(prompt: str, light: str) -> None:
    said = parse_prompt(prompt).light
    parts = (said.kind, said.tint.name if said.tint else None, said.hardness, said.brightness,
             said.direction, "low" if said.is_low else None)  # fmt: skip
    assert " ".join(one for one in parts if one is not None) == light


@pytest.mark.parametrize(
    "prompt",
    [
        "a woman in a warm coat walks in the snow",
        "a child holds a soft toy",
        "a worker in a hard hat",
        "a man swims in cold water",
        "a bright red car drives left",
        "a strong man lifts a barbell",
        "a man walks on a cold morning",
        "a police car with a blue light",
        "a bicycle with a front light",
        "the front light of a bicycle",
        "a car waits until the light is green",
        "a woman waits for the green light at a crossing",
        "a ceiling light in a room",
        "a light blue car",
        "a dog runs, low angle, morning light",
        "a boat on bright blue water",
        "a man on a table with soft shadows",
    ],
)
def test_the_same_words_elsewhere_say_nothing_of_the_light(prompt: str) -> None:
    said = parse_prompt(prompt).light
    assert (said.tint, said.hardness, said.brightness, said.direction, said.is_low) == (
        None, None, None, None, False,
    )  # fmt: skip
