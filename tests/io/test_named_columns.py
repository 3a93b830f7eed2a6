"""Units of time, polarity and labels of named columns are judged alike in every format of them."""

import itertools
import warnings
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

import h5py
import numpy as np
import pytest
from numpy.typing import NDArray

from texvent.errors import FileFormatError, TexventError, TexventWarning
from texvent.events import COLUMN_TYPES, ID_COLUMNS, EventStream
from texvent.io.files import load
from texvent.io.tables import SPELLINGS
from texvent.sensor import SensorSize

from .column_files import write_columns

SIZE = SensorSize(240, 180)
COUNT = 6000
RNG = np.random.default_rng(0)
X, Y, P = (RNG.integers(0, limit, COUNT) for limit in (240, 180, 2))
T = np.sort(RNG.integers(1000, 8_000_000, COUNT)) // 1000 * 1000


def pairs(*choices: Iterable[Any]) -> list[tuple[Any, ...]]:
    return list(itertools.product(*choices))


KINDS = ("npz", "rows.npy", "npy", "h5", "parquet", "csv", "txt")


@pytest.fixture(autouse=True)
def own_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)


def written(kind: str, **changed: Any) -> Path:
    """A file of the columns, of which some are changed, or None and left out."""
    columns = {"t": T, "x": X, "y": Y, "p": P, **changed}
    columns = {name: one for name, one in columns.items() if one is not None}
    return write_columns(Path(f"e.{kind}"), columns)


def found(path: Path, **options: Any) -> tuple[EventStream | str, list[str]]:
    """The events or the error of a file, and the warnings."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always", TexventWarning)
        try:
            events: EventStream | str = load(path, size=SIZE, **options)
        except TexventError as error:
            events = str(error)
    return events, [str(one.message) for one in caught]


def is_true(events: EventStream | str, times: NDArray[Any] = T) -> bool:
    return not isinstance(events, str) and all(
        np.array_equal(column, true)
        for column, true in zip(
            (events.t, events.x, events.y, events.p), (times, X, Y, P), strict=True
        )
    )


ZEROS = np.where(np.arange(COUNT) < 5000, 0, T)
TIMES: Mapping[str, tuple[NDArray[Any], NDArray[np.int64]]] = {
    "µs": (T, T),
    "s": (T / 1e6, T),
    "s that begin with one zero": (
        np.where(np.arange(COUNT) < 1, 0, T) / 1e6,
        T * (np.arange(COUNT) > 0),
    ),
    "s that begin with many zeros": (ZEROS / 1e6, ZEROS),
    "µs as float": (T.astype(float), T),
    "µs since 1970": (T + 17 * 10**14, T + 17 * 10**14),
    "s since 1970": (T / 1e6 + 17 * 10**8, T + 17 * 10**14),
}


@pytest.mark.parametrize(("kind", "times"), pairs(KINDS, TIMES))
def test_the_whole_file_says_the_unit(kind, times):
    stored, true = TIMES[times]
    if kind in ("txt", "csv") and times == "µs as float":
        stored = T  # as a text, 1000.0 is of s
    events, said = found(written(kind, t=stored))
    assert is_true(events, true), events
    assert said == []


DOUBTED: Mapping[str, tuple[NDArray[Any], str]] = {
    "ms": (T // 1000, "ms"),
    "s": (T // 1_000_000, "s"),
    "ms since 1970": (T // 1000 + 17 * 10**11, "ms"),
    "ms as float": (T / 1000 + 0.5, "ms"),
    "ns": (T * 1000, "ns"),
    "ns since 1970": ((T + 17 * 10**14) * 1000, "ns"),
}


@pytest.mark.parametrize(("kind", "times"), pairs(KINDS, DOUBTED))
def test_a_doubtful_unit_is_said_with_the_likely_one(kind, times):
    stored, unit = DOUBTED[times]
    if kind == "rows.npy" and times == "ns since 1970":
        stored = stored.astype(np.int64)
    path = written(kind, t=stored)
    events, said = found(path)
    assert f"--time-unit {unit}" in (events if isinstance(events, str) else " ".join(said))
    given, said = found(path, time_unit=unit)
    assert isinstance(given, EventStream)
    assert said == []


def test_short_and_small_recordings_are_not_doubted():
    few = {"t": T[:50] // 1000, "x": X[:50], "y": Y[:50], "p": P[:50]}
    for columns in (few, {"t": np.arange(COUNT) * 16, "x": X, "y": Y, "p": P}):
        for kind in KINDS:
            assert found(written(kind, **columns))[1] == []


def test_a_unit_given_against_the_stated_one_is_said():
    path = Path("e.npz")
    np.savez(path, t_us=T, x=X, y=Y, p=P)
    assert found(path, time_unit="us")[1] == []
    assert "states its times in us; they are read as ms" in found(path, time_unit="ms")[1][0]


@pytest.mark.parametrize(("kind", "unit"), pairs(("npz", "rows.npy"), (1e6, 1.0)))
def test_times_that_have_lost_the_microseconds_are_said(kind, unit):
    late = (T / unit * 4).astype(np.float32)
    others = {"x": np.float32(X), "y": np.float32(Y), "p": np.float32(P)}
    path = written(kind, t=late, **({} if kind == "npz" else others))
    assert "float32, which at the end keeps steps of" in found(path)[1][0]


def test_digits_that_a_text_leaves_out_are_said():
    Path("e.txt").write_text("".join(f"{t + 16 * 10**8:g} 1 1 1\n" for t in T))
    assert "write all their digits" in found(Path("e.txt"))[1][0]
    np.savetxt("e.txt", np.stack([T, X, Y, P], axis=1))
    events, said = found(Path("e.txt"))
    assert is_true(events)
    assert said == []


def test_numbers_with_fractions_far_behind_whole_ones_are_refused():
    times = np.arange(40_000) * 20.0
    times[12_345] += 0.5
    zeros = np.zeros(40_000, int)
    for kind in ("npz", "h5"):
        events, _ = found(written(kind, t=times, x=zeros, y=zeros, p=zeros))
        assert "some have fractions; give time_unit" in str(events)


CODES: Mapping[str, tuple[Any, Any]] = {
    **{"0/1": (0, 1), "-1/+1": (-1, 1), "0/255": (0, 255), "1/2": (1, 2)},
    **{"booleans": (False, True), "floats": (-1.0, 1.0)},
}
WORDS = {"ON": ("OFF", "ON"), "on": ("off", "on"), "+": ("-", "+"), "true": ("False", "True")}


def polarities(off: Any, on: Any) -> NDArray[Any]:
    return np.where(P == 1, on, off)


@pytest.mark.parametrize(
    ("kind", "code"),
    [
        *itertools.product(KINDS, CODES),
        *itertools.product(("npz", "npy", "csv", "txt"), WORDS),
    ],
)
def test_polarity_is_read_in_every_code(kind, code):
    events, said = found(written(kind, p=polarities(*{**CODES, **WORDS}[code])))
    assert is_true(events), events
    assert ["read as OFF and ON" in one for one in said] == [True] * (code == "1/2")


@pytest.mark.parametrize(("kind", "code"), pairs(KINDS, [(0, 2), (2, 2), (255, 255), (-1, 0)]))
def test_polarity_that_can_mean_two_things_is_refused(kind, code):
    options = {"columns": "t,x,y,p"} if kind == "rows.npy" else {}
    events, _ = found(written(kind, p=polarities(*code)), **options)
    assert "it must be 0/1, -1/+1, 0/255, 1/2" in str(events)


def test_a_code_that_shows_late_does_not_change_earlier_events():
    p = np.ones(40_000, int)
    p[12_345] = 2
    zeros = np.zeros(40_000, int)
    events, _ = found(written("h5", t=np.arange(40_000) * 20, x=zeros, y=zeros, p=p))
    assert "polarity holds 1, 2" in str(events)


@pytest.mark.parametrize("kind", ["npz", "npy", "csv"])
@pytest.mark.parametrize("name", ["on", "is_on", "polarity_on"])
def test_on_is_a_name_of_polarity(kind, name):
    assert is_true(found(written(kind, p=None, **{name: P == 1}))[0])


ID_KINDS = (None, np.uint16, np.int64, np.float32)
"""Types of a column of ids, of which one is ours; None: there is none."""


@pytest.mark.parametrize("kind", ["npz", "h5"])
@pytest.mark.parametrize("kinds", pairs(ID_KINDS, ID_KINDS))
def test_ids_count_only_together_and_in_their_own_types(kind, kinds):
    given = dict(zip(ID_COLUMNS, kinds, strict=True))
    columns = {name: np.full(COUNT, 3, one) for name, one in given.items() if one}
    events, _ = found(written(kind, **columns))
    assert is_true(events)
    ours = all(one == COLUMN_TYPES[name] for name, one in given.items())
    for name in ID_COLUMNS:
        assert (getattr(events, name) is not None) == ours


@pytest.mark.parametrize("label", [7, "cat", [7], np.full(COUNT, 7), np.arange(3)])
def test_a_label_of_the_sample_is_no_column(label):
    events, _ = found(written("npz", label=np.array(label)))
    assert is_true(events)
    assert isinstance(events, EventStream)
    assert events.label is None


def test_arrays_of_python_objects_are_read_by_nobody():
    assert is_true(found(written("npz", meta=np.array({"a": 1})))[0])
    events, _ = found(written("npz", x=X.astype(object)))
    assert "x is dtype('O')" in str(events)


def test_coordinates_beyond_a_sensor_given_wrongly_are_not_divided():
    for changed in ({"x": X + 1}, {"x": Y, "y": X}):
        assert " runs from " in str(found(written("npz", **changed))[0])
    assert "x runs from" in str(load_error(written("npz"), size=SensorSize(180, 240)))


def load_error(path: Path, **options: Any) -> FileFormatError:
    with pytest.raises(FileFormatError) as caught:
        load(path, **options)
    return caught.value


@pytest.mark.parametrize("holder", ["array", "attribute", "npz"])
@pytest.mark.parametrize(("unit", "offset"), [(1, 5_000_000), (1e6, 5), (1e6, 5.0)])
def test_an_offset_is_in_the_unit_of_the_times(holder, unit, offset):
    times = T if unit == 1 else T / unit
    if holder == "npz":
        path = written("npz", t=times, t_offset=np.array(offset))
    else:
        path = written("h5", t=times)
        with h5py.File(path, "r+") as file:
            (file if holder == "array" else file["events"].attrs)["t_offset"] = offset
    assert is_true(found(path)[0], T + 5_000_000)


@pytest.mark.parametrize("kind", ["npz", "h5"])
def test_a_column_that_is_one_row_is_read(kind):
    assert is_true(found(written(kind, t=T[None], x=X[None], y=Y[None], p=P[None]))[0])


@pytest.mark.parametrize("mark", [",", ";", " "])
@pytest.mark.parametrize("end", ["", ",", ";"])
@pytest.mark.parametrize("comment", ["", "# ", "% "])
def test_a_line_of_names_decides_in_a_comment_too(mark, end, comment):
    if end not in ("", mark):
        return
    rows = [comment + mark.join("pytx") + end]
    rows += [mark.join(map(str, row)) + end for row in zip(P, Y, T, X, strict=True)]
    Path("e.txt").write_text("\n".join(rows) + "\n")
    assert is_true(found(Path("e.txt"))[0])


@pytest.mark.parametrize("unit", ["us", "ms"])
def test_six_decimals_of_other_units_are_no_seconds(unit):
    times = T * 3 / {"us": 1, "ms": 1000}[unit]
    np.savetxt("e.txt", np.stack([times, X, Y, P], axis=1)[::8], fmt="%f")
    assert f"give time_unit (--time-unit {unit})" in str(found(Path("e.txt"))[0])


def test_arrays_behind_one_another_are_refused():
    with Path("e.npy").open("wb") as file:
        for rows in np.split(np.stack([T, X, Y, P], axis=1), 2):
            np.save(file, rows)
    assert "holds several arrays" in str(found(Path("e.npy"))[0])


@pytest.mark.parametrize("kind", ["npz", "npy", "h5"])
def test_space_that_nobody_wrote_is_left_out_by_repair(kind):
    path = written(
        kind, **{n: np.pad(c, (0, 300)) for n, c in zip("txyp", (T, X, Y, P), strict=True)}
    )
    assert is_true(found(path, repair=True)[0])


TEXTS = [
    ("decimal commas", "t;x;y;p\n0,5;1;1;1\n", "writes numbers with commas"),
    ("thousands", "t;x;y;p\n1,500;1;1;1\n", "writes numbers with commas"),
    ("UTF-16", "t,x,y,p\n1,1,1,1\n", "is text of UTF-16"),
    ("CR", "t,x,y,p\r1,1,1,1\r2,1,1,1\r", "ends its lines by CR alone"),
    ("twice", "t,x,y,p,t\n1,1,1,1,1\n", "has 2 columns 't'"),
]


@pytest.mark.parametrize(("name", "text", "message"), TEXTS)
def test_texts_that_mean_something_else_are_named(name, text, message):
    Path("e.csv").write_bytes(text.encode("utf-16" if name == "UTF-16" else "utf-8"))
    assert message in str(found(Path("e.csv"))[0])


def test_quotes_an_index_and_names_of_any_order_are_read():
    rows = list(zip(range(COUNT), P, T, Y, X, strict=True))
    Path("e.csv").write_text(
        '"","p","t","y","x"\n' + "".join('"{}","{}","{}","{}","{}"\n'.format(*row) for row in rows)
    )
    assert is_true(found(Path("e.csv"))[0])


@pytest.mark.parametrize("make", [h5py.SoftLink, None], ids=["soft", "hard"])
@pytest.mark.parametrize("part", ["columns", "group", "rows"])
def test_links_within_a_file_are_names_of_its_arrays(part, make):
    with h5py.File("e.h5", "w") as file:
        link = make or file.__getitem__
        if part == "rows":
            file["a/m"] = np.stack([T, X, Y, P], axis=1)
            file["events"] = link("/a/m")
        for name, one in {"t": T, "x": X, "y": Y, "p": P}.items() if part != "rows" else ():
            file[f"a/{name if part == 'group' else 'column_' + name}"] = one
            if part == "columns":
                file[f"events/{name}"] = link(f"/a/column_{name}")
        if part == "group":
            file["events"] = link("/a")
        file["nowhere"], file["round"] = h5py.SoftLink("/missing"), h5py.SoftLink("/round")
    assert load("e.h5", size=SIZE).t.tolist() == T.tolist()
    if make:
        assert load("e.h5", size=SIZE, stream="events").t.tolist() == T.tolist()


@pytest.mark.parametrize("holder", ["/", "/events", "/events/t"])
@pytest.mark.parametrize("name", ["unit", "units", "time_unit", "t_units", "Timestamp unit"])
@pytest.mark.parametrize("unit", ["ns", "Nanoseconds", b"ns"])
def test_an_attribute_states_the_unit(holder, name, unit):
    with h5py.File(written("h5", t=T * 1000), "a") as file:
        file[holder].attrs[name] = unit
    assert load("e.h5", size=SIZE).t.tolist() == T.tolist()


@pytest.mark.parametrize("order", ["tyxp", "ptxy", "xypt"])
@pytest.mark.parametrize("form", ["list", "bytes", "text", "commas", "pandas"])
def test_an_attribute_states_the_order_of_columns(order, form):
    values = {"t": T, "x": X, "y": Y, "p": P}
    with h5py.File("e.h5", "w") as file:
        name = "block0_values" if form == "pandas" else "events"
        file[name] = np.stack([values[name] for name in order], axis=1)
        file["block0_items"] = [*order] if form == "pandas" else [0]
        forms: dict[str, Any] = {"list": [*order], "bytes": order.encode(), "text": order}
        if form != "pandas":
            file[name].attrs["columns"] = forms.get(form, ", ".join(order))
    events = load("e.h5", size=SIZE)
    assert (events.x.tolist(), events.t.tolist()) == (X.tolist(), T.tolist())


@pytest.mark.parametrize("name", ["topic", "group", "unit"])
def test_options_that_do_not_exist_are_named(name):
    with pytest.raises(TexventError, match=f"without an option '{name}'; "):
        load(written("h5"), **{name: "events"})


@pytest.mark.parametrize("before", ["", "events_", "event_", "left_events_", "Davis_Event_"])
@pytest.mark.parametrize("after", ["", "_us", " [us]"])
def test_a_column_is_known_with_words_before_and_a_unit_behind(before, after):
    for spellings in itertools.zip_longest(*SPELLINGS.values()):
        names = [f"{before}{spelling or column}{after * (column == 't')}"
                 for column, spelling in zip(SPELLINGS, spellings, strict=True)]  # fmt: skip
        values = {"t": T, "x": X, "y": Y, "p": P}
        columns = {name: values[one] for name, one in zip(names, SPELLINGS, strict=True)}
        events, said = found(write_columns(Path("e.npz"), columns))
        assert is_true(events), (names, events)
        assert said == []


@pytest.mark.parametrize("column", SPELLINGS)
def test_of_two_names_of_a_column_the_shorter_one_counts(tmp_path, column):
    others = {name: np.array([0, 1]) for name in SPELLINGS if name != column}
    for first, second in itertools.permutations(SPELLINGS[column], 2):
        if len(first) != len(second):
            short = min(first, second, key=len)
            named = {name: np.array([0, int(name == short)]) for name in (first, second)}
            np.savez(tmp_path / "e.npz", **named, **others)
            assert getattr(load(tmp_path / "e.npz", size=SIZE), column).tolist() == [0, 1], named
