"""Stored samples: what was written comes back by number, from any thread, process or copy."""

import json
import pickle
import subprocess
import sys
import tarfile
from concurrent.futures import ThreadPoolExecutor
from contextlib import nullcontext
from itertools import combinations
from pathlib import Path

import numpy as np
import pytest
from tests.dataset.stored.written_set import LABELS, SIZE, random_events, write_set, write_shard

import texvent.dataset
from texvent.dataset.stored.sample_files import SampleFiles
from texvent.dataset.stored.stored_samples import StoredSamples
from texvent.errors import FileFormatError, InputError
from texvent.events import EventStream


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("set") / "cars"


@pytest.fixture(scope="module")
def written(folder: Path) -> dict[str, EventStream]:
    return write_set(folder)


@pytest.fixture
def samples(folder: Path, written: dict[str, EventStream]) -> StoredSamples:
    return texvent.dataset.open(folder)


def test_every_sample_comes_back_with_all_that_is_known(samples, written):
    assert len(samples) == len(written) == 24
    assert samples.labels == ("bus", "car", "dog")
    for number, (key, events) in enumerate(written.items()):
        sample = samples[number]
        assert sample.events.equals(events)
        assert samples.events(number).equals(events)
        assert sample.key == key
        assert sample.label == LABELS[number % 3 % 2]
        assert sample.class_number == number % 3 % 2
        assert sample.caption == f"a {sample.label} drives left"
        assert sample.facts["key"] == key == sample.events.metadata["key"]
        assert (sample.variant, sample.split) == (
            ("esim", "paper")[number // 12],
            ("test", "train")[number // 6 % 2],
        )
    assert [sample.key for sample in samples] == list(written)
    assert samples[-1].key == list(written)[-1]


def test_members_are_the_files_of_the_tar(samples, folder):
    with tarfile.open(folder / "esim" / "test-000000.tar") as tar:
        files = {one.name.partition(".")[2]: tar.extractfile(one).read() for one in list(tar)[:7]}
    assert samples.members(0) == files
    assert set(files) == {"x.npy", "y.npy", "t.npy", "p.npy", "json", "txt", "cls"}
    assert samples.members(0, ("txt",)) == {"txt": b"a bus drives left"}


def test_filters_choose_variant_split_and_label(folder, written):
    def keys(**chosen):
        return [sample.key for sample in texvent.dataset.open(folder, **chosen)]

    every = list(written)
    assert keys(variant="paper") == every[12:]
    assert keys(split=["train"]) == every[6:12] + every[18:]
    assert keys(variant="esim", split="test", label="car") == [every[1], every[4]]
    assert keys(variant=("esim", "paper"), label=("bus", "car")) == every
    # The number of a class does not depend on what is chosen.
    assert texvent.dataset.open(folder, label="car")[0].class_number == 1


@pytest.mark.parametrize(("outside", "inside"), [(24, 23), (-25, -24)])
def test_numbers_of_samples_end(samples, written, outside, inside):
    with pytest.raises(IndexError, match=rf"^sample {outside} does not exist; there are 24$"):
        samples[outside]
    assert samples[inside].key == list(written)[inside]


def test_slices_longer_than_a_sample_are_refused_at_once(folder, written):
    with pytest.raises(InputError, match=r"24 of 24 samples are shorter than a slice of 10,001 µs"):
        texvent.dataset.open(folder, slice_us=10_001)
    with pytest.raises(InputError, match=r"shorter than a slice of 41 events.*index\.events >= 41"):
        texvent.dataset.open(folder, slice_events=41)


def test_arrays_come_with_the_facts_of_their_sample(samples, written):
    plain = samples.make(5)
    assert plain["events"].equals(list(written.values())[5])
    facts = {name: plain[name] for name in ("class_number", "caption", "key", "number", "seed")}
    assert facts == {
        "class_number": 0, "caption": "a bus drives left", "key": "k005", "number": 5, "seed": 2
    }  # fmt: skip


def test_a_clip_that_kept_the_times_of_a_longer_video_begins_where_it_was_cut(tmp_path):
    events = random_events(1, start_us=5_000_000)
    write_shard(tmp_path, "paper", "train", 0, {"late": events}, start_us=5_000_000)
    made = texvent.dataset.open(tmp_path, slice_us=5000).make(0)
    assert made["stop_us"].tolist() == [5_005_000, 5_010_000]


def test_shards_come_in_the_order_of_their_numbers(tmp_path):
    for number in (1_000_000, 999_999):
        write_shard(tmp_path, "paper", "train", number, {f"k{number}": random_events(number)})
    assert [one.key for one in texvent.dataset.open(tmp_path)] == ["k999999", "k1000000"]


def test_odd_columns_are_read_too(tmp_path):
    """Times above 2³² µs are stored as int64; streams may have no event or a label."""
    plain = random_events(3, start_us=2**33)
    labelled = EventStream(
        plain.x, plain.y, plain.t, plain.p, SIZE, {}, np.arange(len(plain), dtype=np.uint8) % 2
    )
    streams = {"long": plain, "none": EventStream.empty(SIZE), "labelled": labelled}
    write_shard(tmp_path, "paper", "train", 0, streams, labels=())
    samples = texvent.dataset.open(tmp_path)
    for number, events in enumerate(streams.values()):
        assert samples[number].events.equals(events)
    assert samples[0].label is None
    assert samples.make(0)["class_number"] == -1


def test_select_takes_numbers_and_masks(samples, written):
    every = list(written)
    assert [sample.key for sample in samples.select([7, 0, 7])] == [every[7], every[0], every[7]]
    mask = samples.index.seed == 1
    assert [sample.key for sample in samples.select(mask)] == every[1::3]


def read_keys(samples: StoredSamples) -> list[tuple[str, int]]:
    return [(sample.key, int(sample.events.t.sum())) for sample in samples]


def test_copies_and_threads_read_the_same(samples):
    expected = read_keys(samples)
    assert read_keys(pickle.loads(pickle.dumps(samples))) == expected
    with ThreadPoolExecutor(4) as threads:
        assert list(threads.map(lambda _: read_keys(samples), range(8))) == [expected] * 8


def test_a_published_folder_loads_and_a_shard_without_a_record_does_not_count(tmp_path):
    write_set(tmp_path)
    (tmp_path / "paper" / "train-000001.json").unlink()  # still being made
    (tmp_path / "paper" / "notes.json").write_text("{}")
    (tmp_path / "videos").mkdir()
    (tmp_path / "videos" / "train-000000.json").write_text("{}")
    samples = texvent.dataset.open(tmp_path)
    assert len(samples) == 21
    assert samples.labels == (*LABELS, "dog")


def test_missing_and_changed_files_give_one_line(tmp_path):
    with pytest.raises(InputError, match="holds no data set of texvent"):
        texvent.dataset.open(tmp_path / "none")
    with pytest.raises(InputError, match="holds no data set of texvent"):
        texvent.dataset.open(tmp_path)
    write_set(tmp_path)
    samples = texvent.dataset.open(tmp_path)
    shard = tmp_path / "paper" / "train-000001.tar"
    content = shard.read_bytes()
    shard.write_bytes(content[:2000])
    with pytest.raises(FileFormatError, match=r"train-000001.tar has 2,000 bytes and its record"):
        texvent.dataset.open(tmp_path)
    with pytest.raises(FileFormatError, match=r"train-000001.tar is shorter than its record says"):
        samples.events(23)
    shard.unlink()
    with pytest.raises(FileFormatError, match=r"cannot read .*train-000001.tar.*verify"):
        texvent.dataset.open(tmp_path)
    with pytest.raises(FileFormatError, match=r"cannot read .*train-000001.tar"):
        pickle.loads(pickle.dumps(samples)).events(23)
    (tmp_path / "paper" / "train-000000.json").write_text("{")
    with pytest.raises(FileFormatError, match=r"train-000000\.json is damaged"):
        texvent.dataset.open(tmp_path, variant="paper")
    (tmp_path / "specification.json").write_text("[]")
    with pytest.raises(FileFormatError, match=r"specification\.json is damaged"):
        texvent.dataset.open(tmp_path, variant="esim")


@pytest.mark.parametrize(
    ("name", "offset", "value", "message"),
    [
        ("x.npy", 128, b"\xff\xff", r"sample k000 of .*test-000000.tar is damaged: x runs from"),
        ("t.npy", 128, b"\xff\xff\xff\xff", "time decreases"),
        ("p.npy", 128, b"\x02", "p runs from"),
        ("y.npy", 0, b"none", "not a .npy column"),
        ("x.npy", 60, b"9", "damaged"),
        ("x.npy", 61, b"41", r"tar is damaged: not a \.npy column \(buffer is smaller"),
        ("x.npy", 22, b"f", r"tar is damaged: not a \.npy column of integers; run"),
        ("json", 0, b"[", r"sample k000 of .*tar is damaged \(Expecting"),
        ("json", 0, b"[]".ljust(400), "tar is damaged: its facts are no table; run tex"),
    ],
)
def test_damaged_columns_are_named_with_their_sample(tmp_path, name, offset, value, message):
    write_set(tmp_path)
    path = tmp_path / "esim" / "test-000000.tar"
    places = json.loads(path.with_suffix(".json").read_text())["samples"][1]["members"]
    with path.open("r+b") as file:
        file.seek(places[name][0] + offset)
        file.write(value)
    with pytest.raises(FileFormatError, match=message):
        texvent.dataset.open(tmp_path)[0].facts  # noqa: B018


RECORD, NOTE = "esim/test-000000.json", "specification.json"


@pytest.mark.parametrize(
    ("name", "change", "message"),
    [
        (RECORD, b'{"name": "\xe4"}', r"json is damaged \('utf-8' codec can't decode byte 0xe4 in"),
        (RECORD, {"name": "train-000000"}, "'train-000000' is no shard of split 'test'"),
        (RECORD, {"name": "test-000001"}, r"0\.tar belongs to another data set; run"),
        (RECORD, {"versions": {"numpy": 2}}, r"json is damaged \(versions are texts\)"),
        (RECORD, {"versions": {"numpy": "2"}}, None),
        (NOTE, {"labels": ["bus", "dog"]}, "class 'car' of a sample is none of its labels"),
        (NOTE, {"labels": ["car", "bus"]}, None),
    ],
)
def test_records_that_say_other_things_are_named(tmp_path, name, change, message):
    write_set(tmp_path)
    path = tmp_path / name
    changed = {**json.loads(path.read_text()), **(change if isinstance(change, dict) else {})}
    path.write_bytes(change if isinstance(change, bytes) else json.dumps(changed).encode())
    with pytest.raises(FileFormatError, match=message) if message else nullcontext():
        assert texvent.dataset.open(tmp_path).make(0)["class_number"] in (0, 1)


def test_a_sample_that_lacks_columns_is_damaged(folder, written):
    path = folder / "esim" / "test-000000.tar"
    places = json.loads(path.with_suffix(".json").read_text())["samples"][1]["members"]
    for number in range(4):
        for kept in combinations(("x.npy", "y.npy", "t.npy", "p.npy"), number):
            sample = SampleFiles(path, "k000", {name: places[name] for name in kept}, SIZE)
            with pytest.raises(FileFormatError, match=r"k000 of .*tar is damaged: column . is mis"):
                sample.columns()


def test_opening_and_reading_loads_no_heavy_package(folder, written):
    code = (
        "import sys, texvent.dataset\n"
        f"samples = texvent.dataset.open({str(folder)!r}, representation='voxel-e2vid')\n"
        "samples[0], samples.make(0)\n"
        "print([name for name in ('torch', 'numba', 'cv2', 'av', 'h5py', 'pyarrow', 'tyro')"
        " if name in sys.modules])"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"
    assert done.stderr == ""  # also where files are open at the end of the process
