"""`texvent convert`, `validate`, `info` and `view` as a user meets them."""

import json
import shutil
import webbrowser
from pathlib import Path

import numpy as np
import pytest
from tests.cli.running import refused, run

import texvent
from texvent.cli.event_files import compare
from texvent.events import EventStream
from texvent.io.files import load, save
from texvent.metrics.compare import load_metric
from texvent.metrics.controls import run_controls
from texvent.sensor import SensorSize

SIZE = SensorSize(346, 260)


@pytest.fixture
def recording(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> EventStream:
    """Events in `in.h5` of the current folder."""
    monkeypatch.chdir(tmp_path)
    rng = np.random.default_rng(4)
    count = 5000
    times = np.cumsum(rng.integers(1, 400, count)) + 10**15
    x, y = rng.integers(0, 346, count), rng.integers(0, 260, count)
    events = EventStream(x, y, times, rng.integers(0, 2, count), SIZE, {"seed": 7})
    save("in.h5", events)
    return events


def test_a_file_goes_through_every_format_and_comes_back(recording, capsys):
    assert run("convert", "in.h5", "zero.h5", "--from-zero") == 0
    assert capsys.readouterr().out == "zero.h5: 5,000 events, 346x260\n"
    zero = load("zero.h5")
    assert zero.metadata == {"seed": 7, "edits": [{"from_zero": True}]}
    names = ["a.aedat4", "d.csv", "e.zip", "f.bag", "g.mcap", "h.npz", "i.raw"]
    for before, after in zip(["zero.h5", *names], [*names, "last.h5"], strict=False):
        assert run("convert", before, after, "-q") == 0
    assert load("last.h5").equals(zero)
    assert load("last.h5").metadata == zero.metadata
    assert capsys.readouterr().out == ""


def test_edits_of_one_command_are_made_in_the_order_of_its_help(recording):
    """Given in another order, and one command after another."""
    words = {"filter": "refractory:period_us=500", "crop": "20,10,300,240", "resize": "150x96",
             "rotate": "90", "flip": "x", "from-zero": "", "time": "0.1,0.6"}  # fmt: skip
    given = [f"--{name}={value}" if value else f"--{name}" for name, value in words.items()]
    assert run("convert", "in.h5", "all.h5", "-q", *given[::-1]) == 0
    for number, word in enumerate(given):
        source = f"{number - 1}.h5" if number else "in.h5"
        assert run("convert", source, f"{number}.h5", "-q", word) == 0
    assert len(load("all.h5")) > 100
    assert load("all.h5").equals(load(f"{len(given) - 1}.h5"))


def test_each_file_is_compared_with_the_last_one_whose_controls_are_shown(
    recording, monkeypatch, capsys
):
    monkeypatch.setattr(compare, "CONTROLLED", ("count_ratio",))
    few = load("in.h5")[:3000]
    parts = {"one.h5": few[::2], "two.h5": few[1::3], "three.h5": few[::5]}
    for name, events in (*parts.items(), ("true.h5", few)):
        save(name, events)
    words = ("--metrics", "count_ratio,stpp", "--json")
    every = few.t[0] / 1e6, few.t[-1] / 1e6
    for span in (every, (every[0], sum(every) / 2)):
        time = ("--time", f"{span[0]:.6f},{span[1] + 1e-6:.6f}")
        capsys.readouterr()
        assert run("compare", *parts, "true.h5", *words, *time) == 0
        told = json.loads(capsys.readouterr().out)
        cut = {name: one.cut(round(span[0] * 1e6), round(span[1] * 1e6) + 1)
               for name, one in {**parts, "true.h5": few}.items()}  # fmt: skip
        assert told["reference"] == {"path": "true.h5", "events": len(cut["true.h5"])}
        for one, name in zip(told["candidates"], parts, strict=True):
            assert one["predicted"] == {"path": name, "events": len(cut[name])}
            expected = texvent.compare(cut[name], cut["true.h5"], ["count_ratio", "stpp"])
            assert one["scores"] == pytest.approx(expected)
        controls = run_controls(load_metric("count_ratio"), cut["true.h5"])
        assert told["controls"] == {"count_ratio": pytest.approx(controls)}


def test_a_file_is_not_merged_with_itself(recording, capsys):
    Path("link.h5").symlink_to("in.h5")
    words = ["in.h5", "two.h5", "--merge", "link.h5"]
    text = refused(capsys, "convert", *words)
    assert "link.h5 and in.h5 are the same file, whose events would be doubled" in text
    assert not Path("two.h5").exists()


def test_what_a_format_cannot_hold_is_refused_and_nothing_is_left(recording, capsys):
    assert "holds sensors up to 256x240" in refused(capsys, "convert", "in.h5", "x.bin")
    assert sorted(path.name for path in Path().iterdir()) == ["in.h5"]


def test_validate_gives_a_verdict_and_an_exit_code(recording, capsys):
    assert run("validate", "in.h5") == 0
    assert capsys.readouterr().out.startswith("sound\n")
    shutil.copy("in.h5", "copy.h5")
    run("convert", "in.h5", "twice.h5", "--merge", "copy.h5", "-q")
    assert run("validate", "twice.h5", "--json") == 1
    facts = json.loads(capsys.readouterr().out)
    assert facts["verdict"] == "suspicious"
    assert facts["duplicates"] == 5000
    Path("cut.h5").write_bytes(Path("in.h5").read_bytes()[:5000])
    assert "damaged" in refused(capsys, "validate", "cut.h5")
    Path("wild.csv").write_text("t,x,y,p\n5,1,1,1\n4,1,1,1\n")
    assert "time decreases" in refused(capsys, "validate", "wild.csv", "--sensor", "8x8")
    assert run("validate", "twice.h5", "-q") == 1
    assert capsys.readouterr().out == ""


@pytest.mark.parametrize(("name", "has_checksums"), [("out.raw", False), ("in.h5", True)])
def test_validate_says_whether_the_format_notices_damage(recording, capsys, name, has_checksums):
    run("convert", "in.h5", "out.raw", "--from-zero")
    capsys.readouterr()
    run("validate", name)
    said = capsys.readouterr().out
    assert ("the format cannot notice" in said) is not has_checksums


CLIP = Path(__file__).parents[2] / "clips" / "bigbuckbunny_excerpt.mp4"
SCENE = ["--duration", "0.2", "--fps", "10", "--sensor", "48x36", "--samples", "1"]


@pytest.fixture
def small(folder) -> Path:
    step = np.arange(500)
    size = SensorSize(32, 18)
    return EventStream(step % 32, step % 18, step * 400, step % 2, size).save(folder / "in.h5")


def test_view_opens_a_temporary_page(small, monkeypatch, tmp_path, capsys) -> None:
    opened: list[str] = []
    monkeypatch.setattr(webbrowser, "open", lambda url: opened.append(url) or True)
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    assert run("view", small) == 0
    page = Path(capsys.readouterr().out.strip())
    assert opened == [page.as_uri()]
    assert "Shows all 500 events." in page.read_text("utf-8")


def test_view_saves_a_page_with_the_video_beside_and_opens_nothing(small, monkeypatch) -> None:
    monkeypatch.setattr(webbrowser, "open", lambda url: pytest.fail("nothing was to be opened"))
    assert run("view", small, "-o", "page.html", "--video", CLIP, "--points", 100) == 0
    page = Path("page.html").read_text("utf-8")
    assert "Shows 100 of 500 events" in page
    assert page.count("data:image/jpeg") > 3


def test_a_scene_of_another_size_than_the_events_is_not_drawn_beside_them(folder):
    options = {"sensor": "16x12", "duration": 0.1, "interpolate": "none", "seed": 1}
    events = texvent.generate("a red ball bounces", **options)
    for size in ((16, 12), (32, 18)):
        placed = EventStream(events.x, events.y, events.t, events.p, SensorSize(*size))
        placed.with_metadata(events.metadata).save(f"{size[0]}.h5")
        assert run("view", f"{size[0]}.h5", "-o", f"{size[0]}.html") == 0
        assert ("image/jpeg" in Path(f"{size[0]}.html").read_text("utf-8")) == (size == (16, 12))
