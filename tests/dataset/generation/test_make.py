"""Shards: the same bytes whoever makes them, resumed after anything, one bad sample harms none."""

import io
import json
import shutil
import time
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest
from tests.dataset.conftest import CARS
from tests.dataset.generation.small_sets import clips_recipe, digests, make

from texvent.dataset.generation import make_sample, make_shard
from texvent.dataset.generation.make import find_work
from texvent.dataset.generation.recipe import Recipe, load_recipe
from texvent.dataset.generation.shard_files import (
    FAILED,
    FILTERED,
    MADE,
    SampleRecord,
    TarShardWriter,
    read_members,
    read_record,
)
from texvent.dataset.specification.reading import specification_from
from texvent.dataset.stored.folder import StoredDataset
from texvent.dataset.stored.sample_files import events_of, npy_column
from texvent.dataset.verify import verify
from texvent.errors import ConfigError, FileFormatError, InputError, OutputError, warn
from texvent.events import EventStream
from texvent.generation import kept_frames
from texvent.runtime.work.engines import ProcessEngine
from texvent.runtime.work.side_work import begin_side_work
from texvent.settings import provenance
from texvent_scenes.raycast.incremental import IncrementalRenderer

SMALL = {"duration": 0.1, "sensor": "32x24", "interpolate": "none"}


def recipe_of(folder: Path = Path(), **changes: Any) -> Recipe:
    return Recipe.of(specification_from({**CARS, **changes}, folder=folder))


@pytest.mark.long
def test_processes_and_parts_make_the_bytes_of_one_process(tmp_path):
    recipe = recipe_of(store_videos=True, options={**SMALL, "samples": 1})
    make(recipe, tmp_path / "one")
    make(recipe, tmp_path / "pool", ProcessEngine(2))
    for part in (1, 2, 3):
        make(load_recipe(tmp_path / "pool"), tmp_path / "parts", part=(part, 3))
    one, pool, parts = (digests(tmp_path / name) for name in ("one", "pool", "parts"))
    assert one == pool == parts
    assert len(one) == 6


def test_simulations_of_a_shaken_photo_see_the_same_film(tmp_path):
    image = np.random.default_rng(1).integers(0, 255, (24, 32), np.uint8)
    cv2.imwrite(str(tmp_path / "a.png"), image)
    recipe = recipe_of(
        tmp_path,
        sources=[{"videos": ["*.png"]}],
        options={"camera": "shake", "duration": 0.1, "sensor": "16x12", "noise": "none"},
        splits={"train": 1.0},
        variants={"paper": {"seeds": 2, "preset": "paper"}},
    )
    begun = time.perf_counter()
    make(recipe, tmp_path / "out")
    (shard,) = StoredDataset.open(tmp_path / "out").shards()
    assert 0 < shard.record.seconds < time.perf_counter() - begun
    first, second = (shard.files(sample).events() for sample in shard.samples)
    assert first.metadata["seed"] != second.metadata["seed"]
    assert len(first) > 50
    assert first.equals(second)


def test_the_videos_of_variants_are_the_same_and_simulations_differ(cars):
    records = {name: read_record(cars / name / "train-000000.tar") for name in ("paper", "esim")}
    paper, esim = (record.samples for record in records.values() if record is not None)
    assert [one.clip for one in paper[::2]] == [one.clip for one in esim]
    assert paper[0].seed == esim[0].seed != paper[1].seed

    def facts(name: str, number: int) -> Any:
        record = records[name]
        assert record is not None
        shard = cars / name / "train-000000.tar"
        return json.loads(read_members(shard, record.samples[number].members)["json"])

    first, second = facts("paper", 0), facts("paper", 1)
    assert first["source"] == second["source"] == facts("esim", 0)["source"]
    assert first["seed"] != second["seed"]
    thresholds = {facts("esim", n)["settings"]["simulate"]["contrast_threshold_on"] for n in (0, 1)}
    assert len(thresholds) == 2


@pytest.mark.long
@pytest.mark.parametrize("most_bytes", [40_000, kept_frames.MOST_BYTES])
def test_variants_that_share_frames_are_what_each_is_alone(tmp_path, monkeypatch, most_bytes):
    monkeypatch.setattr(kept_frames, "MOST_BYTES", most_bytes)
    rendered, render = [], IncrementalRenderer.render

    def count(self: IncrementalRenderer, time_s: float) -> Any:
        rendered.append((self._size, time_s))
        return render(self, time_s)

    monkeypatch.setattr(IncrementalRenderer, "render", count)
    variants = {
        "still": {"interpolate": "none", "simulator": "esim"},
        "dense": {"fixed_count": 3, "seeds": 2},
        "sparse": {"max_intermediate": 1, "simulator": "v2e"},
        "small": {"sensor": "16x12"},
    }
    few = {"sources": [{"prompts": ["a red car drives left"]}], "splits": {"train": 1.0},
           "truth": ["boxes", "flow"], "options": {**SMALL, "interpolate": "motion"}}  # fmt: skip
    make(recipe_of(**few, variants=variants), tmp_path / "all")
    if most_bytes > 40_000:
        assert len(rendered) == len(set(rendered)) > 0
    for name, options in variants.items():
        make(recipe_of(**few, variants={name: options}), tmp_path / name)
        for shard, alone in digests(tmp_path / name).items():
            assert digests(tmp_path / "all")[shard] == alone


def test_another_specification_is_refused_with_the_difference(cars):
    with pytest.raises(ConfigError, match="seed was 3, is 4"):
        recipe_of(seed=4).begin(cars)
    other = [{"prompts": ["a dog"], "label": "dog"}]
    with pytest.raises(ConfigError, match="1 prompts or videos more, 3 fewer"):
        recipe_of(sources=other, splits={"train": 1.0}).begin(cars)


def test_a_folder_of_other_things_and_a_changed_list_are_refused(cars, tmp_path):
    (tmp_path / "note.txt").write_text("mine")
    with pytest.raises(OutputError, match="holds no data set"):
        recipe_of().begin(tmp_path)
    folder = tmp_path / "cars"
    shutil.copytree(cars, folder)
    items = folder / "items.jsonl"
    items.write_text(items.read_text().replace("red", "black"))
    with pytest.raises(FileFormatError, match="changed by hand"):
        load_recipe(folder)
    note = folder / "specification.json"
    note.write_text(note.read_text().replace('"seed"', '"sead"'))
    with pytest.raises(FileFormatError, match=r"specification\.json is damaged"):
        load_recipe(folder)


def test_one_bad_video_harms_no_other_and_is_made_later(tmp_path):
    clip = np.zeros((6, 24, 32), np.uint8)
    clip[:, 4:12, 4:12] = np.arange(6, dtype=np.uint8)[:, None, None] * 40
    for name in ("a", "c"):
        np.save(tmp_path / f"{name}.npy", clip)
    (tmp_path / "b.npy").write_bytes(b"no array")
    np.save(tmp_path / "still.npy", np.zeros_like(clip))
    recipe = recipe_of(
        tmp_path,
        sources=[{"videos": "*.npy", "label": "{name}"}],
        options={"fps": 30},
        splits={"train": 1.0},
        samples_per_shard=4,
    )
    folder = tmp_path / "out"
    work = make(recipe, folder)
    assert not work.failures
    assert {(one[MADE], one[FILTERED], one[FAILED]) for one in work.complete.values()} == {
        (4, 2, 2),  # a still video has the noise of the sensor, and no signal
        (2, 1, 1),
    }
    (record,) = (one.record for one in StoredDataset.open(folder).shards("esim"))
    reasons = {one.status: one.reason or "" for one in record.samples}
    assert "b.npy" in reasons[FAILED]
    assert reasons[FILTERED] == "fewer than 1 signal events"
    np.save(tmp_path / "b.npy", clip)
    assert not find_work(recipe, folder).todo
    work = make(recipe, folder, retry_failed=True)
    after = {shard.variant: counts for shard, counts in work.complete.items()}
    assert after["esim"][MADE] == 3
    assert not find_work(recipe, folder, retry_failed=True).todo  # nothing failed
    whole = tmp_path / "again"
    make(recipe, whole)
    assert digests(whole) == digests(folder)
    assert verify(StoredDataset.open(folder)).is_sound


def test_a_video_that_cannot_be_read_has_no_state_and_stops_nothing(tmp_path, monkeypatch):
    def refuse(*_: Any) -> str:
        raise PermissionError

    clip = tmp_path / "v.npy"
    clip.touch()
    monkeypatch.setattr(provenance, "_file_fingerprint", refuse)
    assert provenance.describe_state(clip) is None
    assert not provenance.is_replaced(clip, {"seen": "", "contents": ""})


def test_videos_of_folders_of_one_name_are_told_apart(tmp_path):
    for number, name in enumerate(("a/x", "b/x", "c/x")):
        (tmp_path / name).mkdir(parents=True)
        np.save(tmp_path / name / "v.npy", np.full((4, 12, 16), number % 2 * 80, np.uint8))
    tables = {"name": "n", "sources": [{"videos": ["*/x/v.npy"]}], "options": {"fps": 30}}
    recipe = Recipe.of(specification_from(tables, folder=tmp_path))
    assert [Path(one.video or "").parts[-3] for one in recipe.items.all] == ["a", "b"]
    assert recipe.items.duplicates == 1


@pytest.mark.parametrize("kept", ["all", "noise"])
def test_events_of_noise_save_no_sample_from_the_filter(tmp_path, kept):
    clip = np.zeros((12, 24, 32), np.uint8)
    np.save(tmp_path / "still.npy", clip)
    clip[:, 4:16, 4:16] = np.arange(12, dtype=np.uint8)[:, None, None] * 20
    np.save(tmp_path / "brighter.npy", clip)
    recipe = recipe_of(
        tmp_path,
        sources=[{"videos": "*.npy", "label": "{name}"}],
        options={"fps": 30, "simulator": "v2e", "shot_noise_rate_hz": 20.0, "keep_events": kept},
        splits={"train": 1.0},
        filters={},
        variants={"v2e": {}},
    )
    make(recipe, tmp_path / "out")
    (shard,) = StoredDataset.open(tmp_path / "out").shards()
    made, still = sorted(shard.record.samples, key=lambda one: one.label or "")
    assert (made.status, still.status) == (MADE, FILTERED)
    assert still.reason == "fewer than 200 signal events"
    assert still.signal_events < 100
    assert made.signal_events >= 200
    assert made.events > made.signal_events if kept == "all" else made.events > 100


def test_stored_videos_serve_every_variant(tmp_path):
    few = {"sources": [{"prompts": ["a red car drives left"]}], "splits": {"train": 1.0},
           "store_videos": True}  # fmt: skip
    folder = tmp_path / "out"
    make(recipe_of(**few), folder)
    record = read_record(folder / "videos" / "train-000000.tar")
    assert record is not None
    assert set(record.samples[0].members) == {"avi", "txt"}
    assert (record.samples[0].width, record.samples[0].height) == (346, 260)  # of its generator
    esim = read_record(folder / "esim" / "train-000000.tar")
    assert esim is not None
    assert (esim.samples[0].width, esim.samples[0].height) == (32, 24)
    assert esim.samples[0].clip == record.samples[0].key


@pytest.mark.parametrize("start_us", [-5, 0, 2**32 - 10, 2**40])
@pytest.mark.parametrize("last_us", [20, 2**33])
def test_events_keep_their_times_wherever_a_clip_begins(start_us, last_us):
    times = [start_us, start_us + 7, start_us + last_us]
    events = EventStream.from_columns([1, 2, 3], [0] * 3, times, [0, 1, 1], size=(8, 6))
    clip = make_sample.SimulatedClip(events, start_us, last_us, 3)
    members = make_sample.sample_members(clip, {}, class_number=None, preview=True)
    columns = {name: npy_column(memoryview(members[f"{name}.npy"])) for name in "xytp"}
    assert events_of(columns, events.size).t.tolist() == times


def test_options_that_would_change_the_video_belong_to_all():
    with pytest.raises(ConfigError, match="variant long sets duration, which changes the video"):
        recipe_of(variants={"long": {"duration": 3.0}})
    with pytest.raises(ConfigError, match="unknown option 'durration'"):
        recipe_of(options={"durration": 3.0})
    with pytest.raises(ConfigError, match="contrast_threshold is -1"):
        recipe_of(options={"contrast_threshold": {"uniform": [-1, 0.3]}})
    with pytest.raises(ConfigError, match="cannot be called videos"):
        recipe_of(variants={"videos": {}})


def test_a_record_of_before_never_stands_beside_the_new_file(tmp_path):
    recipe = clips_recipe(tmp_path, clips=8, samples_per_shard=8, variants={"esim": {}})
    bad = tmp_path / "clips" / "0.npy"
    good = bad.read_bytes()
    bad.write_bytes(b"no array")
    folder = tmp_path / "out"
    (counts,) = make(recipe, folder).complete.values()
    assert counts[FAILED] == 1
    bad.write_bytes(good)
    (task,) = find_work(recipe, folder, retry_failed=True).todo
    shard = folder / task.units[0].path
    with pytest.MonkeyPatch.context() as patch:

        def killed(*words: object) -> None:
            raise KeyboardInterrupt

        patch.setattr(make_shard, "write_record", killed)
        with pytest.raises(KeyboardInterrupt):
            make_shard.make_together(recipe, folder, task.units, retry_failed=True)
    assert shard.exists()
    assert not shard.with_suffix(".json").exists()
    assert len(find_work(recipe, folder).todo) == 1
    make(recipe, folder)
    make(recipe, tmp_path / "wanted")
    assert digests(folder) == digests(tmp_path / "wanted")


@pytest.mark.parametrize("error", [None, InputError("no video")])
def test_a_sample_has_the_warnings_of_work_beside_it(error):
    def beside() -> None:
        time.sleep(0.1)
        warn("not kept")

    def make_one() -> tuple[dict[str, bytes], dict[str, Any]]:
        begin_side_work("video", beside)
        if error:
            raise error
        return {}, {}

    record = SampleRecord(key="a", clip="a", status=MADE, seed=0)
    made = make_shard._made(record, make_one, TarShardWriter(io.BytesIO()))
    assert made.warnings == ("not kept",)
