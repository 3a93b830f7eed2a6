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


def test_losses_share_a_plot_and_every_score_has_its_own() -> None:
    rows = [row(n, accuracy=n / 9, error=1 / n, validation_loss=2 / n) for n in (1, 2, 3)]
    figure = draw_curves(rows, best=2)
    assert [axes.get_title() for axes in figure.axes] == ["loss", "accuracy", "error"]
    legend = [text.get_text() for text in figure.axes[0].get_legend().get_texts()]
    assert legend == ["best epoch 2", "training loss", "validation loss"]
    curve = figure.axes[0].get_lines()[-1]
    assert list(curve.get_xdata()) == [1, 2, 3]
    assert curve.get_ydata().tolist() == pytest.approx([2, 1, 2 / 3])
    assert figure.get_facecolor() == (1, 1, 1, 1)


def test_a_standard_error_is_drawn_around_its_score() -> None:
    rows = [row(n, accuracy=0.5, accuracy_standard_error=0.1) for n in (1, 2)]
    figure = draw_curves(rows)
    assert [axes.get_title() for axes in figure.axes] == ["loss", "accuracy"]
    band = figure.axes[1].collections[0].get_paths()[0].vertices
    assert band[:, 1].min() == pytest.approx(0.4)
    assert band[:, 1].max() == pytest.approx(0.6)


def test_many_scores_take_several_lines_and_one_epoch_is_enough() -> None:
    figure = draw_curves([row(1, a=1, b=2, c=3, d=4)], best=1)
    assert len(figure.axes) == 5
    assert figure.get_size_inches().tolist() == pytest.approx([13.5, 6.8])
