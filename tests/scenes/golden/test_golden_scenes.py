"""Sentences mean what they meant, and some of them look as they looked."""

import tomllib

import numpy as np
import pytest
from tests.examples import one_of
from tests.scenes.golden.golden import (
    decided,
    differing,
    film,
    read_lines,
    read_scene,
    stored_films,
    stored_scenes,
)
from tests.scenes.golden.rows import PICTURE, is_near, rows, stored_sums

from texvent_scenes.models.places import PLACES
from texvent_scenes.scene_input import list_nouns, list_words
from texvent_scenes.spec.data import scene_from_data
from texvent_scenes.spec.files import scene_text

PARTS = 15
"""Of the rows: a brief run has one, and of it one row of a few."""
FILMS, WORDS = stored_films(), list_words(list_nouns())


def test_sentences_mean_what_they_meant():
    stored = stored_scenes()
    assert list(stored) == read_lines("sentences.txt")
    tried = [*stored][:: one_of(len(stored))]
    others = [one for one in tried if decided(read_scene(one)) != decided(stored[one])]
    assert not others, f"{len(others)} of {len(tried)}, such as {others[:5]}"


def test_files_say_all_that_sentences_say():
    for data in stored_scenes().values():
        scene = scene_from_data(data, WORDS)
        assert scene_from_data(tomllib.loads(scene_text(scene, ".toml")), WORDS) == scene


@pytest.mark.parametrize("sentence", FILMS)
def test_pictures_and_truth_are_as_they_were(sentence):
    means, _ = film(sentence)
    assert differing(means, FILMS[sentence][0]) == set()


@pytest.mark.long
@pytest.mark.parametrize("part", range(PARTS))
def test_rows_of_tables_give_the_numbers_that_they_gave(part):
    stored, others = dict([*stored_sums().items()][part :: PARTS * one_of()]), {}
    found = {name: find() for name, find in [*rows()][part :: PARTS * one_of()]}
    assert list(found) == list(stored)
    for name, marks in found.items():
        before = stored[name]
        assert list(marks) == list(before), name
        near = {one: one == PICTURE or is_near(marks[one], before[one]) for one in marks}
        if PICTURE in near:
            near[PICTURE] = not differing(*map(np.array, (marks[PICTURE], before[PICTURE])))
        if not all(near.values()):
            others[name] = [one for one, is_so in near.items() if not is_so]
    assert not others, f"{len(others)} of {len(stored)}"


def test_all_sentences_that_are_to_be_filmed_are_and_show_every_ground():
    assert list(FILMS) == read_lines("filmed.txt")
    filmed = (decided(stored_scenes()[one]) for one in FILMS)
    shown = {PLACES[one.place.name].ground for one in filmed if one is not None}
    assert shown == {place.ground for place in PLACES.values()}
