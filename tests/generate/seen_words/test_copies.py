"""Copies that are said to be together are told apart from those that are not."""

from __future__ import annotations

import pytest
from tests.generate.seen_words.test_words import report_of


@pytest.mark.parametrize(
    ("prompt", "reason"),
    [
        ("two chefs cook together", "together"),
        ("two buses in the background", "in the background (bus nothing is before it)"),
    ],
)
def test_what_copies_are_not_seen_to_do_is_reported(prompt: str, reason: str) -> None:
    assert any(one.startswith(reason) for one in report_of(prompt).not_shown)


@pytest.mark.parametrize("prompt", ["three women standing together", "two boys walk side by side"])
def test_what_is_together_is_not_reported(prompt: str) -> None:
    assert not report_of(prompt).not_shown


def test_clothes_that_nobody_wears_are_reported() -> None:
    shown = report_of("Three people walk. Four helmets are there.")
    assert any("worn by nobody" in one for one in shown.not_shown)
