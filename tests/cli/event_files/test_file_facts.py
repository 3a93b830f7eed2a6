"""Options that say how an event file is to be read, in every command; figures of `info`."""

import dataclasses
import itertools
import json
from itertools import product
from pathlib import Path

import h5py
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.cli.running import run

from texvent.cli.event_files.event_file_options import FileFactOptions
from texvent.cli.event_files.info import describe_events, shortened
from texvent.event_packets import EventPackets
from texvent.events import EventStream
from texvent.sensor import SensorSize

COMMANDS = {
    "info": "info {} --json",
    "validate": "validate {} --json",
    "convert": "convert {} o.csv",
    "render": "render {} -o o.png",
    "view": "view {} -o o.html",
}
OTHERWISE = {"convert --format": "--from-format"}
"""Where another option has the usual name."""


def write_files(folder: Path, events: EventStream) -> None:
    columns = np.stack([events.t, events.x, events.y, events.p], axis=1)
    rows = ["t,x,y,p", *(",".join(map(str, row)) for row in columns.tolist())]
    (folder / "plain.csv").write_text("\n".join(rows))
    (folder / "plain.dat").write_text("\n".join(rows))
    (folder / "repair.csv").write_text("\n".join([*rows, "9999999,x"]))
    (folder / "unit.csv").write_text("\n".join(rows).replace("000,", ","))
    odd = [",".join(map(str, row)) for row in columns[:, [2, 1, 0, 3]].tolist()]
    (folder / "order.csv").write_text("\n".join(odd))
    with h5py.File(folder / "several.h5", "w") as file:
        for group, shift in (("left", 0), ("right", 1)):
            for name, column in zip("txyp", columns.T, strict=True):
                file[f"{group}/{name}"] = np.roll(column, shift if name == "p" else 0)


STATED = {
    "sensor": ("plain.csv", ""),
    "time_unit": ("unit.csv", "--time-unit ms"),
    "columns": ("order.csv", "--columns y,x,t,p"),
    "stream": ("several.h5", "--stream left"),
    "repair": ("repair.csv", "--repair"),
    "format": ("plain.dat", "--format csv"),
}
"""Option → a file that cannot be read rightly without it, and its words."""


def test_every_option_of_every_command_is_tried():
    assert {one.name for one in dataclasses.fields(FileFactOptions)} <= STATED.keys()


@pytest.mark.parametrize(
    ("command", "option"),
    # A page tells of repairs.
    sorted({*product(COMMANDS, STATED)} - {("view", "repair")}),
)
def test_a_file_read_as_is_stated_is_the_usual_one(command, option, tmp_path, monkeypatch, capsys):
    random = np.random.default_rng(1)
    count = np.arange(60)
    t, p = np.sort(random.integers(1, 900, 60)) * 1000, random.integers(0, 2, 60)
    events = EventStream.from_columns(count % 16, count % 11, t, p, size=(16, 12))

    def outcome(file: str, words: str) -> tuple[object, ...]:
        folder = tmp_path / f"{len([*tmp_path.iterdir()])}"
        folder.mkdir()
        monkeypatch.chdir(folder)
        write_files(folder, events)
        Path(file).rename(name := Path("e").with_suffix(Path(file).suffix))
        code = run(*COMMANDS[command].format(name).split(), *words.split())
        said = capsys.readouterr().out.replace(str(name), "e.csv")
        files = [one.read_text("latin-1") for one in folder.glob("o.*") if one.suffix != ".json"]
        facts = json.loads(said) if said.startswith("{") else {"said": said}
        facts = {key: one for key, one in facts.items() if key not in ("repair", "checksums")}
        return code, facts, [one.replace(str(name), "e.csv") for one in files]

    file, words = STATED[option]
    words = words.replace("--format", OTHERWISE.get(f"{command} --format", "--format"))
    usual, stated = outcome("plain.csv", "--sensor 16x12"), outcome(file, f"{words} --sensor 16x12")
    assert usual[0] == 0
    assert stated == usual
    if (command, option) != ("validate", "time_unit"):  # which judges no times
        assert outcome(file, "" if option == "sensor" else "--sensor 16x12") != stated


@pytest.mark.parametrize("first_us", [-500_000, 0, 700])
@pytest.mark.parametrize("cuts", [(), (1, 60), (99,)])
def test_the_figures_are_those_of_all_packets_together(first_us, cuts):
    t = first_us + np.arange(100) * 20_000
    events = EventStream.from_columns(t * 0, t * 0, t, t * 0 + 1, size=SensorSize(4, 3))
    edges = (0, *cuts, 100)
    packets = (events[a:b] for a, b in itertools.pairwise(edges))
    facts = describe_events(EventPackets(packets, events.size, {}))
    assert (facts["events"], facts["on_share"]) == (100, 1.0)
    assert (facts["first_us"], facts["last_us"]) == (first_us, first_us + 1_980_000)
    assert (facts["seconds"], facts["events_per_second"]) == (1.98, 51)


def test_what_lies_beside_the_events_is_counted_to_the_end(tmp_path, capsys):
    rows = np.stack([np.full(600_000, 1 << 10), np.arange(600_000)], axis=1)  # signals of a DAVIS
    (tmp_path / "e.aedat").write_bytes(b"#!AER-DAT2.0\r\n" + rows.astype(">u4").tobytes())
    assert run("info", tmp_path / "e.aedat", "--sensor", "346x260", "--json") == 0
    assert json.loads(capsys.readouterr().out)["triggers"] == 600_000


@given(text=st.text(max_size=40), most=st.none() | st.integers(8, 30))
def test_of_a_long_value_beginning_and_end_are_shown(text, most):
    shown = shortened(text, most)
    if most is None or len(text) <= most:
        assert shown == text
    else:
        begin, end = shown.split("...", 1) if "..." not in text else (shown[: most // 2], "")
        assert len(shown) == most
        assert text.startswith(begin)
        assert text.endswith(end)
        assert len(begin) == most // 2
