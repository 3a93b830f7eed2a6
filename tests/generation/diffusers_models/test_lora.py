"""LoRA on pipelines of the real classes, against matrices merged by hand."""

import shutil
import sys
from pathlib import Path

import numpy as np
import pytest

pytestmark = [pytest.mark.torch, pytest.mark.usefixtures("model_cache")]
torch = pytest.importorskip("torch")
diffusers = pytest.importorskip("diffusers")
peft = pytest.importorskip("peft")

from safetensors.torch import load_file, save_file  # noqa: E402

from texvent.errors import (  # noqa: E402
    ConfigError,
    FileFormatError,
    MissingDependencyError,
)
from texvent.generation.video_models.lora import Lora, parse_lora  # noqa: E402
from texvent.generation.videos.stored_video import StoredVideo  # noqa: E402

from ..tiny_models import PROMPT, build, pixels  # noqa: E402
from ..watcher import Watcher  # noqa: E402

RANK = 2
MATRICES = [f"attn{n}.to_{one}" for n in (1, 2) for one in ("q", "k", "v", "out.0")]
MATRICES += ["ffn.net.0.proj", "ffn.net.2"]
LAYERS = [f"blocks.{b}.{name}" for b in (0, 1) for name in MATRICES]


def factors(weights, seed=1):
    """diffusers' name → (A, B) with values large enough to change pixels."""
    generator = torch.Generator().manual_seed(seed)
    found = {}
    for name in LAYERS:
        rows, columns = weights[f"{name}.weight"].shape
        found[name] = (
            torch.randn(RANK, columns, generator=generator) * 0.5,
            torch.randn(rows, RANK, generator=generator) * 0.5,
        )
    return found


def save_adapter(folder, pairs):
    """Save the pairs as diffusers does; return the path."""
    folder.mkdir()
    path, tensors = folder / "adapter.safetensors", {}
    for name in LAYERS:
        for letter, tensor in zip("AB", pairs[name], strict=True):
            tensors[f"transformer.{name}.lora_{letter}.weight"] = tensor.contiguous()
    save_file(tensors, path, {"format": "pt"})
    return path


def merge(model, folder, pairs, weight):
    """A copy of a saved pipeline whose matrices are W + weight · B·A."""
    shutil.copytree(model, folder)
    file = next((folder / "transformer").glob("*.safetensors"))
    weights = load_file(file)
    for name, (first, second) in pairs.items():
        weights[f"{name}.weight"] += weight * second @ first
    save_file(weights, file, {"format": "pt"})
    return folder


def weights_of(model):
    return load_file(next((model / "transformer").glob("*.safetensors")))


def video(model, **options):
    return pixels(build(model, **options).generate(PROMPT)).astype(int)


def test_several_loras_are_the_products_of_their_matrices_added(models, tmp_path):
    weights = weights_of(models("wan"))
    both = [factors(weights, seed) for seed in (1, 2)]
    paths = [save_adapter(tmp_path / f"{n}", one) for n, one in enumerate(both)]
    merged = merge(models("wan"), tmp_path / "first", both[0], 1.0)
    merged = merge(merged, tmp_path / "both", both[1], -0.5)
    expected = video(merged)
    assert np.abs(expected - video(models("wan"))).max() > 1000
    made = video(models("wan"), lora=(str(paths[0]), f"{paths[1]}:-0.5"))
    assert np.abs(made - expected).max() <= 20


def test_the_file_is_part_of_the_key_of_a_video_and_of_its_facts(models, tmp_path):
    path = save_adapter(tmp_path / "a", factors(weights_of(models("wan"))))
    made = build(models("wan"), lora=(f"{path}:0.5",)).generate(PROMPT)
    assert made.metadata["options"]["lora"] == [f"{path}:0.5"]
    assert [one["file"] for one in made.metadata["files"]] == [str(path)]
    assert build(models("wan"), lora=(f"{path}:0.5",)).plan(PROMPT) is None
    assert build(models("wan"), lora=(f"{path}:0.6",)).plan(PROMPT) is not None
    assert build(models("wan")).plan(PROMPT) is not None
    moved = shutil.copy(path, tmp_path / "moved.safetensors")
    found = build(models("wan"), lora=(f"{moved}:0.5",)).generate(PROMPT)
    assert isinstance(found, StoredVideo)
    assert (pixels(found) == pixels(made)).all()
    assert found.metadata["files"][0]["file"] == str(moved)
    save_adapter(tmp_path / "b", factors(weights_of(models("wan")), seed=9))
    shutil.copy(tmp_path / "b" / path.name, path)
    assert build(models("wan"), lora=(f"{path}:0.5",)).plan(PROMPT) is not None


def test_a_file_that_fits_nothing_is_an_error(models, tmp_path):
    pairs = factors(weights_of(models("wan")))
    path = save_adapter(tmp_path / "a", pairs)
    save_file({f"transformer.other.{n}.lora_A.weight": torch.zeros(2, 2) for n in "ab"}, path)
    with pytest.raises(FileFormatError, match=r"adapter\.safetensors cannot be loaded as a LoRA"):
        build(models("wan"), lora=(str(path),)).generate(PROMPT)


def test_pipelines_without_lora_and_a_missing_package_say_so(models, tmp_path, monkeypatch):
    path = save_adapter(tmp_path / "a", factors(weights_of(models("wan"))))
    watcher = Watcher()
    with pytest.raises(ConfigError, match="CosmosTextToWorldPipeline takes none"):
        build(models("cosmos"), lora=(str(path),)).generate(PROMPT, progress=watcher)
    monkeypatch.setitem(sys.modules, "peft", None)
    with pytest.raises(MissingDependencyError, match=r"texvent\[generate\]"):
        build(models("wan"), lora=(str(path),)).generate(PROMPT, progress=watcher)
    assert watcher.lines == [], "refused before anything was loaded"


@pytest.mark.parametrize(
    ("text", "source", "weight"),
    [
        ("./a b/fast.safetensors:0.8", "./a b/fast.safetensors", 0.8),
        ("fast.safetensors:-1e-1", "fast.safetensors", -0.1),
        ("C:model.safetensors", "C:model.safetensors", 1.0),
    ],
)
def test_source_and_weight_are_told_apart(text, source, weight):
    assert parse_lora(text) == Lora(Path(source), weight)
