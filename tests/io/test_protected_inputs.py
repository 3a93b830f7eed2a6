"""No output replaces an input; `tests/cli/test_nothing_lost.py` spells it in other ways."""

from collections.abc import Iterator
from pathlib import Path

import pytest

from texvent.errors import OutputError
from texvent.io.atomic import check_output, check_output_folder, protect_inputs, protected_inputs


@pytest.fixture
def clip(tmp_path: Path) -> Iterator[Path]:
    clip = tmp_path / "clip.mp4"
    clip.write_bytes(b"video")
    with protected_inputs():
        protect_inputs([clip, tmp_path / "missing", "not a file\0"])
        yield clip


def test_nothing_is_put_among_the_files_of_an_input_folder(tmp_path: Path) -> None:
    frames = tmp_path / "frames"
    (frames / "events").mkdir(parents=True)
    with protected_inputs():
        protect_inputs([frames])
        with pytest.raises(OutputError, match="would lie among the files of the input"):
            check_output(frames / "out.png", overwrite=False)
        check_output(frames / "events" / "out.png", overwrite=False)
        check_output(frames / "out.h5", overwrite=False)


def test_a_folder_that_holds_an_input_is_not_replaced(tmp_path: Path) -> None:
    folder = tmp_path / "recording"
    folder.mkdir()
    (folder / "events.txt").write_text("0 1 1 1\n")
    with protected_inputs():
        protect_inputs([folder / "events.txt"])
        with pytest.raises(OutputError, match="it holds the input"):
            check_output_folder(folder, overwrite=True, is_own=lambda path: True)


def test_inputs_are_forgotten_with_their_command(clip: Path) -> None:
    with protected_inputs():
        check_output(clip, overwrite=True)


@pytest.mark.parametrize("name", ["a\0b.h5", "a" * 300 + ".h5"])
def test_a_name_that_no_file_can_have_is_refused_in_one_line(tmp_path: Path, name: str) -> None:
    with pytest.raises(OutputError, match=r"cannot write .* choose another name") as caught:
        check_output(tmp_path / name, overwrite=False)
    assert len(str(caught.value)) < 300
