"""No input is overwritten, and a run that is stopped cleans up or keeps what it has."""

import errno
import os
import shutil
import signal
import struct
import sys
import threading
import time
from pathlib import Path
from subprocess import PIPE

import numpy as np
import pytest
from tests.cli.running import run

import texvent
from texvent.cli.app import main
from texvent.errors import OutputError
from texvent.io import block_writer
from texvent.io.hdf5.storage import Hdf5Writer

COMMAND = [sys.executable, "-m", "texvent.cli.app"]
SMALL = ("--sensor", "64x48", "--interpolate", "none", "--noise", "none")


@pytest.fixture(scope="module")
def video(tmp_path_factory):
    path = tmp_path_factory.mktemp("video") / "clip.avi"
    prompt = ("a red car drives left", "--duration", "0.3", "--sensor", "64x48", "--samples", "1")
    assert run("generate", *prompt, "--video-only", "-o", path) == 0
    return path


@pytest.fixture
def clip(folder, video):
    """A video, as users have it beside their work."""
    return Path(shutil.copy(video, "clip.avi"))


def contents(folder: Path) -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in folder.iterdir() if path.is_file()}


def test_previews_never_take_the_name_of_the_video(folder, clip, capsys):
    Path("clip.mp4").write_bytes(clip.read_bytes())
    before = Path("clip.mp4").read_bytes()
    assert run("simulate", "clip.mp4", "-o", "clip.h5", *SMALL) == 0
    assert run("simulate", "clip.mp4", "-o", "clip.h5", "--overwrite", *SMALL) == 0
    assert Path("clip.mp4").read_bytes() == before
    names = {"clip.avi", "clip.mp4", "clip.h5"}
    made = {f"clip.events.{kind}" for kind in ("mp4", "png", "html")}
    assert set(contents(folder)) == names | made


@pytest.mark.parametrize("spelling", ["./events.h5", "hard.h5", "soft.h5"])
@pytest.mark.parametrize(
    "words",
    [
        ("convert", "events.h5", "OUT", "--overwrite"),
        ("convert", "other.h5", "OUT", "--merge", "events.h5", "--overwrite"),
        ("simulate", "frames", "-o", "OUT", "--timestamps", "events.h5", "--overwrite"),
        ("generate", "a dog runs", "-o", "OUT", "--config", "events.h5", "--overwrite"),
    ],
    ids=["convert", "merge", "timestamps", "config"],
)
def test_no_command_writes_over_an_input(folder, capsys, words, spelling):
    stream = texvent.EventStream.from_columns([1], [1], [5], [1], size=(64, 48))
    stream.save("events.h5")
    stream.save("other.h5")
    os.link("events.h5", "hard.h5")
    os.symlink("events.h5", "soft.h5")
    Path("frames").mkdir()
    before = Path("events.h5").read_bytes()
    assert run(*(spelling if word == "OUT" else word for word in words)) != 0
    assert Path("events.h5").read_bytes() == before
    assert len(capsys.readouterr().err.strip().splitlines()) == 1


def test_an_output_that_is_an_input_is_named_even_in_a_dry_run(folder, clip, capsys):
    Path("clip.events.mp4").write_bytes(clip.read_bytes())
    for more in ((), ("--dry-run",)):
        words = ("simulate", "clip.events.mp4", "-o", "clip.h5", "--overwrite", *more)
        assert run(*words, *SMALL) == 3
        assert "it is the input clip.events.mp4, which is never replaced" in capsys.readouterr().err


def test_a_prompt_and_names_of_parts_are_no_paths(folder, capsys):
    """A folder may be called as the prompt, the palette or the simulator are."""
    for name in ("car", "paper", "v2e"):
        Path(name).mkdir()
        words = ("--dry-run", "--simulator", "v2e", "--duration", 0.1, "--sensor", "32x24")
        assert run("generate", "car", "-o", f"{name}/o.h5", *words) == 0


def test_a_sensor_file_is_an_input(folder, clip, capsys):
    Path("camera.toml").write_text("sensor = 3")
    words = ("-o", "camera.toml", "--format", "hdf5")
    assert run("simulate", clip, *words, "--overwrite", "--sensor", "camera.toml") != 0
    assert Path("camera.toml").read_text() == "sensor = 3"


def long_frames(path: Path, count: int = 20_000) -> None:
    """A video that takes minutes: memory-mapped noise."""
    frames = np.lib.format.open_memmap(path, mode="w+", dtype=np.uint8, shape=(count, 48, 64))
    frames[:64] = np.random.default_rng(0).integers(60, 200, (64, 48, 64), np.uint8)
    for start in range(64, count, 64):
        frames[start : start + 64] = frames[: min(64, count - start)]
    frames.flush()


def wait_for_parts(folder: Path, kilobytes: int = 200) -> None:
    deadline = time.monotonic() + 300
    while time.monotonic() < deadline:
        parts = list(folder.glob(".texvent-*.h5"))
        if parts and parts[0].stat().st_size > kilobytes * 1000:
            return
        time.sleep(0.02)
    pytest.fail("the run wrote no events")


@pytest.mark.long
def test_a_signal_leaves_nothing(folder, spawn):
    number = signal.SIGINT
    long_frames(folder / "long.npy")
    words = ("simulate", "long.npy", "--fps", "500", "-o", "out.h5", *SMALL)
    process = spawn([*COMMAND, *words], stderr=PIPE, text=True)
    wait_for_parts(folder)
    for _ in range(5):
        process.send_signal(number)
        time.sleep(0.01)
    _, said = process.communicate(timeout=300)
    assert process.returncode == 128 + number
    name = signal.Signals(number).name
    assert f"interrupted ({name}); nothing half-written was left behind" in said
    assert "Traceback" not in said
    assert [path.name for path in folder.iterdir()] == ["long.npy"]


@pytest.mark.long
def test_a_signal_keeps_what_is_done_if_that_was_asked_for(folder, spawn):
    number = signal.SIGTERM
    long_frames(folder / "long.npy")
    words = ("simulate", "long.npy", "--fps", "500", "-o", "out.h5", "--keep-partial", *SMALL)
    process = spawn([*COMMAND, *words], stderr=PIPE, text=True)
    wait_for_parts(folder)
    process.send_signal(number)
    _, said = process.communicate(timeout=300)
    assert process.returncode == 128 + number
    assert "the files end there (complete = false)" in said
    events = texvent.load("out.h5")
    facts = events.metadata
    assert (facts["complete"], facts["stopped_by"]) == (False, signal.Signals(number).name)
    assert 0 < facts["stopped_us"] < 40_000_000
    assert events.t[-1] < facts["stopped_us"]
    names = {"long.npy", "out.h5", *(f"out.events.{kind}" for kind in ("mp4", "png", "html"))}
    assert {path.name for path in folder.iterdir()} == names
    assert run("validate", "out.h5") == 0


def test_a_video_that_ends_in_damage_keeps_what_came_before_if_that_was_asked_for(
    folder, clip, capsys
):
    whole = clip.read_bytes()
    Path("cut.avi").write_bytes(whole[: len(whole) * 2 // 3])
    words = ("simulate", "cut.avi", "-o", "out.h5", "--previews", "none", *SMALL)
    assert run(*words) == 2
    assert not Path("out.h5").exists()
    assert run(*words, "--keep-partial") == 2
    events = texvent.load("out.h5")
    assert len(events)
    assert events.metadata["complete"] is False
    assert "cut.avi" in events.metadata["stopped_by"]


CLIP = Path(__file__).parents[1] / "clips" / "bigbuckbunny_excerpt.mp4"


def simulate(folder, *words):
    return main(["simulate", str(CLIP), "-o", str(folder / "out.h5"), "--stop", "0.5", *words])


def fail_in_a_thread(*_):
    assert threading.current_thread() is not threading.main_thread()
    raise OSError(errno.ENOSPC, "No space left on device")


@pytest.mark.parametrize("interpolate", ["none", "flow"])
def test_a_full_disk_stops_the_run_and_leaves_nothing(tmp_path, monkeypatch, capsys, interpolate):
    monkeypatch.setattr(block_writer, "BLOCK_EVENTS", 100)
    monkeypatch.setattr(Hdf5Writer, "_write_pending", lambda *_, final: fail_in_a_thread())
    assert simulate(tmp_path, "--interpolate", interpolate) == OutputError.exit_code
    said = capsys.readouterr()
    assert "the disk is full" in said.err.splitlines()[-1]
    assert said.out == ""
    assert not list(tmp_path.iterdir())
    assert not [one for one in threading.enumerate() if one.name.startswith("texvent-writer")]


def write_davis(folder: Path, *, has_frames: bool) -> None:
    """An AEDAT 2.0 file with a trigger and an event; AEDAT4 with an event and two frames."""
    chip = b"#!AER-DAT2.0\r\n# AEChip: davis.Davis346B\r\n"
    records = [(1 << 10 | 1 << 22, 6), (1 << 31 | 1 << 10, 7), (1 << 31 | 1 << 10, 9)]
    body = b"".join(struct.pack(">II", *one) for one in records)
    (folder / "davis.aedat").write_bytes(chip + body)
    if has_frames:
        dv = pytest.importorskip("dv_processing", reason="dv-processing has no wheel for this OS")
        config = dv.io.MonoCameraWriter.DAVISConfig("camera", (64, 48))
        writer = dv.io.MonoCameraWriter(str(folder / "clip.aedat4"), config)
        for t_us in (1_000, 41_000):
            writer.writeFrame(dv.Frame(t_us, np.zeros((48, 64), np.uint8)))
        events = dv.EventStore()
        events.push_back(2_000, 3, 2, True)
        writer.writeEvents(events)
        del writer


SEVERAL_OUTPUTS = {
    "convert": ("convert", "davis.aedat", "o.h5", "--triggers", "t.csv"),
    "split": ("convert", "davis.aedat", "parts", "--split", "cuts.txt", "--triggers", "t.csv"),
    "frames": ("convert", "clip.aedat4", "o.h5", "--frames", "images"),
    "simulate": ("simulate", "clip.avi", "-o", "o.h5", *SMALL),
    "truth": ("generate", "a red car drives left", "-o", "o.h5", "--truth", "flow", *SMALL,
              "--duration", "0.1"),
}  # fmt: skip


@pytest.mark.parametrize("name", SEVERAL_OUTPUTS)
def test_an_output_that_exists_is_refused_before_any_other_is_written(name, folder, clip, capsys):
    words = SEVERAL_OUTPUTS[name]
    write_davis(folder, has_frames=name == "frames")
    Path("cuts.txt").write_text("0\n0.000008\n1\n")
    before = {*folder.iterdir()}
    assert run(*words, "-q") == 0
    made = sorted({*folder.iterdir()} - before)
    assert len(made) > 1, "the command writes several"
    for kept in made:
        for other in {*made} - {kept}:
            shutil.rmtree(other) if other.is_dir() else other.unlink()
        held = contents(kept) if kept.is_dir() else kept.read_bytes()
        capsys.readouterr()
        assert run(*words, "-q") == 3
        (line,) = capsys.readouterr().err.splitlines()
        assert f"{kept.name} exists already" in line
        assert {*folder.iterdir()} == {*before, kept}
        assert held == (contents(kept) if kept.is_dir() else kept.read_bytes())
        assert run(*words, "-q", "--overwrite") == 0
        assert sorted({*folder.iterdir()} - before) == made
