"""Messages of commands name flags, those of Python name arguments and methods."""

import numpy as np
import pytest
from tests.video_check.made_clips import pan

import texvent
from texvent.cli.app import main
from texvent.cli.wording import flags_in_messages, in_flags, name_flags
from texvent.config import CaptureConfig, RunConfig
from texvent.errors import InputError, in_keywords


@pytest.mark.parametrize(
    ("python", "flags"),
    [
        ("give white_level=1 if 1 is white", "give --white-level 1 if 1 is white"),
        ("lower target_rate, or label_noise=False", "lower --target-rate, or --no-label-noise"),
        ("seed is -1; a seed is 0 or more", "--seed is -1; a seed is 0 or more"),
        ("without_label() drops it", "--no-label-noise drops it"),
        ("size='davis346', or size=", "--sensor davis346, or --sensor"),
        ("'white_level=1' is no time_window", "'white_level=1' is no time_window"),
        ("config file a.toml: white_level is 0", "config file a.toml: white_level is 0"),
    ],
)
def test_what_python_calls_by_name_is_a_flag_of_the_command(python, flags):
    with flags_in_messages():
        name_flags([RunConfig(), CaptureConfig()])
        assert in_flags(python) == str(InputError(python)) == flags
        assert in_flags(flags) == flags
    assert str(InputError(python)) == python


@pytest.mark.parametrize(
    ("flags", "python"),
    [
        ("give --fps 25, or --timestamps FILE", "give fps=25, or timestamps=FILE"),
        ("check --camera (a smaller --sensor)", "check `camera` (a smaller `sensor`)"),
        ("run texvent info a.h5 --all", "run texvent info a.h5 --all"),
        ("'--fps' and /a--b/c", "'--fps' and /a--b/c"),
    ],
)
def test_flags_are_keywords_in_python(flags, python):
    assert in_keywords(flags) == in_keywords(python) == python


def test_one_error_has_two_readers(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    frames = (pan(4) / 255).astype(np.float32)
    with pytest.raises(InputError, match="Give white_level=1 if"):
        texvent.simulate(frames, fps=25)
    np.save("clip.npy", frames)
    assert main(["simulate", "clip.npy", "--fps", "25", "-o", "a.h5"]) == 2
    assert "Give --white-level 1 if" in capsys.readouterr().err


def test_what_a_config_file_sets_is_named_with_its_file(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "a.toml").write_text("white_level = 0\n")
    assert main(["simulate", "clip.mp4", "--config", "a.toml"]) == 2
    assert "config file a.toml: white_level is 0; it must be" in capsys.readouterr().err


def test_a_run_says_by_its_flag_that_a_format_has_no_place_for_labels(
    tmp_path, monkeypatch, capsys
):
    monkeypatch.chdir(tmp_path)
    words = ["generate", "a red ball bounces", "--sensor", "32x24", "--duration", "0.1"]
    assert main([*words, "--label-noise", "-q", "-o", "a.txt"]) == 0
    assert capsys.readouterr().err.count("--no-label-noise silences this") == 1
    assert texvent.load("a.txt").label is None
