"""`texvent scenes`: nouns by family, assets first; an image of one; bad input in a line."""

from __future__ import annotations

import cv2
import pytest
from tests.scenes.assets.glb_bar import write_bar

from texvent.cli.app import main


def test_the_list_has_families_other_names_and_assets_first(tmp_path, capsys, monkeypatch) -> None:
    monkeypatch.setenv("COLUMNS", "160")
    write_bar(tmp_path / "magic_wand.glb")
    assert main(["scenes", "list", "--assets", str(tmp_path)]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines[1].split() == ["assets", "magic", "wand"]
    car = next(line for line in lines if line.startswith("vehicles") and " car " in line)
    assert "automobile" in car


def test_show_draws_views_side_by_side(tmp_path, capsys) -> None:
    path = tmp_path / "cube.png"
    assert main(["scenes", "show", "block", "-o", str(path), "--views", "2"]) == 0
    image = cv2.imread(str(path))
    assert image.shape[0] == 240
    assert image.shape[1] >= 640
    assert "cube: 0.8 x 0.8 x 0.8 m" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["draw"], "unknown action 'scenes draw'"),
        (["show", "saxofone", "-o", "x.png"], "did you mean 'saxophone'"),
        (["show", "car", "-o", "x.jpg"], "must end in .png"),
        (["show", "car"], "show needs --output"),
        (["show", "car", "-o", "x.png", "--views", "0"], "must be 1 to 12"),
        (["list", "--assets", "nowhere"], "does not exist"),
    ],
)
def test_bad_input_is_one_clear_line(words, message, capsys, tmp_path, monkeypatch) -> None:
    monkeypatch.chdir(tmp_path)
    assert main(["scenes", *words]) == 2
    error = capsys.readouterr().err
    assert message in error
    assert len(error.splitlines()) == 1
