"""LoRA on pipelines of the real classes, against matrices merged by hand."""

import dataclasses
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

from texvent._registry import GENERATORS  # noqa: E402
from texvent.errors import (  # noqa: E402
    ConfigError,
    FileFormatError,
    InputError,
    MissingDependencyError,
)
from texvent.generation.diffusers_models.generator import DiffusersGenerator  # noqa: E402
from texvent.generation.video_models.known_models import MODELS  # noqa: E402
from texvent.generation.video_models.lora import PARTS, Lora, parse_lora  # noqa: E402
from texvent.generation.videos.stored_video import StoredVideo  # noqa: E402

from ..tiny_models import OPTIONS, PROMPT, build, pixels  # noqa: E402
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


WAN_NAMES = {
    f"attn{n}.to_{one}": f"{kind}_attn.{one[0]}"
    for n, kind in ((1, "self"), (2, "cross"))
    for one in ("q", "k", "v", "out.0")
}
WAN_NAMES |= {"ffn.net.0.proj": "ffn.0", "ffn.net.2": "ffn.2"}  # fmt: skip
ALPHA = 4.0


def save_wan_adapter(path, pairs, prefix):
    """Save the pairs under the names of Wan's own network, as Wan2.2-Lightning is read."""
    tensors = {}
    for name, (down, up) in pairs.items():
        block, _, layer = name.removeprefix("blocks.").partition(".")
        own = f"{prefix}blocks.{block}.{WAN_NAMES[layer]}"
        tensors[f"{own}.lora_down.weight"] = down.contiguous()
        tensors[f"{own}.lora_up.weight"] = up.contiguous()
        tensors[f"{own}.alpha"] = torch.tensor(ALPHA)
    save_file(tensors, path, {"format": "pt"})


@pytest.fixture
def lightning(models, tmp_path):
    """A tiny Wan 2.2 as a folder with its LoRA, and the same with merged matrices."""

    def make(prefix="diffusion_model."):
        folder = shutil.copytree(models("wan22"), tmp_path / "wan2.2-a14b-lightning")
        merged = shutil.copytree(models("wan22"), tmp_path / "merged")
        for seed, (part, file) in enumerate(zip(PARTS, LIGHTNING, strict=True)):
            weights_file = next((merged / part).glob("*.safetensors"))
            weights = load_file(weights_file)
            pairs = factors(weights, seed)
            save_wan_adapter(folder / file, pairs, prefix)
            for name, (down, up) in pairs.items():
                weights[f"{name}.weight"] += ALPHA / RANK * up @ down
            save_file(weights, weights_file, {"format": "pt"})
        return folder, merged

    return make


LIGHTNING = "high_noise_model.safetensors", "low_noise_model.safetensors"
FEW = {"steps": 4, "guidance": 1.0}


@pytest.mark.parametrize("prefix", ["diffusion_model.", ""])
def test_a_rows_lora_reach_both_networks_of_wan_2_2(lightning, prefix):
    folder, merged = lightning(prefix)
    made = build(folder, **FEW).generate(PROMPT)
    assert len(made.metadata["lora_sha256"]) == 2
    row = MODELS["wan2.2-a14b-lightning"]
    part = GENERATORS.load(str(merged))
    bare = dataclasses.replace(part.model, scheduler=row.scheduler, ignores_fps=True)
    config = dataclasses.replace(part.config_type(), **{**OPTIONS, **FEW})
    expected = pixels(DiffusersGenerator(config, model=bare, seed=3).generate(PROMPT)).astype(int)
    assert np.abs(pixels(made).astype(int) - expected).max() <= 20
    for one in PARTS:  # each network counts
        file = next((merged / one).glob("*.safetensors"))
        shutil.copy(next((folder / one).glob("*.safetensors")), file)
        other = pixels(DiffusersGenerator(config, model=bare, seed=3).generate(PROMPT)).astype(int)
        assert np.abs(other - expected).max() > 1000
        expected = other


@pytest.mark.parametrize("kind", ["missing", "foreign", "other size", "damaged"])
def test_a_lora_that_is_missing_or_foreign_is_one_line_before_anything_is_loaded(lightning, kind):
    folder, _ = lightning()
    high = folder / LIGHTNING[0]
    if kind == "missing":
        high.unlink()
        error, said = InputError, rf"lacks the LoRA .*{LIGHTNING[0]}, of lightx2v/.*put the file"
    elif kind == "foreign":
        save_file({"transformer.other.lora_A.weight": torch.zeros(2, 2)}, high)
        error, said = FileFormatError, "none of its 1 layers is one of"
    elif kind == "other size":
        down, up = torch.zeros(2, 30), torch.zeros(24, 2)
        save_wan_adapter(high, {"blocks.0.attn1.to_q": (down, up)}, "")
        error, said = FileFormatError, "layer blocks.0.attn1.to_q is 24x30 in it, and not 24x24"
    else:
        high.write_bytes(b"no weights")
        error, said = FileFormatError, "cannot be loaded as a LoRA of WanPipeline"
    watcher = Watcher()
    for ask in (
        lambda: build(folder, **FEW).generate(PROMPT, progress=watcher),
        lambda: build(folder, **FEW).plan(PROMPT),
    ):
        with pytest.raises(error, match=said) as told:
            ask()
        assert "\n" not in str(told.value)
    assert watcher.lines == [], "refused before anything was loaded"


def test_the_dry_run_of_a_few_step_row_names_its_lora_steps_and_sizes():
    part = GENERATORS.load("wan2.2-a14b-lightning")
    plan = part(part.config_type(), seed=0, size=None).plan(PROMPT)
    for said in ("4 steps", *LIGHTNING, "of its LoRA 2.46 GB", "download not known"):
        assert said in plan, said


def test_rows_with_a_lora_take_the_four_euler_steps_of_their_publisher():
    rows = [row for row in MODELS.values() if row.loras and row.pipeline.startswith("Wan")]
    assert len(rows) == 4
    for row in rows:
        assert (row.steps, row.guidance) == (4, 1.0)
        saved = diffusers.UniPCMultistepScheduler(
            prediction_type="flow_prediction", use_flow_sigmas=True, flow_shift=3.0
        )
        scheduler = type(saved).from_config(saved.config, **row.scheduler)
        scheduler.set_timesteps(4)
        base = torch.tensor([1.0, 0.75, 0.5, 0.25, 0.0])
        levels = 5 * base / (1 + 4 * base)
        assert torch.allclose(scheduler.sigmas, levels, atol=1e-3)
        velocities = torch.randn(4, 3, 3, generator=torch.Generator().manual_seed(0))
        latents = euler = torch.ones(3, 3)
        for time, now, after, velocity in zip(
            scheduler.timesteps, levels, levels[1:], velocities, strict=False
        ):
            latents = scheduler.step(velocity, time, latents).prev_sample
            euler = euler + (after - now) * velocity
            assert torch.allclose(latents, euler, atol=5e-3)


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
