"""The table of fields on the page of scene files has every field of every class."""

import dataclasses
import re
import sys
from pathlib import Path

import pytest

from texvent_scenes.models.places import PLACES

ROOT = Path(__file__).parents[2]


@pytest.fixture
def made(monkeypatch: pytest.MonkeyPatch) -> str:
    monkeypatch.syspath_prepend(str(ROOT / "docs" / "site"))
    import scene_fields  # type: ignore[import-not-found, unused-ignore]

    page = (ROOT / "docs" / "scenes.md").read_text(encoding="utf-8")
    assert page == scene_fields.with_tables(page), "run python docs/site/scene_fields.py"
    for owner in scene_fields.TABLES.values():
        assert all(f"| `{one.name}` |" in page for one in dataclasses.fields(owner))
    del sys.modules["scene_fields"]
    return page


def test_rows_have_ranges_words_and_texts(made: str) -> None:
    assert "| `frequency_hz` | number, 0.001 to 100000 | Frequency of modulation, Hz;" in made
    assert "| `weather` | fog, haze, rain, snow | Weather; left out: fair. |" in made
    assert "| `position_m` | 3 numbers | Position x, y, z, m. |" in made


def test_the_page_has_the_width_of_a_lane_of_each_road(made: str) -> None:
    line = made.split("(and the report): of a ")[1].splitlines()[0]
    found = {
        name: float(metres) for name, metres in re.findall(r"([a-z]+ ?[a-z]*) ([\d.]+) m", line)
    }
    assert found == {name: one.road_m for name, one in PLACES.items() if one.has_road}
