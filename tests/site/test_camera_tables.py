"""The tables on the page of cameras have every camera, and the source of each measured constant."""

import sys
from pathlib import Path

from texvent.simulation.physical.cameras import CAMERAS

ROOT = Path(__file__).parents[2]


def test_every_camera_has_a_column_and_every_measured_constant_a_source(monkeypatch):
    monkeypatch.syspath_prepend(str(ROOT / "docs" / "site"))
    import camera_tables  # type: ignore[import-not-found, unused-ignore]

    page: str = camera_tables.with_tables((ROOT / "docs/simulators/cameras.md").read_text("utf-8"))
    del sys.modules["camera_tables"]
    assert "| option | " + " | ".join(f"`{name}`" for name in CAMERAS) + " |" in page
    for name, camera in CAMERAS.items():
        assert all(f"| `{name}` | `{one.option}` |" in page for one in camera.constants)
    assert "<!--" not in page
