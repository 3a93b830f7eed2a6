"""Training sequences and their scores, by networks of which nothing but the interface is needed."""

from dataclasses import replace
from types import MappingProxyType, SimpleNamespace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.examples import examples

from texvent.metrics.image_measures import mean_squared_error, structural_similarity
from texvent.represent.voxel_grid import voxel_e2vid
from texvent_lab.train.reconstruction.augmentation import draw_pauses
from texvent_lab.train.reconstruction.config import (
    ExtraClips,
    ReconstructionAugmentation,
    ReconstructionConfig,
    ReconstructionLoss,
)
from texvent_lab.train.reconstruction.sequences import SequenceData

from ..windowed_specification import TEXT, write_sequence_data, write_specification

UNCHANGED = ReconstructionAugmentation(
    flip=False, noise=0.0, hot_pixels=0.0, hot_pixel_fraction=0.0, pause_begin=0.0
)


@pytest.fixture(scope="module")
def config(tmp_path_factory):
    """A training on clips that are simulated once for all tests."""
    data = write_sequence_data(tmp_path_factory.mktemp("clips"), length=4)
    loss = ReconstructionLoss(lpips=0.0, l1=1.0, consistency=1.0)
    return ReconstructionConfig(data=data, loss=loss, augmentation=UNCHANGED)


class Sums:
    """A network that adds up what it saw."""

    bins, multiple, least_side, tensors = 5, 1, 1, MappingProxyType({})
    to = eval = lambda self, *_: self

    @classmethod
    def like(cls, *_):
        return cls()

    from_tensors = like

    def reset(self):
        self.seen = 0

    def step(self, grid):
        self.seen = self.seen + abs(grid).mean(dim=(0, 1))
        return self.seen[None, None]


@pytest.fixture(scope="module")
def task(torch):
    """The module, for which every network is `Sums`."""
    from texvent_lab.train.reconstruction import task

    published = SimpleNamespace(
        network=Sums, name="sums", is_normalised=False, is_stretched=False, padding="constant"
    )
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(task, "RECONSTRUCTORS", SimpleNamespace(load=lambda name: published))
        patch.setattr(task, "make_seeded", lambda make, seed: make())
        yield task


@pytest.fixture(scope="module")
def made(task, config):
    return task.ReconstructionTask(config).batches(workers=0).make


@pytest.mark.parametrize(
    ("begin", "crop", "normal"), [(0.0, None, False), (0.6, 16, True), (0.6, None, False)]
)
@given(seed=st.integers(0, 99))
@examples(0.4)
def test_an_example_is_the_windows_themselves_with_pauses(made, seed, begin, crop, normal):
    make = replace(
        made,
        clips=replace(made.clips, data=replace(made.clips.data, crop=crop)),
        augmentation=replace(UNCHANGED, pause_begin=begin, pause_stay=0.5),
        is_normalised=normal,
    )
    example, chance = make(1, np.random.default_rng(seed)), np.random.default_rng(seed)
    pauses = draw_pauses(4, begin=begin, stay=0.5, chance=chance)
    windows = make.clips.draw(1, chance, int(np.sum(~pauses)))
    part = (..., slice(None), slice(None))
    if crop is not None:
        top, left = (int(chance.integers(side - crop + 1)) for side in windows.events[0].size.shape)
        part = (..., slice(top, top + crop), slice(left, left + crop))
    seen = -1
    for place, is_pause in enumerate(pauses):
        seen += not is_pause
        grid = voxel_e2vid(windows.events[seen], normalise=normal)[part]
        flow = windows.targets["flow"][seen][part]
        for key, expected in (("voxels", grid), ("flow", flow)):
            shown = 0 * expected if is_pause else expected
            np.testing.assert_array_equal(example[key][place], shown)
        frame = windows.targets["frame"][seen][part] / np.float32(255)
        np.testing.assert_array_equal(example["images"][place, 0], frame)
    assert {str(one.dtype) for one in example.values()} == {"float32"}


def test_scores_are_means_over_the_chosen_windows_of_all_clips(torch, task, config):
    measures = {"mse": mean_squared_error, "ssim": structural_similarity}
    for every in (1, 3, 4):
        scored = task.ReconstructionTask(replace(config, score_every=every))
        found, _ = scored.validate(Sums(), torch.device("cpu"), workers=0)
        values = {name: [] for name in measures}
        for number in range(len(scored._validation)):
            windows, seen = scored._validation.read(number), 0.0
            for place, events in enumerate(windows.events, 1):
                seen = seen + abs(voxel_e2vid(events)).mean(axis=0)
                if place % every == 0:
                    true = windows.targets["frame"][place - 1].astype(float) / 255
                    image = np.clip(seen, 0, 1).astype(float)
                    for name, measure in measures.items():
                        values[name].append(measure(image, np.clip(true, 0, 1)))
        for name, own in values.items():
            assert found[name] == pytest.approx(np.mean(own), rel=1e-4)
        assert len(values["mse"]) == 2 * (6 // every)


def test_videos_train_without_flow_and_simulated_clips_are_a_share_of_them(task, tmp_path):
    frames = np.full((12, 20, 20), 200, np.uint8)
    for number in range(12):
        frames[number, 4:14, number : number + 6] = 20
    names = [f"{tmp_path}/{number}.npy" for number in range(6)]
    for number, name in enumerate(names):
        np.save(name, np.roll(frames, number, axis=1))
    write_specification(
        tmp_path,
        "name = 'v'\noptions = {fps = 50}\nsplits = {train = 0.7, validation = 0.3}\n"
        f"[[sources]]\nvideos = {names}\n",
    )
    scenes = tmp_path / "scenes"
    scenes.mkdir()
    extra = write_specification(scenes, TEXT.replace("32x24", "20x20"))
    config = ReconstructionConfig(
        data=SequenceData(specification=tmp_path / "tiny.toml", length=3, slice_us=20_000,
                          cache=tmp_path / "cache"),
        extra=ExtraClips(specification=extra, variant="esim", share=0.4),
        loss=ReconstructionLoss(lpips=0.0, l1=1.0),
    )  # fmt: skip
    both = task.ReconstructionTask(config).batches(workers=0)
    alone = task.ReconstructionTask(replace(config, extra=ExtraClips())).batches(workers=0)
    videos = len(alone.make.clips)
    assert videos >= 2
    assert (both.count, alone.count) == (videos + max(1, round(0.4 * videos)), videos)
    for number in range(both.count):
        example = both.make(number, np.random.default_rng(2))
        assert example.keys() == {"voxels", "images"}
        if number < videos:
            other = alone.make(number, np.random.default_rng(2))
            assert all(np.array_equal(example[key], other[key]) for key in example)
