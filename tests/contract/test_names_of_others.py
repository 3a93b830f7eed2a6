"""No text of a data set that somebody sent becomes a path outside the folder that was named."""

import contextlib
import itertools
import json
import shutil
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from tests.dataset.conftest import make_set
from tests.examples import one_of

import texvent.dataset
from texvent.cli.app import main
from texvent.dataset.export import LAYOUTS, export
from texvent.dataset.generation.shard_files import TarShardWriter, read_members, read_record
from texvent.dataset.preview import choose_samples, write_sample_page
from texvent.dataset.statistics import DatasetStatistics, counts_rows, summary_lines
from texvent.dataset.stored.folder import StoredDataset
from texvent.dataset.verify import verify
from texvent.errors import TexventError
from texvent.runtime.files.file_names import inside

Place = tuple[Any, ...]


@pytest.fixture(scope="module")
def received(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A data set of one sample with a class and boxes."""
    return make_set(
        tmp_path_factory.mktemp("sent") / "set",
        splits={"train": 1.0},
        sources=[{"prompts": ["a red car drives left"], "label": "car"}],
        options={"duration": 0.1, "sensor": "32x24", "interpolate": "none"},
        variants={"paper": {}},
        truth=["boxes"],
    )


def texts(value: Any, place: Place = ()) -> Iterator[Place]:
    """Places of all texts in a tree; of names, too."""
    if isinstance(value, str):
        yield place
    for name, one in value.items() if isinstance(value, dict) else enumerate(value or ()):
        if isinstance(value, dict):
            yield (*place, ("name", name))
        if not isinstance(value, str) and isinstance(one, str | dict | list):
            yield from texts(one, (*place, name))


def changed(value: Any, place: Place, text: str) -> Any:
    """The tree with another text at a place."""
    if not place:
        return text
    head, *rest = place
    if isinstance(head, tuple):
        return {text if name == head[1] else name: one for name, one in value.items()}
    pairs = value.items() if isinstance(value, dict) else enumerate(value)
    new = {name: changed(one, tuple(rest), text) if name == head else one for name, one in pairs}
    return new if isinstance(value, dict) else list(new.values())


def files_beside(root: Path, out: Path) -> dict[str, int]:
    """Path → time of change of all that is not in the output."""
    found = (path for path in root.rglob("*") if not path.is_relative_to(out))
    return {str(path): path.stat().st_mtime_ns for path in found if path.is_file()}


def use(folder: Path, out: Path) -> None:
    """Everything that a data set is used for; an error of texvent is an answer."""
    for layout in LAYOUTS:
        with contextlib.suppress(TexventError):
            export(StoredDataset.open(folder), layout, out / layout, classes=None)
    with contextlib.suppress(TexventError):
        verify(StoredDataset.open(folder))
    with contextlib.suppress(TexventError):
        statistics = DatasetStatistics.of(StoredDataset.open(folder))
        json.dumps(statistics.tables)
        assert [counts_rows(statistics), summary_lines(statistics.total)]
    with contextlib.suppress(TexventError):
        dataset = StoredDataset.open(folder)
        write_sample_page(dataset, choose_samples(dataset), out / "page.html", overwrite=True)
    with contextlib.suppress(TexventError):
        list(texvent.dataset.open(folder, representation="histogram"))


TEXTS = ("{abs}", "a/../../x", "x\ny", "", "\ud800")


@pytest.mark.long
@pytest.mark.parametrize(
    ("document", "chosen"),
    [
        ("specification.json", ["../../x"]),
        ("paper/train-000000.json", ["../../x"]),
        ("paper/train-000000.json", TEXTS),
    ],
)
def test_no_text_of_a_received_set_leaves_the_output(received, tmp_path, document, chosen):
    turns = itertools.cycle(one.replace("{abs}", str(tmp_path / "victim")) for one in chosen)
    folder = shutil.copytree(received, tmp_path / "sent/deep/set")
    (folder / "items.jsonl").unlink()
    for name in ("victim", "victim.txt", "victim_list.txt", "x", "x.txt"):
        (tmp_path / name).write_text("mine")
    path, out = folder / document, tmp_path / "a" / "b" / "out"
    tables = json.loads(path.read_text())
    places = itertools.islice(texts(tables), 0, None, one_of())
    for place, text in zip(places, turns, strict=False):
        path.write_text(json.dumps(changed(tables, place, text)))
        out.mkdir(parents=True)
        before = files_beside(tmp_path, out)
        use(folder, out)
        assert files_beside(tmp_path, out) == before, place
        shutil.rmtree(out)


def test_no_fact_of_a_sample_leaves_the_output(received, tmp_path):
    folder, out = shutil.copytree(received, tmp_path / "sent/set"), tmp_path / "a/out"
    shard = folder / "paper/train-000000.tar"
    record = read_record(shard)
    assert record is not None
    members = read_members(shard, record.samples[0].members)
    facts = json.loads(members["json"])
    for place in texts(facts):
        if len(place) == 1:
            facts = changed(facts, place, "../../x")
    with shard.open("r+b") as file:
        writer = TarShardWriter(file)
        places = writer.add("k", {**members, "json": json.dumps(facts).encode()})
        writer.close()
    tables = json.loads(shard.with_suffix(".json").read_text())
    tables["bytes"], tables["samples"][0]["members"] = shard.stat().st_size, places
    shard.with_suffix(".json").write_text(json.dumps(tables))
    out.mkdir(parents=True)
    before = files_beside(tmp_path, out)
    use(folder, out)
    assert files_beside(tmp_path, out) == before


def test_links_of_a_received_set_lead_nowhere(received, tmp_path, capsys):
    folder, elsewhere = tmp_path / "set", tmp_path / "elsewhere"
    shutil.copytree(received, folder)
    elsewhere.mkdir()
    (elsewhere / "page").write_text("mine")
    (folder / "samples.html").symlink_to(elsewhere / "page")
    assert main(["dataset", "sample", str(folder), "--overwrite"]) == 2
    assert "leads out of" in capsys.readouterr().err
    shutil.rmtree(folder / "paper")
    (folder / "paper").symlink_to(elsewhere)
    assert main(["dataset", "make", str(folder), "--workers", "1", "-q"]) == 2
    assert "leads out of" in capsys.readouterr().err
    assert [(one.name, one.read_text()) for one in elsewhere.iterdir()] == [("page", "mine")]


def test_a_list_replaces_only_what_the_export_wrote(received, tmp_path):
    out, dataset = tmp_path / "out", StoredDataset.open(received)
    export(dataset, "n-caltech101", out)
    export(dataset, "n-caltech101", out)
    (tmp_path / "mine.txt").write_text("mine")
    (out / "train.txt").unlink()
    (out / "train.txt").symlink_to(tmp_path / "mine.txt")
    with pytest.raises(TexventError, match="leads out of"):
        export(dataset, "n-caltech101", out)
    assert (tmp_path / "mine.txt").read_text() == "mine"


@pytest.mark.parametrize(
    "place",
    ["", ".", "..", "../x", "/x", "a/../x", "a//b", "x\ny", "x\0", "a\\b", " ", "x" * 256],
)
def test_names_that_leave_a_folder_are_refused(tmp_path, place):
    with pytest.raises(TexventError, match="no file"):
        inside(tmp_path, place)
    assert inside(tmp_path, "train/voilà 🦩.h5") == tmp_path / "train/voilà 🦩.h5"
