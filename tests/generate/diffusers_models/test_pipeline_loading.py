"""Loading pipelines: files of another network by name, options that fit, where parts go."""

import os
import shutil

import pytest

pytestmark = [pytest.mark.torch, pytest.mark.usefixtures("model_cache")]
os.environ["HF_HUB_OFFLINE"] = "1"
torch = pytest.importorskip("torch")
torch.set_num_threads(1)  # tiny arrays: more threads only wait for each other
diffusers = pytest.importorskip("diffusers")

from texvent.errors import (  # noqa: E402
    ConfigError,
    FileFormatError,
)
from texvent.generate.diffusers_models.pipeline_call import check_options  # noqa: E402
from texvent.generate.video_config import DiffusersConfig  # noqa: E402

from ..tiny_models import PROMPT, build  # noqa: E402


def test_weights_of_another_network_are_refused(models, tmp_path):
    path = tmp_path / "mixed"
    shutil.copytree(models("wan"), path)
    config = path / "transformer" / "config.json"
    config.write_text(config.read_text().replace('"ffn_dim": 32', '"ffn_dim": 48'))
    with pytest.raises(FileFormatError, match=r"mixed cannot be loaded as WanPipeline"):
        build(path).generate(PROMPT)


def test_damaged_weights_are_one_line(models, tmp_path):
    path = tmp_path / "damaged"
    shutil.copytree(models("wan"), path)
    file = next((path / "transformer").glob("*.safetensors"))
    file.write_bytes(file.read_bytes()[:-9])
    with pytest.raises(FileFormatError, match="damaged cannot be loaded as WanPipeline") as caught:
        build(path).generate(PROMPT)
    assert "\n" not in str(caught.value)


def test_options_are_compared_with_what_a_pipeline_takes():
    class FromImages:
        def __call__(self, image, prompt=None, num_frames=8):
            return image, prompt, num_frames

    assert "num_frames" in check_options(FromImages, DiffusersConfig(image="a.png", frames=9))
    with pytest.raises(ConfigError, match="FromImages starts from an image; give image=PATH"):
        check_options(FromImages, DiffusersConfig())
    with pytest.raises(ConfigError, match="steps is set, but FromImages does not take it"):
        check_options(FromImages, DiffusersConfig(image="a.png", steps=5))
