"""Where a model runs, from the memory there is; what the user sets is kept."""

import pytest

from texvent.errors import ConfigError
from texvent.generation.diffusers_models.pipeline_loading import GB, place
from texvent.generation.video_models.config import DiffusersConfig
from texvent.generation.video_models.known_models import MODELS

COSMOS = MODELS["cosmos-7b"]  # 74 GB on the device, 24.4 GB with offload
UNKNOWN = MODELS["hunyuan1.5-i2v"]


@pytest.mark.parametrize(
    ("model", "free_gb", "offload"),
    [
        (COSMOS, 80, "none"),
        (COSMOS, 74, "none"),
        (COSMOS, 48, "model"),
        (COSMOS, 24, "sequential"),
        (UNKNOWN, 80, "none"),
        (UNKNOWN, 40, "model"),
    ],
)
def test_offload_follows_the_free_memory(model, free_gb, offload):
    placed = place(model, DiffusersConfig(), "cuda", int(free_gb * GB))
    assert (placed.offload, placed.dtype) == (offload, "bfloat16")
    assert placed.tiles_decoder == (offload != "none")


def test_what_the_user_sets_is_kept():
    placed = place(COSMOS, DiffusersConfig(offload="sequential"), "cuda:1", int(80 * GB))
    assert (placed.device, placed.offload) == ("cuda:1", "sequential")


def test_a_cpu_computes_in_float32_and_offloads_nothing():
    placed = place(COSMOS, DiffusersConfig(), "cpu", None)
    assert (placed.offload, placed.dtype) == ("none", "float32")
    with pytest.raises(ConfigError, match="needs a GPU"):
        place(COSMOS, DiffusersConfig(offload="model"), "cpu", None)
