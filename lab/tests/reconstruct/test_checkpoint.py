"""Published files: their layout; read without running what they hold; refused by name."""

import math
import pickle
import zipfile

import numpy as np
import pytest

from texvent.errors import FileFormatError
from texvent.networks import read_mapping
from texvent_lab.reconstruct.checkpoint import LEFT_BY_TRAINING, network_settings, read_network
from texvent_lab.registries import RECONSTRUCTORS

from .network_files import (
    HEADS,
    config_parser,
    random_state,
    random_tensors,
    save_published,
    shapes_like,
    small_shapes,
)

pytestmark = pytest.mark.torch
torch = pytest.importorskip("torch")


def read(name, path):
    return read_network(RECONSTRUCTORS.load(name), path)


def settings_of(path):
    return dict(network_settings(read_mapping(path, "", extra="torch", stand_ins=LEFT_BY_TRAINING)))


@pytest.mark.parametrize("name", HEADS)
def test_published_checkpoints_give_their_tensors(name, tmp_path):
    path = save_published(torch, name, tmp_path / "model.pth")
    network = read(name, path)
    expected = random_tensors(small_shapes(name))
    assert network.tensors.keys() == expected.keys()
    for key, array in expected.items():
        np.testing.assert_array_equal(network.tensors[key].detach().numpy(), array)


@pytest.mark.parametrize("suffix", [".pth", ".safetensors"])
def test_tensors_alone_are_read_too(suffix, tmp_path):
    state, path = random_state(torch, "firenet"), tmp_path / f"plain{suffix}"
    if suffix == ".pth":
        torch.save(state, path)
    else:
        pytest.importorskip("safetensors.torch").save_file(state, path)
    network = read("firenet", path)
    assert network.tensors.keys() == state.keys()
    assert settings_of(path) == {}


@pytest.mark.parametrize("name", ["e2vid", "e2vid+", "firenet"])
def test_what_each_program_says_about_its_network_is_found(name, tmp_path):
    settings = {"num_bins": 5, "final_activation": "sigmoid"}
    path = save_published(torch, name, tmp_path / "model.pth", settings=settings)
    assert settings_of(path) == settings


def test_what_training_left_beside_the_weights_does_no_harm(tmp_path):
    config = config_parser({"arch": {"args": {"kwargs": {"final_activation": "sigmoid"}}}})
    config.resume = tmp_path / "before.pth"
    left = {"config": config, "monitor_best": np.float64(0.25), "saved": np.arange(3)[1]}
    path = save_published(torch, "e2vid+", tmp_path / "model.pth", **left)
    assert settings_of(path) == {"final_activation": "sigmoid"}


def test_no_code_of_a_file_runs(tmp_path):
    class Trap:
        def __reduce__(self):
            return (open, (str(tmp_path / "sprung"), "w"))

    path = save_published(torch, "firenet", tmp_path / "model.pth", trap=Trap())
    with pytest.raises(FileFormatError, match="save the tensors alone"):
        read("firenet", path)
    assert not (tmp_path / "sprung").exists()


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda state: state.pop("net.pred.conv2d.bias"), r"Missing key.*net\.pred\.conv2d\.bias"),
        (
            lambda state: state.update({HEADS["firenet"]: torch.zeros(2)}),
            "first layer is of another kind",
        ),
        (lambda state: state["net.pred.conv2d.bias"].fill_(float("nan")), "NaN or infinite"),
    ],
)
def test_a_changed_file_is_refused_with_the_tensor(change, message, tmp_path):
    state = random_state(torch, "firenet")
    change(state)
    torch.save({"state_dict": state}, tmp_path / "model.pth")
    with pytest.raises(FileFormatError, match=message):
        read("firenet", tmp_path / "model.pth")


@pytest.mark.parametrize(
    "content", [b"", b"not a pickle", pickle.dumps([1, 2], 2), pickle.dumps({"state_dict": 3}, 2)]
)
def test_damaged_files_are_refused_in_one_line(content, tmp_path):
    path = tmp_path / "model.pth"
    path.write_bytes(content)
    with pytest.raises(FileFormatError) as told:
        read("firenet", path)
    assert str(path) in str(told.value)
    assert "\n" not in str(told.value)


def test_a_weight_that_changed_on_its_way_is_refused(tmp_path):
    path = tmp_path / "model.pth"
    torch.save({"state_dict": random_state(torch, "firenet")}, path)
    with zipfile.ZipFile(path) as archive:
        largest = max(archive.infolist(), key=lambda one: one.file_size)
        last_bytes = archive.read(largest)[-64:]
    content = bytearray(path.read_bytes())
    content[content.index(last_bytes)] ^= 0x40
    path.write_bytes(content)
    with pytest.raises(FileFormatError, match="fails its checksum"):
        read("firenet", path)


def count_parameters(shapes):
    return sum(
        math.prod(shape) for name, shape in shapes.items() if not name.endswith(("_mean", "_var"))
    )


@pytest.mark.parametrize("name", ["firenet", "firenet+"])
def test_firenet_has_the_published_24_tensors_and_37777_parameters(name):
    shapes = shapes_like(name, {})
    assert len(shapes) == 24
    assert count_parameters(shapes) == 37_777


@pytest.mark.parametrize(
    ("name", "tensors", "millions"),
    [
        ("e2vid", 30, 10.71), ("e2depth", 30, 10.71), ("hypere2vid", 45, 10.15),
        ("et-net", 254, 22.18),
    ],
)  # fmt: skip
def test_networks_have_the_published_number_of_tensors_and_parameters(name, tensors, millions):
    shapes = shapes_like(name, {})
    assert len(shapes) == tensors
    assert count_parameters(shapes) == pytest.approx(millions * 1e6, abs=5e3)


@pytest.mark.parametrize("side", [1, 4, 301])
def test_kernels_of_an_unpublished_side_are_refused_before_patterns_are_made(side, tmp_path):
    torch.save({HEADS["hypere2vid"]: torch.ones(1, 5, side, side)}, tmp_path / "model.pth")
    with pytest.raises(FileFormatError, match="first layer is of another kind"):
        read("hypere2vid", tmp_path / "model.pth")


LAYOUT = {
    "hypere2vid": (
        *("context_fusion.conv.weight", "dynamic_atom_generation.bases_net.4.running_var"),
        *("dynamic_atom_generation.bases", "dynamic_conv.compositional_coefficients"),
        "dynamic_conv.bias",
    ),
    "et-net": (
        *("DownsampleConv.2.recurrent_block.Gates.bias", "UpsampleConv.0.conv2d.weight"),
        *("trans_encoder0.encoder.layers.2.self_attn.in_proj_weight", "split2.weight"),
        *("trans_decoder2.decoder.layers.1.cross_attn.out_proj.bias", "pred.conv2d.bias"),
        "trans_decoder1.decoder.layers.0.norm22.weight",
    ),
}


@pytest.mark.parametrize("name", LAYOUT)
def test_tensors_have_the_published_names(name):
    prefix = "unetrecurrent.decoders.0." if name == "hypere2vid" else ""
    assert {f"{prefix}{one}" for one in LAYOUT[name]} <= shapes_like(name, {}).keys()


@pytest.mark.parametrize("name", HEADS)
def test_a_file_of_each_other_network_or_cut_off_is_refused_in_one_line(name, tmp_path):
    path = tmp_path / "model.pth"
    same = {one for one in HEADS if small_shapes(one) == small_shapes(name)}
    for other in HEADS.keys() - same:
        save_published(torch, other, path)
        with pytest.raises(FileFormatError, match=r"holds another network: \w+ key|first layer"):
            read(name, path)
    save_published(torch, name, path)
    path.write_bytes(path.read_bytes()[:-2000])
    with pytest.raises(FileFormatError, match="cannot be read as network weights") as told:
        read(name, path)
    assert "\n" not in str(told.value)


@pytest.mark.parametrize("name", HEADS)
def test_shapes_follow_the_width_of_the_file(name):
    narrow, published = small_shapes(name), shapes_like(name, {})
    assert narrow.keys() == published.keys()
    assert narrow[HEADS[name]] != published[HEADS[name]]
