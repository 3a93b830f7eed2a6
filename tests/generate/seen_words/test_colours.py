"""What colour pixels look like."""

from __future__ import annotations

import numpy as np
import pytest

from texvent.generate.seen_words.colours import share_like
from texvent.scenes.language.vocabulary.objects import COLOURS
from texvent.transfer import WHITE, encode_srgb


@pytest.mark.parametrize("name", sorted(COLOURS))
def test_every_colour_looks_like_itself(name: str) -> None:
    coded = encode_srgb(np.array([COLOURS[name]])) / WHITE
    assert share_like(np.asarray(coded, dtype=np.float64), COLOURS[name]) == 1.0


@pytest.mark.parametrize(
    ("pixel", "name", "is_like"),
    [
        ((0.5, 0.05, 0.05), "red", True),
        ((0.2, 0.2, 0.2), "red", False),
        ((0.1, 0.6, 0.1), "red", False),
        ((0.9, 0.55, 0.2), "white", False),
        ((0.7, 0.7, 0.72), "white", True),
        ((0.3, 0.3, 0.3), "white", False),
        ((0.5, 0.5, 0.5), "black", False),
        ((0.4, 0.27, 0.15), "brown", True),
    ],
)
def test_shades_and_other_colours(
    pixel: tuple[float, float, float], name: str, is_like: bool
) -> None:
    assert share_like(np.array([pixel]), COLOURS[name]) == float(is_like)


def test_no_pixels_show_no_colour() -> None:
    assert share_like(np.zeros((0, 3)), COLOURS["red"]) == 0.0
