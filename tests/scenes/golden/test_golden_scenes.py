"""Sentences mean what they meant, and some of them look as they looked."""

import tomllib

import numpy as np
import pytest
from tests.scenes.golden.golden import (
    CHANNELS,
    decided,
    film,
    read_lines,
    read_scene,
    stored_films,
    stored_scenes,
)
from tests.scenes.golden.rows import rows, stored_sums

from texvent_scenes.models.places import PLACES
from texvent_scenes.scene_input import list_nouns, list_words
from texvent_scenes.spec.data import scene_from_data
from texvent_scenes.spec.files import scene_text

WITHIN = dict(zip(CHANNELS, (1.0, 1.0, 1.0, 0.1, 0.01, 0.2, 0.2), strict=True))
"""What a block's mean may differ by between processors: a pixel of 576 may fall to a neighbour."""
FILMS, WORDS = stored_films(), list_words(list_nouns())


def test_sentences_mean_what_they_meant():
    stored = stored_scenes()
    assert list(stored) == read_lines("sentences.txt")
    others = [one for one in stored if decided(read_scene(one)) != decided(stored[one])]
    assert not others, f"{len(others)} of {len(stored)}, such as {others[:5]}"


def test_files_say_all_that_sentences_say():
    for data in stored_scenes().values():
        scene = scene_from_data(data, WORDS)
        assert scene_from_data(tomllib.loads(scene_text(scene, ".toml")), WORDS) == scene


@pytest.mark.parametrize("sentence", FILMS)
def test_pictures_and_truth_are_as_they_were(sentence):
    means, _ = film(sentence)
    worst = np.abs(means - FILMS[sentence][0]).max(axis=(0, 1, 2))
    assert {name for name, one in zip(CHANNELS, worst, strict=True) if one > WITHIN[name]} == set()


@pytest.mark.long
def test_every_row_of_a_table_gives_the_numbers_that_it_gave():
    stored, others = stored_sums(), {}
    found = {name: find() for name, find in rows()}
    assert list(found) == list(stored)
    for name, marks in found.items():
        assert list(marks) == list(stored[name]), name
        near = np.isclose(list(marks.values()), list(stored[name].values()), rtol=1e-6, atol=1e-6)
        if not near.all():
            others[name] = [one for one, row in zip(marks, near, strict=True) if not row.all()]
    assert not others, f"{len(others)} of {len(stored)}"


def test_all_sentences_that_are_to_be_filmed_are_and_show_every_ground():
    assert list(FILMS) == read_lines("filmed.txt")
    filmed = (decided(stored_scenes()[one]) for one in FILMS)
    shown = {PLACES[one.place.name].ground for one in filmed if one is not None}
    assert shown == {place.ground for place in PLACES.values()}
