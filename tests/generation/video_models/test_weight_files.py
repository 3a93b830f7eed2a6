"""A model folder is looked through before it is read, and what is wrong is named."""

import json
from contextlib import nullcontext

import pytest

from texvent.errors import FileFormatError, InputError
from texvent.generation.video_models.model_files import (
    check_weight_files,
    fingerprint,
    read_pipeline_index,
)


@pytest.fixture
def model(tmp_path):
    folder = tmp_path / "model"
    for part in ("transformer", "scheduler"):
        (folder / part).mkdir(parents=True)
    index = {
        "_class_name": "WanPipeline",
        "_diffusers_version": "0.42.1",
        "transformer": ["diffusers", "WanTransformer3DModel"],
        "scheduler": ["diffusers", "UniPCMultistepScheduler"],
        "transformer_2": [None, None],
        "boundary_ratio": 0.5,
    }
    (folder / "model_index.json").write_text(json.dumps(index))
    (folder / "scheduler" / "scheduler_config.json").write_text("{}")
    (folder / "transformer" / "config.json").write_text("{}")
    (folder / "transformer" / "weights.safetensors").touch()
    return folder


def test_a_whole_folder_passes(model):
    check_weight_files(model)
    assert read_pipeline_index(model)["_class_name"] == "WanPipeline"


def test_a_missing_folder_and_one_that_is_no_model_are_named(tmp_path):
    with pytest.raises(InputError, match=r"there is no model folder .*nowhere"):
        check_weight_files(tmp_path / "nowhere")
    with pytest.raises(InputError, match=r"holds no model_index\.json"):
        check_weight_files(tmp_path)


def test_a_missing_part_is_named_with_the_place_to_put_it(model):
    (model / "transformer" / "weights.safetensors").unlink()
    with pytest.raises(InputError, match=r"lacks its weights in .*transformer; put its"):
        check_weight_files(model)
    for file in (model / "scheduler").iterdir():
        file.unlink()
    (model / "scheduler").rmdir()
    (model / "transformer" / "weights.safetensors").touch()
    with pytest.raises(InputError, match=r"lacks the folder .*scheduler"):
        check_weight_files(model)


def test_weights_that_come_only_as_a_pickle_are_refused(model):
    (model / "transformer" / "weights.safetensors").unlink()
    (model / "transformer" / "diffusion_pytorch_model.bin").write_bytes(b"\x80\x04N.")
    with pytest.raises(InputError, match=r"diffusion_pytorch_model.bin is a pickle"):
        check_weight_files(model)


def test_the_fingerprint_follows_the_content(model):
    before = fingerprint(model)
    assert fingerprint(model) == before
    (model / "transformer" / "config.json").write_text('{"layers": 2}')
    assert fingerprint(model) != before


INDEX = "transformer/diffusion.safetensors.index.json"
WRONG = {
    "no class": ("model_index.json", {}, FileFormatError, "index.json names no pipeline class"),
    "no names": ("model_index.json", [], FileFormatError, "is damaged: it holds no names; fetch"),
    "part": (INDEX, {"weight_map": {"a": "weights.safetensors", "b": "2.safetensors"}}, InputError,
             "2.safetensors, which diffusion.safetensors.index.json names; put the file there"),
    "": (INDEX, {"weight_map": {"a": "weights.safetensors"}}, None, ""),
}  # fmt: skip


@pytest.mark.parametrize("name", WRONG)
def test_an_index_names_what_is_there(model, name):
    file, content, error, words = WRONG[name]
    (model / file).write_text(json.dumps(content))
    with pytest.raises(error, match=words) if error else nullcontext():
        check_weight_files(model)
