"""Prompts for grading: strips, sums of grades."""

import csv
import json
import sys

import cv2
import pytest

from texvent_lab.measure.prompts import score
from texvent_lab.measure.prompts.__main__ import main
from texvent_lab.measure.prompts.score import Share

GRADES = """id,style,nouns_asked,nouns_shown,motion,silently_wrong,fully_right,fully_reported,stand_in,grade,remark
a,short,2,2,yes,no,yes,no,no,5,
b,short,3,1,partly,yes,no,no,no,2,no dog
c,long,1,0,no,0,0,1,1,0,
d,long,2,2,none,,1,,,4,
"""  # noqa: E501  # a row of a table


def run(monkeypatch: pytest.MonkeyPatch, *words: object) -> int:
    monkeypatch.setattr(sys, "argv", ["texvent_lab.measure.prompts", *map(str, words)])
    return main()


def test_a_share_has_wilsons_interval():
    # Worked by hand: p = 1/2, n = 4, z² = 3.8415: middle 1/2, half-width .5 sqrt(z²/(4+z²)) = .35.
    low, high = Share(2, 4).interval
    assert (low, high) == pytest.approx((0.15, 0.85), abs=0.001)
    assert Share(0, 10).interval[0] == pytest.approx(0.0)
    assert Share(10, 10).interval[1] == pytest.approx(1.0)


def test_a_sheet_of_grades_is_summed(tmp_path, capsys, monkeypatch):
    (tmp_path / "g.csv").write_text(GRADES)
    sums = score.sum_grades(score.read_grades(tmp_path / "g.csv"))
    assert sums["nouns shown"] == Share(5, 8)
    assert sums["motion right"] == Share(1, 3)
    assert sums["motion right or partly"] == Share(2, 3)
    assert sums["silently wrong"] == Share(1, 4)
    assert sums["fully right or fully reported"] == Share(3, 4)
    assert sums["stand-in"] == Share(1, 4)
    assert sums["mean grade"] == 2.75
    assert run(monkeypatch, "score", tmp_path / "g.csv") == 0
    assert "|  | all | short | long |" in capsys.readouterr().out


def test_strips_are_drawn_with_the_report(tmp_path, monkeypatch, capsys):
    rows = [["id", "style", "prompt"], ["a1", "short", "a red ball bounces next to a wug"],
            ["a2", "short", "qwerty zxcv"]]  # fmt: skip
    with (tmp_path / "p.csv").open("w", newline="") as file:
        csv.writer(file).writerows(rows)
    words = ("sheet", tmp_path / "p.csv", "-o", tmp_path / "out")
    assert run(monkeypatch, *words) == 0
    assert "1/2  a1: drawn" in capsys.readouterr().out
    drawn, refused = json.loads((tmp_path / "out" / "reports.json").read_text())["prompts"]
    assert "next to a wug" in drawn["report"]["not_understood"]
    assert "nothing in the prompt was understood" in refused["error"]
    strip = cv2.imread(str(tmp_path / "out" / "strips" / "a1.png"))
    assert strip.shape[1] == 6 * 173 + 5 * 2
    assert strip[:130].std() > 5
    assert (tmp_path / "out" / "contact-01.png").is_file()
    blank = (tmp_path / "out" / "grades.csv").read_text().splitlines()
    assert blank[:2] == [GRADES.splitlines()[0], "a1,short,,,,,,,,,"]
    (tmp_path / "p.csv").write_text("id,prompt\n../a,a dog\n")
    assert run(monkeypatch, *words) == 2
    assert "line 2: id is '../a'" in capsys.readouterr().err
