"""Quantised weights: what is asked of bitsandbytes, and with it installed, weights of that kind.

The libraries refuse to quantise without a GPU, though bitsandbytes computes on a CPU as well; the
last test steps over that check.
"""

import os

import numpy as np
import pytest

pytestmark = [pytest.mark.torch, pytest.mark.usefixtures("model_cache")]
os.environ["HF_HUB_OFFLINE"] = "1"
torch = pytest.importorskip("torch")
torch.set_num_threads(1)  # tiny arrays: more threads only wait for each other
pytest.importorskip("diffusers")

from texvent.generate.diffusers_models.pipeline_loading import (  # noqa: E402
    LoadRequest,
    Placement,
    load_pipeline,
)
from texvent.generate.video_models.lora import Lora  # noqa: E402

from ..tiny_models import PROMPT  # noqa: E402


def request(folder, quantize, dtype="bfloat16", **facts):
    return LoadRequest(
        folder=folder,
        content="",
        class_name=None,
        placement=Placement("cpu", dtype, "none", tiles_decoder=False, quantize=quantize),
        **facts,
    )


def test_weights_are_of_that_kind_and_take_an_adapter(models, tmp_path, monkeypatch):
    bitsandbytes = pytest.importorskip("bitsandbytes")
    from diffusers.quantizers.bitsandbytes import bnb_quantizer

    from .test_lora import factors, save_adapter, weights_of

    for kind in (bnb_quantizer.BnB4BitDiffusersQuantizer, bnb_quantizer.BnB8BitDiffusersQuantizer):
        monkeypatch.setattr(kind, "validate_environment", lambda self, *_, **__: None)
        monkeypatch.setattr(kind, "update_device_map", lambda self, _: {"": "cpu"})
    path, _ = save_adapter(tmp_path / "a", factors(weights_of(models("wan"))), "diffusers")
    loras = (Lora(str(path), 3.0),)
    four = load_pipeline(request(models("wan"), "4bit"))
    layer = four.transformer.blocks[0].attn1.to_q
    assert isinstance(layer, bitsandbytes.nn.Linear4bit)
    assert layer.weight.dtype == torch.uint8
    frames = {}
    for quantize, given in (("none", ()), ("8bit", ()), ("none", loras), ("8bit", loras)):
        pipe = load_pipeline(request(models("wan"), quantize, "float32", loras=given))
        layer = pipe.transformer.blocks[0].attn1.to_q
        base = getattr(layer, "base_layer", layer)
        assert isinstance(base, bitsandbytes.nn.Linear8bitLt) == (quantize == "8bit")
        frames[quantize, bool(given)] = pipe(
            prompt=PROMPT,
            num_frames=5,
            width=32,
            height=32,
            num_inference_steps=2,
            generator=torch.Generator("cpu").manual_seed(3),
            output_type="np",
        ).frames

    def differ(one, other):
        return np.abs(frames[one] - frames[other]).mean()

    effect = differ(("none", True), ("none", False))
    assert effect > 0.002
    assert differ(("8bit", False), ("none", False)) < effect / 10
    assert differ(("8bit", True), ("none", True)) < effect / 2
