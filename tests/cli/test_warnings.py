"""What is hardly meant is said in a line that stands out, or refused; nothing of it is silent."""

import sys
from pathlib import Path

import cv2
import numpy as np
import pytest
from tests.cli.running import refused, run

import texvent

pytestmark = pytest.mark.usefixtures("folder")
SMALL = ["--sensor", "48x36", "--previews", "none"]


def warnings_of(capsys, *words):
    """The warnings of a command that must succeed."""
    capsys.readouterr()
    assert run(*words) == 0
    lines = capsys.readouterr().err.splitlines()
    return [line.removeprefix("warning  ") for line in lines if line.startswith("warning  ")]


def still_video(path):
    writer = cv2.VideoWriter(str(path), cv2.VideoWriter_fourcc(*"MJPG"), 25, (48, 36))
    for _ in range(5):
        writer.write(np.full((36, 48, 3), 128, np.uint8))
    writer.release()


def test_a_run_without_events_warns(capsys):
    still_video("still.avi")
    words = ["simulate", "still.avi", "-o", "a.h5", "--noise", "none", "--previews", "none", "-q"]
    assert "no events: the video stands still" in warnings_of(capsys, *words)[0]
    with pytest.warns(texvent.TexventWarning, match="see `texvent check VIDEO`"):
        assert len(texvent.simulate("still.avi", noise="none")) == 0


@pytest.mark.parametrize("no_color", [None, "", "1"])
@pytest.mark.parametrize("is_terminal", [True, False])
def test_colours_are_for_terminals_of_those_who_want_them(
    capsys, monkeypatch, no_color, is_terminal
):
    still_video("still.avi")
    monkeypatch.delenv("NO_COLOR", raising=False)
    if no_color is not None:
        monkeypatch.setenv("NO_COLOR", no_color)
    monkeypatch.setattr(sys.stderr, "isatty", lambda: is_terminal)
    words = ["simulate", "still.avi", "-o", "a.h5", "--noise", "none", "--previews", "none", "-q"]
    assert run(*words) == 0
    has_colours = "\x1b[" in capsys.readouterr().err
    assert has_colours == (is_terminal and no_color != "1")


def test_masks_of_0_and_1_are_not_said_to_stand_still_alone(capsys, folder):
    Path("masks").mkdir()
    for index in range(4):
        mask = np.zeros((12, 16), np.uint8)
        mask[2:6, index : index + 5] = 1
        cv2.imwrite(f"masks/{index}.png", mask)
    words = ["simulate", "masks", "--fps", "10", "-o", "a.h5", "--previews", "none", "-q"]
    assert "give --white-level 1 if they are masks of 0 and 1" in warnings_of(capsys, *words)[0]


@pytest.fixture
def recording(folder):
    t = np.arange(0, 400_001, 100)
    size = texvent.SensorSize(8, 6)
    return texvent.EventStream(t % 8, t % 6, t, t % 2, size).save("a.h5")


@pytest.mark.parametrize("source", ["a.h5", "a.csv"])
@pytest.mark.parametrize(("command", "out"), [("convert", ("b.h5",)), ("render", ("-o", "b.png"))])
def test_a_time_outside_of_the_recording_is_refused(capsys, recording, source, command, out):
    if source == "a.csv":
        texvent.load("a.h5").save(source)
    sensor = ("--sensor", "8x6")
    said = refused(capsys, command, source, *out, *sensor, "--time", "5,6")
    assert said == "no event from 5 to 6 s: the recording runs from 0 to 0.4 s"
    assert "is empty" in refused(capsys, command, source, *out, *sensor, "--time", "0.3,0.1")
    assert not Path(out[-1]).exists()


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["render", "page.html", "-o", "b.png"], "a page, made of an event file; give that"),
        (["simulate", "/dev/video99", "-o", "b.h5"], "no such camera: /dev/video99; there is"),
    ],
)
def test_a_file_of_another_kind_is_named_with_the_command_that_takes_it(
    capsys, folder, words, said
):
    Path("page.html").write_bytes(b"not read")
    assert said in refused(capsys, *words)


def test_a_preview_is_not_taken_for_a_source_without_a_word(capsys, recording):
    for name in ("demo.events.mp4", "slow.mp4"):
        assert run("render", "a.h5", "-o", name) == 0
        words = ["simulate", name, "-o", "b.h5", "--previews", "none", "--overwrite", "--stop", 0.1]
        said = warnings_of(capsys, *words)
        assert said[0].startswith(f"{name} is a preview that texvent drew of events")
    still_video("mine.mp4")
    assert not any("preview" in one for one in warnings_of(capsys, "info", "mine.mp4"))


def test_an_empty_recording_is_not_sound(capsys, folder):
    texvent.EventStream.empty("8x6").save("empty.h5")
    assert run("validate", "empty.h5") == 1
    said = capsys.readouterr()
    assert said.out.startswith("empty\n")
    assert said.err == "warning  empty.h5 is empty: it holds no event\n"


HOSTILE = "a red ball bounces past a \x1b[31mwug\x1b]0;t\x07 \u202egnp.exe über 🦩\nevents  9"


def test_texts_of_files_and_arguments_reach_the_terminal_written_out(capsys, folder):
    words = ("--duration", 0.1, "--previews", "none", "--sensor", "48x36", "--overwrite")
    assert run("generate", HOSTILE, "-o", "a.h5", *words) == 0
    assert run("info", "a.h5") == 0
    assert run("info", "a.h5", "--all") == 0
    assert run("info", "a.h5", "--json") == 0
    assert run("info", "no\x1b[31m\u202efile.h5") == 2
    assert run("generate", HOSTILE, "--print-config") == 0
    out, err = capsys.readouterr()
    for text in (out, err):
        assert not set(text) & set("\x1b\x07\u202e")
    assert r"\u001b[31mwug" in out
    assert "über 🦩" in out
    assert "not understood" in err
    # Of info twice; none of the prompt's second line.
    assert sum(line.startswith("events ") for line in out.splitlines()) == 2
