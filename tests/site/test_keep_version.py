"""Several versions of the documentation site in one folder."""

import json
import subprocess
import sys
from pathlib import Path

import pytest

import texvent

ROOT = Path(__file__).parents[2]


def keep(html: Path, public: Path) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, str(ROOT / "docs/site/keep_version.py"), str(html), str(public)]
    return subprocess.run(command, capture_output=True, text=True, check=False)


@pytest.fixture
def html(tmp_path: Path) -> Path:
    folder = tmp_path / "html"
    (folder / "site").mkdir(parents=True)
    (folder / "index.html").write_text("new")
    (folder / "site/versions.html").write_text("versions")
    return folder


def test_earlier_versions_stay_and_this_one_is_replaced(html, tmp_path):
    public = tmp_path / "public"
    for version in ("0.0.9", texvent.__version__):
        (public / version).mkdir(parents=True)
        (public / version / "index.html").write_text(f"old {version}")
    (public / "versions.json").write_text(json.dumps(["0.0.9", texvent.__version__]))

    done = keep(html, public)

    assert done.returncode == 0, done.stderr
    assert json.loads((public / "versions.json").read_text()) == [texvent.__version__, "0.0.9"]
    assert (public / "0.0.9/index.html").read_text() == "old 0.0.9"
    assert (public / texvent.__version__ / "index.html").read_text() == "new"
    assert (public / texvent.__version__ / "site/versions.html").exists()
    assert f"url={texvent.__version__}/index.html" in (public / "index.html").read_text()


def test_a_folder_without_a_site_is_refused_and_nothing_is_written(tmp_path):
    done = keep(tmp_path, tmp_path / "public")
    assert done.returncode == 1
    assert "holds no index.html; run make docs first" in done.stderr
    assert not (tmp_path / "public").exists()
