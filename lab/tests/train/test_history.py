"""Curves of a training: which scores share a plot, and what is marked."""

from __future__ import annotations

import pytest

torch = pytest.importorskip("torch", reason="make test-torch runs the tests that need torch")
pytest.importorskip("matplotlib")

from texvent_lab.train.loop import draw_curves  # noqa: E402

pytestmark = pytest.mark.torch


def row(epoch: int, **scores: float) -> dict[str, float]:
    found = {name.replace("_", " "): value for name, value in scores.items()}
    return {"epoch": epoch, "training loss": 1 / epoch, **found, "seconds": 2.0}


def test_many_scores_take_several_lines_and_one_epoch_is_enough() -> None:
    figure = draw_curves([row(1, a=1, b=2, c=3, d=4)], best=1)
    assert len(figure.axes) == 5
    assert figure.get_size_inches().tolist() == pytest.approx([13.5, 6.8])
