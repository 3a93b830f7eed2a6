"""The torch dataset: same samples, same batches, whatever the number of workers."""

import numpy as np
import pytest

from texvent.dataset.samples import SimulatedSamples

pytestmark = pytest.mark.torch
torch = pytest.importorskip("torch")

CLIP = np.full((4, 6, 8), 200, np.uint8)
for _index in range(4):
    CLIP[_index, 2:4, _index : _index + 3] = 20


def dataset(count=5, **options):
    from texvent.dataset.loading.torch_loader import SampleDataset

    samples = SimulatedSamples(
        videos=[CLIP, CLIP[::-1].copy()],
        slice_us=50_000,
        targets=["frame"],
        simulation={"fps": 20, "interpolate": "none", "randomize": "stoffregen"},
        seed=3,
    )
    return SampleDataset(samples, count=count, **options)


def test_batches_do_not_depend_on_the_number_of_workers():
    from texvent.dataset.loading.torch_loader import collate

    def batches(**options):
        return list(
            torch.utils.data.DataLoader(dataset(), batch_size=2, collate_fn=collate, **options)
        )

    alone, shared = batches(), batches(num_workers=2, multiprocessing_context="spawn")
    assert [batch["number"].tolist() for batch in shared] == [[0, 1], [2, 3], [4]]
    for one, other in zip(alone, shared, strict=True):
        assert one.keys() == other.keys()
        assert all(torch.equal(one[name], other[name]) for name in one)
    expected = dataset().samples.make(2)
    assert alone[1]["source"].tolist() == [0, 1]
    for name in ("representation", "frame"):
        np.testing.assert_array_equal(alone[1][name][0].numpy(), expected[name])


def test_an_epoch_may_start_anywhere():
    assert [item["number"] for item in dataset(2, first=7)] == [7, 8]
    assert len(dataset(2, first=7)) == 2
    assert len(dataset(None)) == 2
