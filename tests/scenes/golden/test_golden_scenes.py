"""Sentences mean what they meant, and some of them look as they looked."""

import numpy as np
import pytest
from tests.scenes.golden.golden import (
    CHANNELS,
    describe,
    film,
    plain,
    read_descriptions,
    read_films,
    read_lines,
)

WITHIN = dict(zip(CHANNELS, (1.0, 1.0, 1.0, 0.1, 0.01, 0.2, 0.2), strict=True))
"""What a block's mean may differ by between processors: a pixel of 576 may fall to a neighbour."""
FILMS = read_films()


def test_sentences_mean_what_they_meant():
    stored = read_descriptions()
    assert list(stored) == read_lines("sentences.txt")
    others = [one for one in stored if plain(describe(one)) != stored[one]]
    assert not others, f"{len(others)} of {len(stored)}, such as {others[:5]}"


@pytest.mark.parametrize("sentence", FILMS)
def test_pictures_and_truth_are_as_they_were(sentence):
    means, _ = film(sentence)
    worst = np.abs(means - FILMS[sentence][0]).max(axis=(0, 1, 2))
    assert {name for name, one in zip(CHANNELS, worst, strict=True) if one > WITHIN[name]} == set()


def test_all_sentences_that_are_to_be_filmed_are():
    assert list(FILMS) == read_lines("filmed.txt")
