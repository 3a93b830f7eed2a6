"""Where a model runs, from the memory there is; what the user sets is kept."""

import pytest

from texvent.errors import ConfigError
from texvent.generate.diffusers_models import pipeline_loading
from texvent.generate.diffusers_models.pipeline_loading import GB, place
from texvent.generate.video_config import DiffusersConfig
from texvent.generate.video_models.known_models import MODELS

COSMOS = MODELS["cosmos-7b"]  # 74 GB on the device, 24.4 GB with offload


@pytest.mark.parametrize(
    ("free_gb", "offload"), [(80, "none"), (74, "none"), (48, "model"), (24, "sequential")]
)
def test_offload_follows_the_free_memory(free_gb, offload):
    placed = place(COSMOS, DiffusersConfig(quantize="none"), "cuda", int(free_gb * GB))
    assert (placed.offload, placed.dtype) == (offload, "bfloat16")
    assert placed.tiles_decoder == (offload != "none")


def test_quantised_weights_need_less():
    config = DiffusersConfig(quantize="4bit")
    assert place(COSMOS, config, "cuda", int(40 * GB)).offload == "none"


@pytest.mark.parametrize(
    ("free_gb", "quantize", "offload"),
    [(80, "none", "none"), (30, "none", "model"), (20, "8bit", "model"), (12, "4bit", "model")],
)
def test_weights_are_quantised_only_where_layers_would_have_to_wait(
    monkeypatch, free_gb, quantize, offload
):
    monkeypatch.setattr(pipeline_loading, "find_spec", lambda name: name == "bitsandbytes" or None)
    placed = place(COSMOS, DiffusersConfig(), "cuda", int(free_gb * GB))
    assert (placed.quantize, placed.offload) == (quantize, offload)


@pytest.mark.parametrize("options", [{"quantize": "none"}, {"offload": "sequential"}])
def test_weights_keep_all_bits_where_the_user_decided(monkeypatch, options):
    monkeypatch.setattr(pipeline_loading, "find_spec", lambda name: name == "bitsandbytes" or None)
    placed = place(COSMOS, DiffusersConfig(**options), "cuda", int(20 * GB))
    assert (placed.quantize, placed.offload) == ("none", "sequential")


def test_weights_keep_all_bits_without_the_package(monkeypatch):
    monkeypatch.setattr(pipeline_loading, "find_spec", lambda name: None)
    assert place(COSMOS, DiffusersConfig(), "cuda", int(20 * GB)).quantize == "none"


def test_nothing_helps_where_even_four_bits_are_too_many(monkeypatch):
    monkeypatch.setattr(pipeline_loading, "find_spec", lambda name: name == "bitsandbytes" or None)
    placed = place(COSMOS, DiffusersConfig(), "cuda", int(4 * GB))
    assert (placed.quantize, placed.offload) == ("none", "sequential")


def test_what_the_user_sets_is_kept():
    config = DiffusersConfig(offload="sequential", dtype="float16")
    placed = place(COSMOS, config, "cuda:1", int(80 * GB))
    assert (placed.device, placed.offload, placed.dtype) == ("cuda:1", "sequential", "float16")


def test_a_cpu_computes_in_float32_unless_told_otherwise():
    placed = place(COSMOS, DiffusersConfig(), "cpu", None)
    assert (placed.offload, placed.dtype) == ("none", "float32")
    assert place(COSMOS, DiffusersConfig(dtype="bfloat16"), "cpu", None).dtype == "bfloat16"


@pytest.mark.parametrize("options", [{"offload": "model"}, {"quantize": "8bit"}])
def test_options_that_need_a_gpu_are_refused_on_a_cpu(options):
    with pytest.raises(ConfigError, match="needs a GPU"):
        place(COSMOS, DiffusersConfig(**options), "cpu", None)


def test_a_model_of_unknown_needs_is_placed_with_care():
    unknown = MODELS["hunyuan1.5-i2v"]
    assert place(unknown, DiffusersConfig(), "cuda", int(80 * GB)).offload == "none"
    assert place(unknown, DiffusersConfig(), "cuda", int(40 * GB)).offload == "model"
