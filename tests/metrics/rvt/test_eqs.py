"""EQS: RVT's backbone against loops, its checkpoints, and the score. Needs torch."""

import math

import numpy as np
import pytest

pytestmark = pytest.mark.torch
torch = pytest.importorskip("torch", reason="make test-torch runs the tests that need torch")

from texvent.errors import FileFormatError  # noqa: E402
from texvent.events import EventStream  # noqa: E402
from texvent.metrics.latent_similarity import LatentSimilarity, load_eqs  # noqa: E402
from texvent.metrics.rvt_backbone import HEAD_CHANNELS, RvtBackbone, read_rvt  # noqa: E402
from texvent.sensor import SensorSize  # noqa: E402

from ..recordings import random_events  # noqa: E402
from .rvt_files import TINY, checkpoint, random_tensors, slow_backbone, trained_here  # noqa: E402

RVT_T = (32, 32)


def test_published_sizes_have_as_many_numbers_as_in_rvts_own_code():
    networks = [RvtBackbone(*size) for size in HEAD_CHANNELS.items()]
    counts = [sum(one.numel() for one in network.parameters()) for network in networks]
    assert counts == [3_220_032, 7_209_312, 12_784_768]


def tiny_backbone():
    backbone = RvtBackbone(*TINY)
    tensors = random_tensors(TINY)
    backbone.load_state_dict({name: torch.from_numpy(one) for name, one in tensors.items()})
    return backbone


@pytest.mark.parametrize("shape", [(70, 129), (64, 64)])
def test_the_backbone_agrees_with_loops_over_pixels(shape):
    histogram = np.random.default_rng(1).poisson(0.3, (20, *shape)).astype(np.float32)
    found = tiny_backbone()(histogram)
    expected = slow_backbone(histogram, random_tensors(TINY), TINY[1], stages=3)
    for stage, (one, other) in enumerate(zip(found, expected, strict=True)):
        stride = 4 * 2**stage
        rows, columns = (-(-side // stride) for side in shape)
        assert one.shape == (8 * 2**stage, rows, columns)
        np.testing.assert_allclose(one, other[:, :rows, :columns], atol=2e-5)
        assert np.abs(one).max() > 0.05


def test_a_window_does_not_remember_the_one_before():
    backbone = tiny_backbone()
    first, second = np.random.default_rng(2).poisson(1, (2, 20, 64, 64)).astype(np.float32)
    alone = backbone(second)[0]
    backbone(first)
    np.testing.assert_array_equal(backbone(second)[0], alone)


@pytest.fixture
def published(tmp_path):
    """`published(change)`: a checkpoint of RVT-T's shape, changed before it is stored."""

    def write(change=lambda content: None, name="rvt-t.ckpt", make=checkpoint):
        content = make(RVT_T)
        change(content)
        torch.save(content, tmp_path / name)
        return tmp_path / name

    return write


def test_a_checkpoint_is_read_strictly_and_the_detector_left_out(published):
    path = published()
    stored = torch.load(path)["state_dict"]
    tensors = read_rvt(path, "").state_dict()
    assert len(tensors) == len(stored) - 2
    assert all(torch.equal(one, stored[f"mdl.backbone.{name}"]) for name, one in tensors.items())


GAMMA_HERE = "stages.3.att_blocks.0.att_grid.ls2.gamma"
GAMMA = f"mdl.backbone.{GAMMA_HERE}"


@pytest.mark.parametrize(
    ("change", "complaint"),
    [
        (lambda c: c.pop("state_dict"), "holds no state_dict"),
        (lambda c: c["state_dict"].clear(), "has no tensor mdl.backbone.stages.0"),
        (lambda c: c["state_dict"].pop(GAMMA), f"Missing key.*{GAMMA_HERE}"),
        (lambda c: c["state_dict"][GAMMA].fill_(math.nan), "ls2.gamma holds values that are NaN"),
    ],
)
def test_a_checkpoint_of_another_network_is_refused(published, change, complaint):
    with pytest.raises(FileFormatError, match=complaint):
        read_rvt(published(change, "other.ckpt"), "")


GAMMA_OWN = "backbone.stages.3.attention_blocks.0.grid_attn.ls2"


def test_weights_trained_here_are_the_same_network_under_other_names_and_never_called_eqs(
    published,
):
    path = published(name="weights.pt", make=trained_here)
    own, other = read_rvt(path, ""), read_rvt(published(), "")
    assert all(torch.equal(own.state_dict()[n], one) for n, one in other.state_dict().items())
    assert (own.binning, own.is_own, other.is_own) == (2, True, False)
    assert load_eqs(path).name == "eqs (own RVT)"


def test_weights_trained_here_see_cells_and_windows_as_in_their_training():
    tensors = {name: torch.from_numpy(one) for name, one in random_tensors(TINY).items()}
    binned, plain = RvtBackbone(*TINY, binning=2, is_own=True), RvtBackbone(*TINY, is_own=True)
    for one in (binned, plain):
        one.load_state_dict(tensors)
    histogram = np.random.default_rng(3).poisson(0.3, (20, 62, 94)).astype(np.float32)
    cells = histogram.reshape(20, 31, 2, 47, 2).sum(axis=(2, 4))
    for one, other in zip(binned(histogram), plain(cells), strict=True):
        np.testing.assert_array_equal(one, other)
    # 31x47 cells are one window high and two wide, of the last stage's size.
    assert np.abs(plain(cells)[0] - tiny_backbone()(cells)[0]).max() > 1e-3


@pytest.mark.parametrize(
    ("change", "complaint"),
    [
        (lambda c: c["state_dict"].pop(GAMMA_OWN), f"Missing key.*{GAMMA_HERE}"),
        (
            lambda c: c["state_dict"].update({f"{GAMMA_OWN}.x": torch.ones(1)}),
            r"Unexpected.*ls2\.x",
        ),
        (lambda c: c.pop("binning"), "None as binning, 1 to 4 px; give the weights.pt"),
        (lambda c: c.update(binning=True), "True as binning"),
    ],
)
def test_weights_of_another_detector_are_refused(published, change, complaint):
    with pytest.raises(FileFormatError, match=complaint):
        read_rvt(published(change, "weights.pt", trained_here), "")


def test_eqs_is_lfs_with_the_backbone_of_the_file(published):
    eqs = load_eqs(published())
    size = SensorSize(64, 64)
    a, b = random_events(1, 500, size, 50_000), random_events(2, 500, size, 50_000)
    assert eqs.missing() is None
    assert eqs(a, a) == pytest.approx(1.0)
    assert eqs(a, b) < 1.0
    assert eqs(a, b) == LatentSimilarity(backbone=eqs.backbone)(a, b)
    nothing = EventStream.empty(size)
    assert math.isnan(eqs(nothing, nothing))
