"""Adapters (LoRA) on pipelines of the real classes, against matrices merged by hand."""

import json
import os
import shutil
import sys
from fractions import Fraction

import numpy as np
import pytest

pytestmark = [pytest.mark.torch, pytest.mark.usefixtures("model_cache")]
os.environ["HF_HUB_OFFLINE"] = "1"
torch = pytest.importorskip("torch")
torch.set_num_threads(1)  # tiny arrays: more threads only wait for each other
diffusers = pytest.importorskip("diffusers")
peft = pytest.importorskip("peft")

from PIL import Image  # noqa: E402
from safetensors.torch import load_file, save_file  # noqa: E402

from texvent.cli.app import main  # noqa: E402
from texvent.errors import (  # noqa: E402
    ConfigError,
    FileFormatError,
    InputError,
    MissingDependencyError,
)
from texvent.generate.diffusers_models.adapter_loading import (  # noqa: E402
    describe_few_steps,
    load_adapters,
)
from texvent.generate.diffusers_models.generator import DiffusersGenerator  # noqa: E402
from texvent.generate.video_config import DiffusersConfig  # noqa: E402
from texvent.generate.video_models.adapters import Adapter, AdapterFile  # noqa: E402
from texvent.generate.video_models.known_models import VideoModel  # noqa: E402
from texvent.scenes.assets.provenance import check_files  # noqa: E402

from .. import tiny_pipelines  # noqa: E402
from ..tiny_families import ltx2  # noqa: E402
from ..tiny_models import OPTIONS, PROMPT, build, pixels  # noqa: E402

RANK, ALPHA = 2, 6.0
ATTENTION = {"q": "to_q", "k": "to_k", "v": "to_v", "o": "to_out.0"}
"""Wan's own names of the matrices of attention → those of diffusers."""
MATRICES = {
    **{f"self_attn.{own}": f"attn1.{name}" for own, name in ATTENTION.items()},
    **{f"cross_attn.{own}": f"attn2.{name}" for own, name in ATTENTION.items()},
    "ffn.0": "ffn.net.0.proj",
    "ffn.2": "ffn.net.2",
}
LAYERS = {
    f"blocks.{b}.{own}": f"blocks.{b}.{name}" for b in (0, 1) for own, name in MATRICES.items()
}
NAMINGS = ("diffusers", "diffusers-scaled", "wan", "musubi", "peft")


class Quiet:
    """Fails when a model is loaded."""

    def announce(self, line):
        raise AssertionError(line)


class Listener:
    def __init__(self):
        self.lines = []

    def announce(self, line):
        self.lines.append(line)

    def advance(self, stage, done, total):
        pass


def factors(weights, seed=1):
    """diffusers' name → (A, B) with values large enough to change pixels."""
    generator = torch.Generator().manual_seed(seed)
    found = {}
    for name in LAYERS.values():
        rows, columns = weights[f"{name}.weight"].shape
        found[name] = (
            torch.randn(RANK, columns, generator=generator) * 0.5,
            torch.randn(rows, RANK, generator=generator) * 0.5,
        )
    return found


def save_adapter(folder, pairs, naming):
    """Save the pairs as a program of that kind does; return the path and the scale it means."""
    folder.mkdir()
    path, scale = folder / "adapter.safetensors", ALPHA / RANK
    by_name = {}
    for own, name in LAYERS.items():
        first, second = pairs[name]
        if naming.startswith("diffusers"):
            keys = f"transformer.{name}.lora_A.weight", f"transformer.{name}.lora_B.weight"
        elif naming == "peft":
            keys = (f"base_model.model.{name}.lora_{one}.weight" for one in "AB")
        elif naming == "wan":
            keys = (f"diffusion_model.{own}.lora_{one}.weight" for one in ("down", "up"))
            by_name[f"diffusion_model.{own}.alpha"] = torch.tensor(ALPHA)
        else:
            flat = own.replace(".", "_")
            keys = (f"lora_unet_{flat}.lora_{one}.weight" for one in ("down", "up"))
            by_name[f"lora_unet_{flat}.alpha"] = torch.tensor(ALPHA)
        by_name.update(zip(keys, (first, second), strict=True))
    metadata = {"format": "pt"}
    if naming == "diffusers":
        scale = 1.0  # without a note of alpha
    if naming == "diffusers-scaled":
        facts = {"r": RANK, "lora_alpha": ALPHA, "target_modules": sorted(LAYERS.values())}
        config = {f"transformer.{name}": value for name, value in facts.items()}
        metadata["lora_adapter_metadata"] = json.dumps(config)
    if naming == "peft":
        path = folder / "adapter_model.safetensors"
        config = {"r": RANK, "lora_alpha": ALPHA, "peft_type": "LORA"}
        (folder / "adapter_config.json").write_text(json.dumps(config))
    save_file({name: tensor.contiguous() for name, tensor in by_name.items()}, path, metadata)
    return path, scale


def merge(model, folder, pairs, weight, part="transformer"):
    """A copy of a saved pipeline whose matrices are W + weight · B·A."""
    shutil.copytree(model, folder)
    file = next((folder / part).glob("*.safetensors"))
    weights = load_file(file)
    for name, (first, second) in pairs.items():
        weights[f"{name}.weight"] += weight * second @ first
    save_file(weights, file, {"format": "pt"})
    return folder


def random_ltx2():
    with tiny_pipelines.random_weights():
        return ltx2()


def ltx2_pair(layer, names):
    """A and B of a layer, by the names given."""
    draw = torch.Generator().manual_seed(1)
    shapes = (RANK, layer.in_features), (layer.out_features, RANK)
    return {
        name: torch.randn(*shape, generator=draw) for name, shape in zip(names, shapes, strict=True)
    }


def weights_of(model, part="transformer"):
    return load_file(next((model / part).glob("*.safetensors")))


def video(model, **options):
    return pixels(build(model, **options).generate(PROMPT)).astype(int)


@pytest.mark.parametrize("naming", NAMINGS)
def test_an_adapter_is_the_product_of_its_matrices_added(naming, models, tmp_path):
    pairs = factors(weights_of(models("wan")))
    path, scale = save_adapter(tmp_path / naming, pairs, naming)
    merged = merge(models("wan"), tmp_path / "merged", pairs, 0.5 * scale)
    expected = video(merged)
    assert np.abs(expected - video(models("wan"))).max() > 1000
    assert np.abs(video(models("wan"), lora=(f"{path}:0.5",)) - expected).max() <= 20


def test_weight_0_is_without_and_weight_1_is_not(models, tmp_path):
    pairs = factors(weights_of(models("wan")))
    path, _ = save_adapter(tmp_path / "one", pairs, "diffusers")
    usual = video(models("wan"))
    assert np.array_equal(video(models("wan"), lora=(f"{path}:0",)), usual)
    assert not np.array_equal(video(models("wan"), lora=(str(path),)), usual)


@pytest.mark.parametrize("naming", ["diffusers", "former", "kohya"])
def test_an_image_model_with_a_motion_adapter_takes_adapters_of_its_unet(naming, models, tmp_path):
    place = "down_blocks.0.attentions.0.transformer_blocks.0.attn1.to_q"
    model = models("stable-diffusion")
    generator = torch.Generator().manual_seed(0)
    first, second = (torch.randn(*shape, generator=generator) * 2 for shape in ((2, 8), (8, 2)))
    names = {
        "diffusers": [f"unet.{place}.lora_A.weight", f"unet.{place}.lora_B.weight"],
        "former": [f"unet.{place}.lora.down.weight", f"unet.{place}.lora.up.weight"],
        "kohya": [
            f"lora_unet_{place.replace('.', '_')}.lora_{one}.weight" for one in ("down", "up")
        ],
    }[naming]
    tensors = dict(zip(names, (first, second), strict=True))
    if naming == "kohya":
        tensors[names[0].replace("lora_down.weight", "alpha")] = torch.tensor(2.0)
    save_file(tensors, tmp_path / "unet.safetensors", {"format": "pt"})
    merged = merge(model, tmp_path / "merged", {place: (first, second)}, 0.5, "unet")
    motion = {"motion_adapter": tiny_pipelines.save_motion_adapter(tmp_path / "motion")}
    expected = video(merged, **motion)
    assert np.abs(expected - video(model, **motion)).max() > 100
    made = video(model, **motion, lora=(f"{tmp_path / 'unet.safetensors'}:0.5",))
    assert np.abs(made - expected).max() <= 20


def test_a_changed_scale_of_peft_makes_another_video_and_is_refused_by_replay(models, tmp_path):
    path, _ = save_adapter(tmp_path / "a", factors(weights_of(models("wan"))), "peft")
    config = path.with_name("adapter_config.json")
    first = build(models("wan"), lora=(str(path),)).generate(PROMPT)
    check_files(first.metadata["files"])
    assert [one["file"] for one in first.metadata["files"]] == [str(path), str(config)]
    config.write_text(json.dumps({"lora_alpha": 10 * ALPHA}))
    with pytest.raises(FileFormatError, match=r"adapter_config\.json was changed since"):
        check_files(first.metadata["files"])
    second = build(models("wan"), lora=(str(path),)).generate(PROMPT)
    assert second.metadata["lora"][0]["sha256"] != first.metadata["lora"][0]["sha256"]
    assert not np.array_equal(pixels(first), pixels(second))


def test_several_adapters_add_up_and_a_folder_names_its_only_one(models, tmp_path):
    weights = weights_of(models("wan"))
    both = [factors(weights, seed) for seed in (1, 2)]
    paths = [save_adapter(tmp_path / f"{n}", one, "diffusers")[0] for n, one in enumerate(both)]
    merged = merge(models("wan"), tmp_path / "first", both[0], 1.0)
    merged = merge(merged, tmp_path / "both", both[1], -0.5)
    given = (str(paths[0].parent), f"{paths[1]}:-0.5")
    assert np.abs(video(models("wan"), lora=given) - video(merged)).max() <= 20
    shutil.copy(paths[0], paths[0].parent / "second.safetensors")
    with pytest.raises(InputError, match=r"which adapter: adapter\.safetensors, second\.saf"):
        build(models("wan"), lora=(str(paths[0].parent),)).generate(PROMPT)


def test_two_transformers_take_an_adapter_each(models, tmp_path):
    names = {"high": "transformer", "low": "transformer_2"}
    merged, given = models("wan22"), []
    for seed, (noise, part) in enumerate(names.items()):
        pairs = factors(weights_of(models("wan22"), part), seed)
        path, _ = save_adapter(tmp_path / noise, pairs, "wan")
        given.append(path.rename(path.with_name(f"{noise}_noise_model.safetensors")))
        merged = merge(merged, tmp_path / f"merged-{noise}", pairs, ALPHA / RANK, part)
    made = video(models("wan22"), lora=tuple(map(str, given)), steps=4)
    assert np.abs(made - video(merged, steps=4)).max() <= 40
    turned = (f"{given[0]}:1:low", f"{given[1]}:high")
    assert not np.array_equal(video(models("wan22"), lora=turned, steps=4), made)


def test_which_transformer_must_be_said_where_there_are_two_and_only_there(models, tmp_path):
    path, _ = save_adapter(tmp_path / "a", factors(weights_of(models("wan"))), "diffusers")
    with pytest.raises(ConfigError, match=r"two video transformers, .* add :high or :low"):
        build(models("wan22"), lora=(str(path),)).generate(PROMPT, progress=Quiet())
    with pytest.raises(ConfigError, match=r"two video transformers, .* add :high or :low"):
        build(models("wan22"), lora=(str(path),)).plan(PROMPT)
    with pytest.raises(ConfigError, match="one video transformer; leave :low out"):
        build(models("wan"), lora=(f"{path}:low",)).generate(PROMPT, progress=Quiet())


def test_the_adapter_is_part_of_what_a_video_is_kept_under_and_says(models, tmp_path):
    path, _ = save_adapter(tmp_path / "a", factors(weights_of(models("wan"))), "diffusers")
    made = build(models("wan"), lora=(f"{path}:0.5",)).generate(PROMPT)
    facts = made.metadata["lora"]
    assert facts[0]["source"] == str(path)
    assert facts[0]["weight"] == 0.5
    assert made.metadata["options"]["lora"] == [f"{path}:0.5"]
    assert made.metadata["files"] == [{"file": str(path), "sha256": facts[0]["sha256"]}]
    assert build(models("wan"), lora=(f"{path}:0.5",)).plan(PROMPT) is None
    assert build(models("wan"), lora=(f"{path}:0.6",)).plan(PROMPT) is not None
    assert build(models("wan")).plan(PROMPT) is not None
    moved = shutil.copy(path, tmp_path / "moved.safetensors")
    assert build(models("wan"), lora=(f"{moved}:0.5",)).plan(PROMPT) is None
    found = build(models("wan"), lora=(f"{moved}:0.5",)).generate(PROMPT)
    assert found.path == made.path
    assert found.metadata["options"]["lora"] == [f"{moved}:0.5"]
    assert found.metadata["files"] == [{"file": str(moved), "sha256": facts[0]["sha256"]}]
    save_adapter(tmp_path / "b", factors(weights_of(models("wan")), seed=9), "diffusers")
    shutil.copy(tmp_path / "b" / path.name, path)
    assert build(models("wan"), lora=(f"{path}:0.5",)).plan(PROMPT) is not None


def test_a_recording_is_made_again_unless_the_adapter_was_changed(models, tmp_path, capsys):
    path, _ = save_adapter(tmp_path / "a", factors(weights_of(models("wan"))), "diffusers")
    options = {**OPTIONS, "generator": models("wan"), "interpolate": "none", "lora": f"{path}:0.5"}
    flags = [(f"--{name.replace('_', '-')}", str(value)) for name, value in options.items()]
    out, again = tmp_path / "out.h5", tmp_path / "again.h5"
    assert main(["generate", PROMPT, "-o", str(out), "--events-only", *sum(flags, ())]) == 0
    assert main(["replay", str(out), "-o", str(again)]) == 0
    assert "the same bytes" in capsys.readouterr().out
    save_adapter(tmp_path / "b", factors(weights_of(models("wan")), seed=9), "diffusers")
    shutil.copy(tmp_path / "b" / path.name, path)
    assert main(["replay", str(out), "-o", str(again), "--overwrite"]) != 0
    assert f"error: {path} was changed since" in capsys.readouterr().err


def test_tensors_that_fit_nothing_are_an_error(models, tmp_path, capsys):
    pairs = factors(weights_of(models("wan")))
    path, _ = save_adapter(tmp_path / "a", pairs, "diffusers")
    tensors = load_file(path)
    extra = {f"transformer.blocks.7.attn1.to_q.lora_{one}.weight" for one in "AB"}
    taken = dict(zip(sorted(extra), pairs["blocks.0.attn1.to_q"], strict=True))
    save_file({**tensors, **taken}, path)
    message = r"does not fit WanPipeline: 2 of its 42 .* such as transformer\.blocks\.7\.attn1"
    with pytest.raises(FileFormatError, match=message):
        build(models("wan"), lora=(str(path),)).generate(PROMPT)
    save_file({"other.weight": torch.zeros(2, 2)}, path)
    with pytest.raises(FileFormatError, match=r"adapter\.safetensors cannot be loaded as an adapt"):
        build(models("wan"), lora=(str(path),)).generate(PROMPT)
    save_file(
        {name: one for name, one in tensors.items() if "0.attn1.to_q.lora_B" not in name}, path
    )
    with pytest.raises(FileFormatError, match=r"is damaged: it lacks .*0\.attn1\.to_q\.lora_B"):
        build(models("wan"), lora=(str(path),)).generate(PROMPT)
    bent = {
        name: one[:, :-1].clone() if "to_q.lora_A" in name else one for name, one in tensors.items()
    }
    save_file(bent, path)
    with pytest.raises(FileFormatError, match=r"adapter\.safetensors cannot be loaded as an adapt"):
        build(models("wan"), lora=(str(path),)).generate(PROMPT)
    assert capsys.readouterr() == ("", "")


def test_differences_of_norms_that_diffusers_leaves_out_are_told(models, tmp_path):
    path, _ = save_adapter(tmp_path / "a", factors(weights_of(models("wan"))), "wan")
    norm = {"diffusion_model.blocks.0.self_attn.norm_q.diff": torch.ones(24)}
    save_file({**load_file(path), **norm}, path)

    heard = Listener()
    build(models("wan"), lora=(str(path),)).generate(PROMPT, progress=heard)
    assert any("diffusers leaves 1 of 61 tensors out" in line for line in heard.lines)


def test_one_left_out_difference_does_not_hide_other_missing_tensors(tmp_path):
    """Of LTX-2's own names, diffusers drops the tensors that it does not know."""
    pipe = random_ltx2()
    names = [f"diffusion_model.transformer_blocks.0.attn1.to_q.lora_{one}.weight" for one in "AB"]
    tensors = ltx2_pair(pipe.transformer.transformer_blocks[0].attn1.to_q, names)
    path = tmp_path / "own.safetensors"
    save_file({**tensors, "other.norm.diff": torch.ones(2)}, path)
    (note,) = load_adapters(pipe, [AdapterFile(path, "", Adapter(str(path)))])
    assert "leaves 1 of 3 tensors out" in note
    save_file({**tensors, "other.norm.diff": torch.ones(2), "other.a": torch.ones(2)}, path)
    with pytest.raises(FileFormatError, match="2 of its 4 tensors fit nothing"):
        load_adapters(random_ltx2(), [AdapterFile(path, "", Adapter(str(path)))])


def test_adapters_of_the_connectors_of_ltx_2_are_loaded_with_their_weight(tmp_path):
    pipe = random_ltx2()
    names = [f"connectors.text_proj_in.lora_{one}.weight" for one in "AB"]
    path = tmp_path / "connectors.safetensors"
    tensors = ltx2_pair(pipe.connectors.text_proj_in, names)
    save_file(tensors, path)
    values = torch.ones(1, pipe.connectors.text_proj_in.in_features)
    before = pipe.connectors.text_proj_in(values)
    assert load_adapters(pipe, [AdapterFile(path, "", Adapter(str(path), 0.5))]) == []
    first, second = (tensors[name] for name in names)
    change = pipe.connectors.text_proj_in(values) - before
    torch.testing.assert_close(change, 0.5 * values @ first.T @ second.T)


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (b"version https://git-lfs.github.com/spec/v1\noid sha256:0\n", "is a git-lfs pointer"),
        (b"\x10\x00\x00\x00\x00\x00\x00\x00{}", "is damaged"),
    ],
    ids=["pointer", "truncated"],
)
def test_damaged_files_are_refused_before_the_model_is_loaded(content, message, models, tmp_path):
    path = tmp_path / "bad.safetensors"
    path.write_bytes(content)
    with pytest.raises(FileFormatError, match=message):
        build(models("wan"), lora=(str(path),)).generate(PROMPT, progress=Quiet())


def test_peft_files_need_their_scale(models, tmp_path):
    path, _ = save_adapter(tmp_path / "a", factors(weights_of(models("wan"))), "peft")
    config = path.with_name("adapter_config.json")
    config.write_text(json.dumps({"lora_alpha": 4, "use_dora": True}))
    with pytest.raises(InputError, match="no plain adapter"):
        build(models("wan"), lora=(str(path),)).generate(PROMPT)
    config.unlink()
    with pytest.raises(InputError, match=r"put that file there"):
        build(models("wan"), lora=(str(path),)).generate(PROMPT)


def test_pipelines_without_adapters_and_a_missing_package_say_so(models, tmp_path, monkeypatch):
    path, _ = save_adapter(tmp_path / "a", factors(weights_of(models("wan"))), "diffusers")
    with pytest.raises(ConfigError, match="CosmosTextToWorldPipeline takes no adapters"):
        build(models("cosmos"), lora=(str(path),)).generate(PROMPT, progress=Quiet())
    monkeypatch.setitem(sys.modules, "peft", None)
    with pytest.raises(MissingDependencyError, match=r"texvent\[generate\]"):
        build(models("wan"), lora=(str(path),)).generate(PROMPT, progress=Quiet())


def test_what_shows_without_the_model_is_refused_before_it_is_fetched(tmp_path, monkeypatch):
    model = VideoModel(name="text", repo="org/absent", pipeline="LTXPipeline", fps=Fraction(16))
    image = tmp_path / "image.png"
    Image.new("RGB", (8, 8)).save(image)
    monkeypatch.setitem(sys.modules, "peft", None)
    for options, kind, message in (
        ({"image": image}, ConfigError, "LTXPipeline starts from text alone"),
        ({"decoder": tmp_path}, InputError, "there is no decoder in"),
        ({"lora": ("hub:org/name/a.safetensors",)}, MissingDependencyError, "peft"),
    ):
        generator = DiffusersGenerator(DiffusersConfig(**options), model=model)
        with pytest.raises(kind, match=message):
            generator.generate(PROMPT, progress=Quiet())


@pytest.mark.parametrize(
    ("source", "is_named"),
    [
        ("/data/8_steps.safetensors", True),
        ("hub:turbo/name", True),
        ("/home/turbo/style.safetensors", False),
        ("style_2000_steps.safetensors", False),
        ("style-1500steps.safetensors", False),
    ],
)
def test_names_that_speak_of_few_steps(source, is_named):
    hint = describe_few_steps([Adapter(source)], diffusers.WanPipeline, DiffusersConfig())
    assert (hint is not None) == is_named


def test_an_adapter_named_for_few_steps_gives_a_hint(models, tmp_path):
    path, _ = save_adapter(tmp_path / "a", factors(weights_of(models("wan"))), "diffusers")
    fast = path.rename(path.with_name("lightning-4steps.safetensors"))
    heard = Listener()
    build(models("wan"), lora=(str(fast),)).generate(PROMPT, progress=heard)
    first = heard.lines[0]
    assert first.startswith("lightning-4steps.safetensors is named like an adapter for few steps")
    assert first.endswith("now: 2 steps, guidance 3")
    heard.lines.clear()
    build(models("wan"), lora=(str(fast),), guidance=1.0).generate(PROMPT, progress=heard)
    assert not any("few steps" in line for line in heard.lines)
