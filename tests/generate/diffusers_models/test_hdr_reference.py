"""LTX-2's HDR pipeline, tiny and random in the published layout: a video in, light out."""

import dataclasses
import os
from fractions import Fraction

import numpy as np
import pytest

pytestmark = [
    pytest.mark.torch,
    pytest.mark.usefixtures("model_cache"),
    # Of noise schedules in diffusers 0.42.1 under NumPy 2; texvent cannot change it.
    pytest.mark.filterwarnings("ignore:__array_:DeprecationWarning"),
]
os.environ["HF_HUB_OFFLINE"] = "1"
torch = pytest.importorskip("torch")
torch.set_num_threads(1)  # tiny arrays: more threads only wait for each other
pytest.importorskip("diffusers")
pytest.importorskip("peft")

from safetensors.torch import load_file, save_file  # noqa: E402

import texvent  # noqa: E402
from texvent.cli.app import main  # noqa: E402
from texvent.errors import ConfigError, FileFormatError, InputError, TexventWarning  # noqa: E402
from texvent.generate.video_models.known_models import MODELS  # noqa: E402
from texvent.generate.videos.stored_video import reopen, write_video  # noqa: E402
from texvent.video import transfer_of  # noqa: E402

from .. import tiny_pipelines  # noqa: E402
from ..tiny_families import ltx2  # noqa: E402
from ..tiny_models import OPTIONS, PROMPT, build, pixels  # noqa: E402

ROW = "ltx2.3-hdr"
MODEL = ("--simulator", "esim", "--backend", "reference", "--interpolate", "none")
MODELS_AS_SHIPPED = dict(MODELS)
MATRIX = "transformer_blocks.0.attn1.to_q"


@pytest.fixture(scope="module")
def weights(tmp_path_factory):
    """LTX-2 as its repository has it, with a decoder whose codes reach the light above white."""
    folder = tmp_path_factory.mktemp("hdr") / "model"
    with tiny_pipelines.random_weights():
        pipe = ltx2()
        with torch.no_grad():
            pipe.vae.decoder.conv_out.conv.bias += 0.8
        pipe.save_pretrained(folder, safe_serialization=True)
    return folder


@pytest.fixture(scope="module")
def adapter(weights, tmp_path_factory):
    """An adapter of one matrix, with values that change pixels."""
    saved = load_file(next((weights / "transformer").glob("*.safetensors")))
    rows, columns = saved[f"{MATRIX}.weight"].shape
    draw = torch.Generator().manual_seed(1)
    path = tmp_path_factory.mktemp("adapter") / "hdr.safetensors"
    pair = {"A": torch.randn(2, columns, generator=draw), "B": torch.randn(rows, 2, generator=draw)}
    save_file({f"transformer.{MATRIX}.lora_{one}.weight": pair[one] for one in pair}, path)
    return path


def write_clip(path, frames, *, seed=0, fps=16, **facts):
    values = np.random.default_rng(seed).random((frames, 36, 64, 3), np.float32)
    write_video(values, path, Fraction(fps), facts, overwrite=True)
    return path


@pytest.fixture
def clip(tmp_path):
    return write_clip(tmp_path / "clip.avi", 5)


@pytest.fixture
def hdr(weights, adapter, monkeypatch):
    """Build the row's generator on the tiny weights and adapter."""
    row = dataclasses.replace(MODELS[ROW], folder=weights, lora=(str(adapter),))
    monkeypatch.setitem(MODELS, ROW, row)

    def make(**options):
        return build(ROW, **{"guidance": 1.0, **options})

    return make


def test_the_row_names_the_adapter_and_the_options_add_others(adapter, hdr):
    (own,) = MODELS_AS_SHIPPED[ROW].lora
    assert own.startswith("hub:Lightricks/LTX-2.3-22b-IC-LoRA-HDR/")
    assert hdr().config.lora == (str(adapter),)
    assert hdr(lora=("style.safetensors:0.5",)).config.lora == (
        str(adapter),
        "style.safetensors:0.5",
    )


def test_a_reference_becomes_light_above_white_and_stays_so_in_the_cache(hdr, clip):
    made = hdr(reference_video=clip, steps=8).generate(PROMPT)
    frames = pixels(made)
    assert made.metadata["pipeline"] == "LTX2HDRPipeline"
    assert transfer_of(made) == "linear"
    assert frames.dtype == np.float32
    assert frames.shape == (5, 32, 32, 3)
    assert frames.max() > 255, "brighter than white"
    assert frames.std(axis=(1, 2, 3)).min() > 0
    files = {one["file"]: one["sha256"] for one in made.metadata["files"]}
    assert len(files[str(clip)]) == 64
    again = hdr(reference_video=clip, steps=8)
    assert again.plan(PROMPT) is None, "found in the cache"
    assert np.array_equal(pixels(again.generate(PROMPT)), frames)


def test_seed_reference_and_adapter_decide_the_frames(hdr, adapter, clip, tmp_path):
    first = pixels(hdr(reference_video=clip, reuse_video=False).generate(PROMPT))
    same = pixels(hdr(reference_video=clip, reuse_video=False).generate(PROMPT))
    assert np.array_equal(first, same)
    other_clip = write_clip(tmp_path / "other.avi", 5, seed=1)
    for options in (
        {"reference_video": other_clip},
        {"reference_video": clip, "seed": 4},
        {"reference_video": clip, "lora": (f"{adapter}:0.1",)},
    ):
        assert not np.array_equal(first, pixels(hdr(**options).generate(PROMPT))), options


def test_only_the_frames_that_are_made_are_followed_fitted_to_their_size(hdr, clip, tmp_path):
    """Those after them, and the sides of a wider video, change nothing."""
    values = np.random.default_rng(2).random((7, 32, 32, 3), np.float32)
    wide = np.concatenate((values[..., :16, :], values, values[..., 16:, :]), axis=2)
    paths = (tmp_path / "exact.avi", tmp_path / "wide.avi")
    for path, frames in zip(paths, (values[:5], wide), strict=True):
        write_video(frames, path, Fraction(16), {}, overwrite=True)
    exact, cut = (pixels(hdr(reference_video=path).generate(PROMPT)) for path in paths)
    assert np.array_equal(exact, cut)
    values[5:] = 0
    write_video(values, paths[0], Fraction(16), {}, overwrite=True)
    six = [pixels(hdr(reference_video=path, frames=6).generate(PROMPT)) for path in paths]
    assert len(six[0]) == 5
    assert np.array_equal(*six), "six cannot be made: five are made and followed"


def test_another_rate_than_the_reference_is_told(hdr, tmp_path):
    fast = write_clip(tmp_path / "fast.avi", 5, fps=30)
    with pytest.warns(TexventWarning, match=r"30 frames per second.*give fps=30 to keep it"):
        hdr(reference_video=fast).generate(PROMPT)


def test_what_cannot_be_followed_is_refused_before_anything_is_loaded(hdr, models, tmp_path):
    short = write_clip(tmp_path / "short.avi", 3)
    light = write_clip(tmp_path / "light.avi", 5, transfer="linear")
    text = tmp_path / "note.mp4"
    text.write_text("no video")
    for path, kind, message in (
        (None, ConfigError, "LTX2HDRPipeline follows a video; give reference_video=FILE"),
        (tmp_path / "none.mp4", InputError, "no such video"),
        (tmp_path, FileFormatError, "cannot be read"),
        (text, FileFormatError, "cannot be read"),
        (short, InputError, "has 3 frames, and 5 are to be made; .*frames=3"),
        (light, InputError, "is linear light; the model follows ordinary video"),
    ):
        generator = hdr(reference_video=path)
        with pytest.raises(kind, match=message):
            generator.generate(PROMPT)
        assert generator._run is None, "nothing was loaded"
    other = build(models("ltx"), reference_video=short, frames=3)
    with pytest.raises(ConfigError, match="reference_video is set, but LTXPipeline follows none"):
        other.generate(PROMPT)


def test_events_of_light_are_made_and_replayed_by_the_command(hdr, clip, tmp_path, capsys):
    out = tmp_path / "events.h5"
    options = {**OPTIONS, "guidance": 1.0, "seed": 3}
    options |= {"generator": ROW, "reference_video": clip, "out": out}
    flags = [(f"--{name.replace('_', '-')}", str(value)) for name, value in options.items()]
    assert main(["generate", PROMPT, *MODEL, *sum(flags, ())]) == 0
    events = texvent.load(out)
    assert len(events) > 0
    assert events.metadata["source"]["transfer"] == "linear"
    again = tmp_path / "again.h5"
    assert main(["replay", str(out), "--out", str(again)]) == 0
    assert np.array_equal(texvent.load(again).x, events.x)
    write_clip(clip, 5, seed=9)
    capsys.readouterr()
    assert main(["replay", str(out), "--out", str(tmp_path / "third.h5")]) != 0
    assert "clip.avi" in capsys.readouterr().err
    assert reopen(clip) is not None
