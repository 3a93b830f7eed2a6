"""Lights of the day: each phrase for one is drawn so, and is not said to be shown of another."""

import numpy as np
import pytest
from tests.scenes.staged import SIZE, stage, thing
from tests.scenes.test_short_prompts import report, staged

from texvent_scenes.models.nouns import NOUNS
from texvent_scenes.raycast.render import render
from texvent_scenes.read import read
from texvent_scenes.read.parsing.lexicon import lexicon_of
from texvent_scenes.staging.surroundings.lighting import LIGHTINGS

LOW = ("morning", "afternoon", "dusk", "dawn")
PHRASES = [
    (" ".join(words), sense.value[2])
    for words, senses in lexicon_of(None).items()
    for sense in senses
    if sense.kind == "scene" and sense.value[:2] == ("light", "kind")
    and sense.value[2] in ("sunny", "overcast", "stormy", *LOW)
]  # fmt: skip
"""Phrases of the lexicon for a light of the day, and that light."""


def test_there_are_phrases_of_each_light():
    assert {light for _, light in PHRASES} == {"sunny", "overcast", "stormy", *LOW}


@pytest.mark.parametrize("light", ["sunny", "overcast", "stormy", *LOW])
def test_a_light_is_drawn_by_the_height_and_the_colour_of_the_sun(light):
    seen = stage(thing("horse"), light=light).environment(0.0)
    red, _, blue = seen.sun_colour
    assert (seen.sun_direction[2] < 0.45) == (light in LOW)
    assert light not in LOW or red > 1.5 * blue
    assert seen.shadows == (light not in ("overcast", "stormy"))


def test_each_phrase_for_a_light_is_read_so():
    assert not [(phrase, light) for phrase, light in PHRASES
                if read(f"a horse walks, {phrase}", NOUNS).scene.light.kind != light]  # fmt: skip


def test_dark_clouds_are_darker_than_an_overcast_sky():
    dark, grey = (np.mean(render(staged(f"a horse walks, {one} clouds")[0], 0.0, SIZE))
                  for one in ("dark", "grey"))  # fmt: skip
    assert dark < 0.7 * grey


@pytest.mark.parametrize("first", ["at dusk", "at dawn", "at night"])
@pytest.mark.parametrize("second", ["early morning", "late afternoon", "dark clouds"])
def test_a_light_of_the_day_beside_another_time_is_not_shown(first, second):
    assert second not in report(f"a horse walks {first}, {second}").shown


@pytest.mark.parametrize("place", ["kitchen", "office", "gym"])
def test_a_room_that_looks_the_same_all_day_does_not_show_a_low_sun(place):
    assert "late afternoon" not in report(f"a woman walks in a {place}, late afternoon").shown


def test_each_light_of_the_day_is_another_one():
    assert len({LIGHTINGS[one] for one in ("day", "sunny", "overcast", "stormy", *LOW)}) == 8
