"""The training stream: the same for any ranks, drawn per clip, true, bounded, patient."""

import gc
import itertools
import pickle
import re
import tempfile
import tomllib
from dataclasses import fields, replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from texvent.errors import ConfigError, InputError, TexventWarning
from texvent.events import EventStream as Events
from texvent.frames import Frame, Video
from texvent.represent.time_surface import time_surface
from texvent.represent.voxel_grid import voxel_e2vid
from texvent.sensor import SensorSize
from texvent.simulation.clips.physical import seed_of
from texvent.simulation.clips.pixels import ClipOutputs
from texvent.simulation.physical.simulator import PhysicalSimulator

from .written import HEIGHT, WIDTH, Sliding, write_folders

pytestmark = pytest.mark.torch
torch = pytest.importorskip("torch")

from texvent.training import Clip, ClipRanges, EventStream, PhysicalRanges  # noqa: E402
from texvent.training.cuts import CutPlan, cut_clip  # noqa: E402
from texvent.training.draws import RANGES, draw_clip, order_of_pass  # noqa: E402
from texvent.training.sources import read_clip  # noqa: E402

SMALL: dict[str, Any] = {"batch": 3, "frames": 4, "size": (16, 12)}
WIDE = ClipRanges(
    threshold=(0.1, 0.4), ratio=(1.0, 2.0), mismatch=(0.0, 0.1), noise=(0.0, 0.1),
    hot_fraction=(0.0, 0.1), hot_noise=(0.1, 0.5), refractory_us=(0, 20_000), speed=(1, 2),
)  # fmt: skip
PASSES = 6
"""Batches that are compared."""


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return write_folders(tmp_path_factory.mktemp("videos"))


@pytest.fixture(scope="module")
def batches(folder):
    """The first batches of a stream with everything drawn and made."""
    outputs = ("grids", "counts", "surfaces", "events")
    return take(EventStream(folder, randomize=WIDE, outputs=outputs, **SMALL), 10)


def take(stream: Any, count: int) -> list[Any]:
    return list(itertools.islice(stream, count))


def prints(batches: Any) -> dict[int, bytes]:
    """Number of each batch → all of its frames and grids."""
    return {
        one.number: one.frames.numpy().tobytes() + one.grids.numpy().tobytes() for one in batches
    }


@pytest.mark.parametrize(
    ("world", "workers", "pixels"),
    [(2, 0, "v2v"), (3, 0, "v2v"), (1, 2, "v2v"), (2, 2, "v2v"), (2, 0, "physical")],
)
def test_equal_seeds_give_equal_batches_on_any_ranks_and_workers(folder, world, workers, pixels):
    options = {**SMALL, "seed": 5, "randomize": pixels}
    expected = prints(take(EventStream(folder, **options), PASSES))
    assert len(set(expected.values())) == PASSES
    found: dict[int, bytes] = {}
    for rank in range(world):
        stream = EventStream(folder, rank=rank, world=world, **options)
        loader = torch.utils.data.DataLoader(
            stream, batch_size=None, num_workers=workers, collate_fn=lambda one: one
        )
        own = take(loader, PASSES // world)
        assert [one.number for one in own] == list(range(rank, PASSES, world))
        found |= prints(own)
    assert found == expected


@pytest.mark.parametrize(("before", "after"), [(1, 1), (2, 1), (1, 2), (2, 3)])
def test_a_stream_goes_on_where_its_state_was_saved(folder, before, after):
    expected = prints(take(EventStream(folder, **SMALL), 10))
    streams = [EventStream(folder, rank=r, world=before, **SMALL) for r in range(before)]
    found = prints(one for stream in streams for one in take(stream, 2))
    (state,) = {tuple(stream.state_dict().items()) for stream in streams}
    for rank in range(after):
        stream = EventStream(folder, rank=rank, world=after, **SMALL)
        stream.load_state_dict(dict(state))
        found |= prints(take(stream, 2))
    assert found == {number: expected[number] for number in range(2 * before + 2 * after)}


def test_a_second_loop_goes_on_after_the_first_and_so_does_a_copy(folder):
    stream = EventStream(folder, **SMALL)
    expected = prints(take(EventStream(folder, **SMALL), 3))
    found = prints(take(stream, 1))
    found |= prints(take(pickle.loads(pickle.dumps(stream)), 1))
    found |= prints(itertools.islice(stream, 1, 2))
    assert found == expected


@pytest.mark.parametrize("pixels", [WIDE, "recommended"], ids=["wide", "recommended"])
def test_a_batch_that_is_held_stays_as_it_was_when_the_next_ones_are_made(folder, pixels):
    outputs = ("grids", "counts", "surfaces", "events")
    held, expected = [], []
    for batch in itertools.islice(
        EventStream(folder, randomize=pixels, outputs=outputs, **SMALL), 9
    ):
        # Of some the whole batch, of others a view of one tensor alone.
        names = ("frames", "grids", "counts", "surfaces", "first")
        shown = (batch.number,) if batch.number % 2 else range(len(names))
        kept = [getattr(batch, names[at % len(names)])[1] for at in shown]
        held.append(kept)
        expected.append([one.clone() for one in kept])
        del batch, kept
    for kept, before in zip(held, expected, strict=True):
        assert all(torch.equal(one, other) for one, other in zip(kept, before, strict=True))
    assert len({one.tobytes() for one in (kept[0].numpy() for kept in held)}) > 5


def test_memory_of_batches_that_are_let_go_of_is_used_again(folder):
    stream = EventStream(folder, **SMALL)
    places = {batch.grids.data_ptr() for batch in itertools.islice(stream, 12)}
    assert len(places) == 2  # the next batch is made while the loop holds the last one


def test_arrays_are_the_representations_of_the_events_of_the_batch(batches):
    for batch in batches[:2]:
        for clip, events in enumerate(batch.events):
            edges = batch.times_us[clip].tolist()
            stream = events.as_columns()
            for window, (start, stop) in enumerate(itertools.pairwise(edges)):
                inside = (stream.t >= start) & (stream.t < stop)
                part = type(events).unchecked(
                    *(getattr(events, name)[inside] for name in "xytp"), size=events.size
                )
                assert torch.equal(batch.grids[clip, window], voxel_e2vid(part, bins=5))
                assert int(batch.counts[clip, window].sum()) == len(part)
                expected = time_surface(part, at_us=stop)
                assert torch.allclose(batch.surfaces[clip, window], expected)


def test_every_range_is_drawn_from_for_each_clip(batches):
    drawn = {
        name: np.concatenate([batch.draws[name] for batch in batches]) for name in batches[0].draws
    }
    for name in ("mismatch", "noise", "hot_fraction", "hot_noise", "refractory_us"):
        low, high = getattr(WIDE, name)
        assert len(np.unique(drawn[name])) == len(drawn[name]), name
        assert low <= drawn[name].min() < low + 0.2 * (high - low), name
        assert high >= drawn[name].max() > high - 0.2 * (high - low), name
    on, off = drawn["threshold_on"], drawn["threshold_off"]
    ratio = np.maximum(on, off) / np.minimum(on, off)
    assert np.minimum(on, off).min() >= 0.1
    assert np.minimum(on, off).max() <= 0.4
    assert 1.0 <= ratio.min() < 1.3
    assert 1.7 < ratio.max() <= 2.0
    assert (on > off).any()
    assert (on < off).any()
    assert set(drawn["speed"]) == {1, 2}
    assert set(drawn["is_flipped"]) == {False, True}
    for name in ("start", "top", "left"):
        assert len(np.unique(drawn[name])) > 3, name
    # As many of each source, to within the pass that has begun.
    assert np.ptp(np.bincount(drawn["source"])) <= 1


@pytest.mark.parametrize("per", [1, 2])
def test_physical_clips_are_the_models_own_events_of_what_was_drawn(per):
    """Bit for bit those of the simulator, whose kernels are tested against NumPy."""
    ranges = PhysicalRanges(hot_fraction=(0.0, 0.1), noise_scale=(0.5, 50.0), pause=(0.0, 0.0))
    small = {**SMALL, "frames": 4 // per, "frames_per_grid": per}
    stream = EventStream(
        Sliding(), randomize=ranges, outputs=("grids", "counts", "events"), seed=7, **small
    )
    plan = CutPlan(SensorSize(16, 12), 4, per, ranges, ())
    seen = 0
    for batch in take(stream, 2):
        for clip, events in enumerate(batch.events):
            number = batch.number * SMALL["batch"] + clip
            draw = draw_clip(ranges, 7, number, 4)
            film = Sliding().read(int(batch.draws["source"][clip]), (), 2**30)
            cut = cut_clip(film, draw, plan, np.empty((len(draw.is_paused) + 1, 12, 16), np.uint8))
            simulator = PhysicalSimulator(ranges.config(draw.numbers), seed=seed_of(draw.key))
            pairs = zip(cut.frames, cut.times_us.tolist(), strict=True)
            expected = Events.concat(
                [simulator.step(Frame(np.ascontiguousarray(one), t_us)) for one, t_us in pairs]
            )
            found = events.as_columns()
            for name in "xytp":
                assert np.array_equal(getattr(found, name), getattr(expected, name)), name
            assert int(batch.counts[clip].sum()) == len(expected) > 0
            edges = batch.times_us[clip].tolist()
            for window, (start, stop) in enumerate(itertools.pairwise(edges)):
                part = voxel_e2vid(expected.cut(start, stop), bins=5)
                assert np.array_equal(batch.grids[clip, window], part)
            assert batch.draws["threshold_on"][clip] == draw.numbers[0]
            seen += len(expected)
    assert seen > 1000


def test_thresholds_that_the_pixel_model_refuses_are_refused_at_once():
    ranges = PhysicalRanges(threshold=(0.2, 2.5), ratio=(1.0, 10.0))
    highest = np.array([2.5, 25.0, *(getattr(ranges, name)[1] for name in ranges.drawn)])
    assert ranges.config(highest).contrast_threshold == pytest.approx(2.5 * 10**0.5)
    assert PhysicalRanges(threshold=(0.2, 10.0), ratio=(1.0, 1.0)).threshold == (0.2, 10.0)
    with pytest.raises(
        ConfigError, match=r"^threshold is .* would reach 12\.2, and 10 is the most"
    ):
        PhysicalRanges(threshold=(0.2, 10.0))


def test_every_physical_range_is_drawn_from_for_each_clip(folder):
    ranges = PhysicalRanges()
    batches = take(EventStream(folder, randomize="physical", outputs="counts", **SMALL), 10)
    for name in ranges.drawn:
        drawn = np.concatenate([batch.draws[name] for batch in batches])
        low, high = getattr(ranges, name)
        assert len(np.unique(drawn)) == len(drawn), name
        assert low <= drawn.min() < low + 0.2 * (high - low), name
        assert high >= drawn.max() > high - 0.2 * (high - low), name


def test_each_physical_option_reaches_the_events():
    quiet = {
        "threshold": (0.2, 0.2), "ratio": (1, 1), "noise_scale": (0, 0), "leak_rate_hz": (0, 0),
        "refractory_us": (0, 0), "cutoff_hz": (0, 0), "pause": (0, 0), "flip": 0,
        "has_phase": False, "mismatch": (0, 0), "hot_fraction": (0, 0),
    }  # fmt: skip

    def counts(source, **other):
        ranges = PhysicalRanges(**{**quiet, **other})
        stream = EventStream(source, randomize=ranges, outputs="counts", **SMALL)
        return take(stream, 1)[0].counts.sum(dim=(0, 1, 3, 4)).tolist()

    still, moving = Still(), Sliding()
    assert counts(still) == [0, 0]
    off, on = counts(still, leak_rate_hz=(1000, 1000))
    assert (off, on > 100) == (0, True)
    assert min(counts(still, noise_scale=(1000, 1000))) > 50
    assert min(counts(still, hot_fraction=(1, 1))) > 50
    whole = sum(counts(moving))
    for name, value in {"threshold": 0.4, "refractory_us": 5000, "cutoff_hz": 20}.items():
        assert sum(counts(moving, **{name: (value, value)})) < 0.8 * whole, name
    assert counts(moving, ratio=(2, 2)) != counts(moving)
    assert counts(moving, mismatch=(0.1, 0.1)) != counts(moving)
    assert counts(Flickering()) == [0, 0]
    assert sum(counts(Flickering(), has_phase=True)) > 50


class Still(Sliding):
    """A texture at rest, for long enough that rates show."""

    def read(self, index, truth, most_bytes):
        clip = super().read(index, (), most_bytes)
        frames = np.repeat(clip.frames[:1] // 4, len(clip.frames), axis=0)
        return Clip(frames, clip.times_us * 10)


class Flickering(Sliding):
    """Light that changes by half a threshold at most: pixels that begin at 0 never fire."""

    def read(self, index, truth, most_bytes):
        clip = super().read(index, (), most_bytes)
        levels = np.resize(np.repeat(np.uint8([100, 105]), 2), len(clip.frames))
        return Clip(clip.frames * 0 + levels[:, None, None], clip.times_us)


def test_thresholds_reach_the_events(folder):
    numbers = []
    for limit in (0.2, 0.6):
        ranges = ClipRanges(threshold=(limit, limit), noise=(0, 0), pause=(0, 0))
        batch = take(EventStream(folder, randomize=ranges, outputs="counts", **SMALL), 1)[0]
        assert batch.grids is None
        numbers.append(int(batch.counts.sum()))
    assert numbers[1] < 0.6 * numbers[0]


def test_a_batch_brings_the_frames_times_and_truth_of_its_cuts():
    ranges, truth = ClipRanges(pause=(0.3, 0.5)), ("flow", "depth", "boxes")
    plan = CutPlan(SensorSize(16, 12), 4, 1, ranges, truth)
    for batch in take(EventStream(Sliding(), randomize=ranges, truth=truth, seed=3, **SMALL), 3):
        for clip, source in enumerate(batch.draws["source"].tolist()):
            draw = draw_clip(ranges, 3, batch.number * SMALL["batch"] + clip, 4)
            film = Sliding().read(source, truth, 2**30)
            cut = cut_clip(film, draw, plan, np.empty((5, 12, 16), np.uint8))
            assert np.array_equal(batch.first[clip], cut.frames[0])
            assert np.array_equal(batch.frames[clip], cut.frames[1:])
            assert batch.times_us[clip].tolist() == cut.times_us.tolist()
            assert batch.draws["is_flipped"][clip] == draw.is_flipped
            for name in ("flow", "depth"):
                assert np.array_equal(batch.truth[name][clip], cut.truth[name])
            for found, boxes in zip(batch.truth["boxes"][clip], cut.truth["boxes"], strict=True):
                assert all(np.array_equal(found[key], one) for key, one in boxes.items())


ORDERS = [[1, 4, 3, 5, 0, 2], [1, 3, 4, 2, 0, 5], [4, 2, 0, 3, 5, 1]]
DRAWN = {"recommended": 5208.2176, "physical": 5208.4999, "v2v": 35.3505, "none": 17.0606}


def test_draws_and_orders_of_a_seed_are_those_of_the_release():
    """A training that is begun with one release goes on with the next."""
    assert [order_of_pass(7, number, 6).tolist() for number in range(3)] == ORDERS
    found = {}
    for name, ranges in RANGES.items():
        draw = draw_clip(ranges, 7, 3, 5)
        parts = (draw.numbers, draw.is_flipped, draw.speed, draw.place, draw.is_paused)
        found[name] = round(sum(i * one for i, one in enumerate(np.hstack(parts), 1)), 4)
    assert found == DRAWN


def test_every_pass_of_every_seed_shows_all_sources_in_an_order_of_its_own():
    orders = [order_of_pass(seed, number, 9).tolist() for seed in (0, 1) for number in range(3)]
    assert all(sorted(one) == list(range(9)) for one in orders)
    assert len(set(map(tuple, orders))) == len(orders)


def test_decoded_clips_stay_within_memory_and_disk_and_leave_no_folder(folder):
    size = 12 * HEIGHT * WIDTH + 12 * 8
    stream = EventStream(folder, memory=2 * size, disk=size, **SMALL)
    expected = prints(take(EventStream(folder, **SMALL), 6))
    found = {}
    for batch in itertools.islice(stream, 6):
        found |= prints([batch])
        assert stream._store.memory_bytes <= 2 * size
        assert stream._store.disk_bytes <= size
    assert found == expected
    place = stream._store._folder
    assert len(list(place.iterdir())) == 1
    del stream
    gc.collect()
    assert not place.exists()


def test_workers_leave_no_folder_of_decoded_clips(folder, tmp_path, monkeypatch):
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    stream = EventStream(folder, memory=2 * 12 * HEIGHT * WIDTH, **SMALL)
    loader = torch.utils.data.DataLoader(stream, batch_size=None, num_workers=1)
    batches = iter(loader)
    take(batches, 3)
    assert list(tmp_path.glob("texvent-clips-*"))
    del batches
    gc.collect()
    assert not list(tmp_path.glob("texvent-clips-*"))


def test_a_full_disk_costs_decoding_and_no_source(folder, tmp_path, monkeypatch):
    expected = prints(take(EventStream(folder, **SMALL), 6))
    stream = EventStream(folder, memory=2 * 12 * HEIGHT * WIDTH, **SMALL)
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path / "missing"))
    with pytest.warns(TexventWarning, match="no longer kept on disk") as told:
        assert prints(take(stream, 6)) == expected
    assert len(told) == 1
    assert not stream.skipped


def test_a_batch_that_does_not_fit_says_what_it_takes(folder, batches, monkeypatch):
    one, outputs = batches[0], ClipOutputs(counts=True, latest=True)
    arrays = one.first, one.frames, one.grids, one.counts, one.surfaces
    assert outputs.count_bytes(3, 4, SensorSize(16, 12)) == sum(array.nbytes for array in arrays)

    def refuse(*_):
        raise torch.OutOfMemoryError("CUDA out of memory. Tried to allocate 3.00 GiB.")

    stream = EventStream(folder, **SMALL)
    monkeypatch.setattr(torch, "from_numpy", refuse)
    said = r"batches of 3 clips of 5 frames of 16x12, whose arrays alone take \S+ GB, do not fit"
    with pytest.raises(InputError, match=rf"{said} .*: 3\.00 GiB more .*smaller `batch`"):
        take(stream, 1)


def test_the_truth_of_a_clip_counts_as_memory():
    whole = Sliding().read(0, (), 2**30)
    video = Video(whole.frames, whole.times_us)
    most = 4 * whole.frames[0].size * (1 + 8 + 4)

    def find(times_us, name):
        channels = (2,) if name == "flow" else ()
        return np.zeros((len(times_us), *channels, *whole.frames.shape[1:]), np.float32)

    clip = read_clip(video, ("flow", "depth"), most, find)
    assert len(clip.frames) == 4
    assert clip.nbytes <= most + clip.times_us.nbytes


@pytest.mark.parametrize("size", [1, 2, 3, 7])
def test_broken_and_short_sources_are_skipped_once_and_said_at_the_end_of_a_pass(tmp_path, size):
    write_folders(tmp_path, 2)
    write_folders(tmp_path / "short", 1, frames=3)
    (tmp_path / "short" / "clip0").rename(tmp_path / "clip7")
    (tmp_path / "short").rmdir()
    (tmp_path / "clip1" / "005.png").write_bytes(b"\x89PNG broken")
    stream = EventStream(tmp_path, **{**SMALL, "batch": size})
    with pytest.warns(TexventWarning, match="2 of 3 sources are skipped") as told:
        found = [(batch, len(told)) for batch in itertools.islice(stream, 5)]
    assert [said for _, said in found] == [int(number * size >= 3) for number in range(1, 6)]
    assert {int(source) for batch, _ in found for source in batch.draws["source"]} == {0}
    assert len(stream.skipped) == 2


def test_videos_that_break_off_and_frames_with_nan_are_skipped_with_their_reason(tmp_path):
    film = (Path(__file__).parents[1] / "clips" / "bigbuckbunny_excerpt.mp4").read_bytes()
    (tmp_path / "a_whole.mp4").write_bytes(film)
    (tmp_path / "b_broken.mp4").write_bytes(film[: len(film) // 2])
    bad = np.full((12, 20, 30), 100, np.float32)
    bad[6, 3, 3] = np.nan
    np.save(tmp_path / "c_nan.npy", bad)
    sources = [str(tmp_path / name) for name in ("a_whole.mp4", "b_broken.mp4", "c_nan.npy")]
    stream = EventStream(sources, fps=25, **{**SMALL, "frames": 8})
    with pytest.warns(TexventWarning, match="2 of 3 sources are skipped") as told:
        found = take(stream, 3)
    assert len(told) == 1
    assert {int(source) for batch in found for source in batch.draws["source"]} == {0}
    assert set(stream.skipped) == {1, 2}
    assert re.search(r"b_broken.mp4 is damaged \(a packet", stream.skipped[1])
    assert re.search(r"frame 6 .* that are NaN", stream.skipped[2])


@pytest.mark.parametrize(
    ("options", "error", "message"),
    [
        ({"size": (64, 8)}, InputError, "30x20, smaller than crops of 64x8"),
        ({"frames": 12}, InputError, "has 12 frames, of which 13 are needed"),
        ({"frames_per_grid": 3}, InputError, "of which 13 are needed"),
        ({"truth": "flow"}, ConfigError, "brings no flow"),
        ({"truth": "flwo"}, ConfigError, "'flwo'; .* did you mean 'flow'"),
        ({"outputs": ("grid",)}, ConfigError, "did you mean 'grids'"),
        ({"randomize": "v2w"}, ConfigError, "did you mean 'v2v'"),
        ({"device": "cuda:77"}, ConfigError, "device is 'cuda:77'"),
        ({"device": "tpu"}, ConfigError, "device is 'tpu'"),
        ({"device": "meta"}, ConfigError, "device is 'meta'"),
        ({"batch": 0}, ConfigError, "batch is 0"),
        ({"rank": 2, "world": 2}, ConfigError, "rank is 2"),
        ({"source": "nowhere/"}, InputError, "no such file or folder: nowhere"),
        ({"source": 7}, ConfigError, "got int"),
        ({"source": []}, InputError, "empty list"),
        ({"size": 32}, ConfigError, "size is 32; give"),
        ({"size": "32by32"}, ConfigError, "unknown sensor '32by32'"),
        ({"device": None}, ConfigError, "device is None"),
        ({"randomize": {}}, ConfigError, "or give ClipRanges"),
        (
            {"source": Sliding(), "truth": "flow", "frames_per_grid": 2},
            ConfigError,
            "frame to frame",
        ),
    ],
)
def test_what_cannot_be_streamed_is_refused_at_construction(folder, options, error, message):
    with pytest.raises(error, match=message):
        EventStream(**{"source": folder, **SMALL, **options})


def test_the_default_is_the_recommended_file(folder):
    path = Path(__file__).parents[2] / "configs/training/recommended.toml"
    document = tomllib.loads(path.read_text(encoding="utf-8"))
    assert document["model"] == "physical"
    ranges = {
        name: tuple(value) if isinstance(value, list) else value
        for name, value in document["ranges"].items()
    }
    assert set(ranges) == {one.name for one in fields(PhysicalRanges)}
    default = EventStream(folder, **SMALL)
    assert RANGES[default.randomize] == PhysicalRanges(**ranges)
    same = EventStream(folder, randomize=PhysicalRanges(**ranges), **SMALL)
    assert prints(take(default, 2)) == prints(take(same, 2))


@pytest.mark.parametrize("level", [10, 200])
def test_the_recommended_noise_has_its_rate_at_any_intensity(level):
    class Flat(Still):
        def read(self, index, truth, most_bytes):
            clip = super().read(index, truth, most_bytes)
            return Clip(np.full_like(clip.frames, level), clip.times_us)

    rate = 100.0  # so that a few frames have events enough
    ranges = PhysicalRanges(
        noise_curve=RANGES["recommended"].noise_curve, noise_scale=(rate, rate),
        hot_fraction=(0, 0), leak_rate_hz=(0, 0), refractory_us=(0, 0),
    )  # fmt: skip
    stream = EventStream(Flat(), randomize=ranges, outputs="counts", **SMALL)
    batch = take(stream, 1)[0]
    seconds = batch.times_us[:, -1].sum().item() / 1e6
    assert batch.counts.sum().item() / (seconds * 16 * 12) == pytest.approx(rate, rel=0.3)


@pytest.mark.parametrize("curve", ["1", 1, ["0:1"]])
def test_a_noise_curve_that_is_none_is_refused(curve):
    told = re.escape(f"noise_curve is {curve!r}; it must be points LEVEL:RATE")
    with pytest.raises(ConfigError, match=told):
        PhysicalRanges(noise_curve=curve)


def test_a_bandwidth_between_unlimited_and_slow_is_refused():
    with pytest.raises(ConfigError, match=r"cutoff_hz is \(0, 100\), and 0 is unlimited"):
        PhysicalRanges(cutoff_hz=(0, 100))


@pytest.mark.parametrize(
    ("ranges", "message"),
    [
        ({"threshold": (0.5, 0.1)}, "lowest value first"),
        ({"threshold": 0.5}, "two numbers"),
        ({"threshold": (0.5,)}, "two numbers"),
        ({"threshold": (0.1, 0.2, 0.3)}, "two numbers"),
        ({"threshold": ()}, "two numbers"),
        ({"has_phase": "no"}, "has_phase is 'no'; it must be True or False"),
        ({"noise": (0.0, -1.0)}, "noise is -1"),
        ({"flip": (0.1, 0.2)}, "one number"),
        ({"speed": (0, 2)}, "speed is 0"),
    ],
)
def test_ranges_that_nothing_can_be_drawn_from_are_refused(ranges, message):
    with pytest.raises(ConfigError, match=message):
        ClipRanges(**ranges)


def test_the_state_of_another_stream_is_refused(folder):
    with pytest.raises(ConfigError, match="seed 3"):
        EventStream(folder, **SMALL).load_state_dict({"seed": 3, "next": 4})


def test_the_recipe_of_the_page_runs(folder, tmp_path, monkeypatch):
    page = Path(__file__).parents[2] / "docs" / "training.md"
    (recipe,) = re.findall(r"```text\n(import itertools.*?)```", page.read_text("utf-8"), re.DOTALL)
    small = {
        '"videos", batch=12, frames=40, size=(128, 128)': f"{str(folder)!r}, **SMALL",
        'device="cuda"': 'device="cpu"',
        "10_000": "2",
    }
    for large, tiny in small.items():
        assert large in recipe
        recipe = recipe.replace(large, tiny)
    monkeypatch.chdir(tmp_path)
    exec(compile(recipe, "recipe", "exec"), {"SMALL": {**SMALL, "size": (16, 16)}})
    state = torch.load("checkpoint.pt")["stream"]
    EventStream(folder, **SMALL).load_state_dict(state)
    assert state["next"] == 2


@pytest.mark.parametrize("name", sorted(set(RANGES) - {"none"}))
def test_what_is_drawn_of_a_clip_has_a_chance_of_its_own(name):
    """No two drawn numbers go together, but the two thresholds."""
    ranges = RANGES[name]
    wide = {one: (0.2, 0.9) for one in ranges.drawn if one != "refractory_us"}
    ranges = replace(ranges, **wide, refractory_us=(0, 1000), threshold=(0.2, 0.4))
    draws = [draw_clip(ranges, 3, number, 2) for number in range(400)]
    drawn = np.array(
        [[*one.numbers[2:], one.is_flipped, one.speed, *one.place, one.numbers[:2].min()]
         for one in draws]
    )  # fmt: skip
    varied = drawn[:, np.ptp(drawn, axis=0) > 0.0]
    assert varied.shape[1] >= 5 + len(ranges.drawn)
    apart = np.corrcoef(varied.T) - np.eye(varied.shape[1])
    assert np.abs(apart).max() < 0.25
