"""Parts that a noun may have any number of, or in a colour of their own."""

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from texvent.errors import FileFormatError
from texvent_scenes.models.nouns import NOUNS
from texvent_scenes.models.parts import read_nouns, with_parts
from texvent_scenes.models.protocol import Pose
from texvent_scenes.models.tables import read_table
from texvent_scenes.scene_input import list_nouns
from texvent_scenes.spec.scene import OwnPart, Place, Scene, SceneObject
from texvent_scenes.staging.idle_fields import list_idle

REST = Pose(0.0, 0.0, 0.0, "stand")
CHOICES = [(noun, one) for noun in NOUNS.values() for one in noun.choices]
COUNTED = [(noun, one) for noun, one in CHOICES if one.most]
COLOURED = [(noun, one) for noun, one in CHOICES if one.is_coloured]
RED = (0.7, 0.01, 0.02)


def parts_of(noun, *said):
    return with_parts(noun, said).build(colour=None, scale=1.0, seed=3).parts(REST)


@given(row=st.sampled_from(COUNTED), share=st.floats(0.0, 1.0))
@example(row=COUNTED[0], share=0.0)
def test_each_more_of_a_part_adds_as_many_shapes(row, share):
    noun, choice = row
    count = 1 + round(share * (choice.most - 1))
    usual, said, one = (len(parts_of(noun, (choice.name, n, None)))
                        for n in (choice.usual, count, 1))  # fmt: skip
    each = (len(parts_of(noun, (choice.name, 2, None))) - one) or 1
    assert said - one == each * (count - 1)
    assert len(parts_of(noun)) == usual == one + each * (choice.usual - 1)


@pytest.mark.parametrize(
    "row", COUNTED, ids=[f"{noun.name} {choice.name}" for noun, choice in COUNTED]
)
def test_parts_of_any_number_are_at_different_places(row):
    noun, choice = row
    for count in {1, 2, 3, choice.most}:
        places = [tuple(np.round(one.to_body, 4).ravel())
                  for one in parts_of(noun, (choice.name, count, None))]  # fmt: skip
        assert len({*places}) == len(places)


@pytest.mark.parametrize(
    "row", COLOURED, ids=[f"{noun.name} {choice.name}" for noun, choice in COLOURED]
)
def test_a_colour_of_parts_changes_these_alone(row):
    noun, choice = row
    usual, red = parts_of(noun), parts_of(noun, (choice.name, None, RED))
    changed = [(a, b) for a, b in zip(usual, red, strict=True) if a.colour != b.colour]
    assert 0 < len(changed) < len(usual)
    assert all(b.colour[0] > 5.0 * max(b.colour[1:]) and a.texture == b.texture for a, b in changed)


def test_the_words_for_parts_have_the_numbers_that_are_drawn():
    owned = read_table("words", "read")["parts"]
    for word, counts in owned.items():
        for noun, count in counts.items():
            choice = NOUNS[noun].find_choice(word) if noun in NOUNS else None
            assert choice is None or not choice.most or choice.usual == count, (word, noun)


@pytest.mark.parametrize(
    ("part", "message"),
    [({"name": "candels", "count": 3}, "candles"), ({"name": "candles", "count": 40}, "1 to 24"),
     ({"name": "candles", "count": 3}, "")],
)  # fmt: skip
def test_parts_that_a_noun_does_not_have_are_refused(part, message):
    scene = Scene(objects=(SceneObject("cake", parts=(OwnPart(**part),)),))
    idle = [one.why for one in list_idle(scene, Scene(place=Place("plain")), list_nouns())]
    assert len(idle) == bool(message)
    assert all(message in one for one in idle)


def test_a_wrong_row_of_parts_is_one_clear_line(tmp_path):
    file = tmp_path / "things.toml"
    file.write_text("[box]\nown_parts.lids = { most = 3 }\nparts = 'box paint 0 0 1 1 1 1'\n")
    with pytest.raises(FileFormatError, match=r"own_parts.lids may have most, where sizes.lids"):
        read_nouns(file)
