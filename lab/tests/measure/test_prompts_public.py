"""Public prompts are drawn by digest: subjects in one half only, the same ones every time."""

from __future__ import annotations

import json
import sys
from pathlib import Path

import pytest

from texvent_lab.measure.prompts import public
from texvent_lab.measure.prompts.__main__ import main
from texvent_lab.measure.prompts.sheet import read_prompts

SUBJECTS = [f"a thing of number {number}" for number in range(400)]


def write_sources(folder: Path, count: int = 400) -> list[str]:
    """Three files of the right form; returns the options that name them."""
    styled = [f"{one}, {style}" for one in SUBJECTS[:count] for style in ("in oil", "zoom in")]
    long = [f"{one} moves {'slowly ' * 20}along" for one in SUBJECTS[:count]]
    folder.joinpath("vbench.txt").write_text("\n".join(styled))
    folder.joinpath("moviegen.txt").write_text(
        "\n".join(["a short one", "a pleasant stroll " * 9, *long])
    )
    captions = {"annotations": [{"caption": f" {one}\n"} for one in SUBJECTS[:count]]}
    folder.joinpath("coco.json").write_text(json.dumps(captions))
    names = {"--vbench": "vbench.txt", "--moviegen": "moviegen.txt", "--coco": "coco.json"}
    return [part for option, name in names.items() for part in (option, str(folder / name))]


def run(monkeypatch: pytest.MonkeyPatch, *words: str) -> int:
    monkeypatch.setattr(sys, "argv", ["texvent_lab.measure.prompts", *words])
    return main()


def test_draws_share_no_subject(tmp_path, monkeypatch, capsys):
    out = tmp_path / "out"
    assert run(monkeypatch, "public", *write_sources(tmp_path), "-o", str(out)) == 0
    draws = {name: read_prompts(out / f"{name}.csv") for name in public.DRAWS}
    for rows in draws.values():
        assert [row.style for row in rows] == [
            style for style in public.STYLES for _ in range(public.PER_DRAW)
        ]
    ids = [row.id for rows in draws.values() for row in rows]
    assert len(set(ids)) == len(ids)
    for style in public.STYLES:
        subjects = [
            {public.subject_of(row.prompt) for row in rows if row.style == style}
            for rows in draws.values()
        ]
        assert len(set.union(*subjects)) == sum(len(one) for one in subjects)
    assert "0 of them those that were graded" in capsys.readouterr().out
    assert not any("stroll" in row.prompt for rows in draws.values() for row in rows)


def test_the_order_of_the_lines_does_not_matter():
    drawn = public.draw(SUBJECTS, "short", "test")
    assert drawn == public.draw(SUBJECTS[::-1] * 2, "short", "test")
    assert drawn[0].id == "V41"
