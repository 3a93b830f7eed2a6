"""Learned generators end to end: pipelines of the real classes with tiny random weights.

Everything but the weights is real: saved by `save_pretrained`, found, checked, loaded, called and
decoded by the code that runs the published models. Offline.
"""

import dataclasses
import json
import shutil
import sys
import threading
from dataclasses import replace
from types import SimpleNamespace

import av
import numpy as np
import pytest

pytestmark = [
    pytest.mark.torch,
    pytest.mark.usefixtures("model_cache"),
    # Of the Karras noise schedule in diffusers 0.42.1 under NumPy 2; texvent cannot change it.
    pytest.mark.filterwarnings("ignore:__array__ implementation:DeprecationWarning"),
]
torch = pytest.importorskip("torch")
pytest.importorskip("diffusers")

from texvent._registry import GENERATORS  # noqa: E402
from texvent.errors import (  # noqa: E402
    ConfigError,
    FileFormatError,
    InputError,
    MissingDependencyError,
    TexventError,
    warnings_to,
)
from texvent.generation.diffusers_models import generator as diffusers_generator  # noqa: E402
from texvent.generation.diffusers_models import guardrail, pipeline_loading  # noqa: E402
from texvent.generation.diffusers_models.pipeline_call import check_options  # noqa: E402
from texvent.generation.diffusers_models.pipeline_loading import (  # noqa: E402
    LoadRequest,
    Placement,
    load_pipeline,
)
from texvent.generation.video_models.config import DiffusersConfig  # noqa: E402
from texvent.generation.video_models.known_models import MODELS  # noqa: E402
from texvent.pipeline import text_to_events  # noqa: E402
from texvent.runtime.work.side_work import finish_side_work  # noqa: E402
from texvent.settings.resolution import resolve  # noqa: E402
from texvent.simulation.gpu.support import RunDevice  # noqa: E402

from ..tiny_models import OPTIONS, PROMPT, build, pixels  # noqa: E402
from ..watcher import Watcher  # noqa: E402


@pytest.mark.parametrize("name", ["wan", "cosmos", "ltx"])
def test_prompt_to_events_and_a_second_run_does_not_call_the_pipeline(name, models, monkeypatch):
    options = {**OPTIONS, "generator": str(models(name)), "seed": 3, "interpolate": "blend"}
    watcher = Watcher()
    events = text_to_events(
        PROMPT, resolve("generate", options), progress=watcher
    ).packets.collect()
    assert watcher.steps == [("denoise", 1, 2), ("denoise", 2, 2)]
    source = events.metadata["source"]
    assert source["prompt"] == PROMPT
    assert source["seed"] == 3
    index = json.loads((models(name) / "model_index.json").read_text())
    assert source["pipeline"] == index["_class_name"]
    assert events.size == (32, 32)
    assert events.t.max(initial=0) < 500_000

    def forbidden(*_, **__):
        raise AssertionError("the pipeline was called again")

    monkeypatch.setattr(diffusers_generator, "call_pipeline", forbidden)
    changed = {**options, "contrast_threshold": 0.01, "noise": "none"}
    more = text_to_events(PROMPT, resolve("generate", changed)).packets.collect()
    assert len(more) > len(events)
    for other in ({"seed": 4}, {"steps": 3}):
        with pytest.raises(AssertionError, match="called again"):
            text_to_events(PROMPT, resolve("generate", {**options, **other}))


@pytest.fixture
def disk(monkeypatch):
    """Files of videos are opened when they may be, and read if that is allowed."""
    state, real = SimpleNamespace(go=threading.Event(), reads=False, error=None), av.open

    def open_file(file, mode="r", **options):
        assert mode == "w" or state.reads, "a video was read back"
        assert state.go.wait(300)
        if state.error is not None:
            raise state.error
        return real(file, mode, **options)

    monkeypatch.setattr(av, "open", open_file)
    yield state
    state.go.set()


def run_of(path, **options):
    given = {"generator": str(path), "interpolate": "blend", "contrast_threshold": 0.01}
    return text_to_events(PROMPT, resolve("generate", {**OPTIONS, **given, **options}))


def test_events_do_not_wait_for_the_file_and_are_those_of_the_file(models, model_cache, disk):
    run = run_of(models("wan"), device="cpu", noise="none", max_intermediate=1)
    there = replace(run, device=RunDevice(torch.device("cpu")))
    made = [one.packets.collect() for one in (run, there)]
    assert list(model_cache.glob("videos/[!.]*.avi")) == []
    disk.go.set()
    disk.reads = True
    read = run_of(models("wan"), noise="none", max_intermediate=1).packets.collect()
    assert len(list(model_cache.glob("videos/[!.]*.avi"))) == 1
    assert len(read) > 0
    for events in made:
        assert events == read
        assert events.metadata["source"] == read.metadata["source"]


def test_without_reuse_no_file_is_written(models, model_cache, disk):
    run_of(models("wan"), reuse_video=False).packets.collect()
    finish_side_work()
    assert list(model_cache.glob("**/*.*")) == []


def test_a_file_that_cannot_be_written_costs_no_event(models, model_cache, disk):
    disk.error = OSError(28, "No space left on device")
    disk.go.set()
    said = []
    with warnings_to(said.append):
        events = run_of(models("wan")).packets.collect()
        finish_side_work()
    assert len(events) > 0
    assert "the disk is full" in said[0]
    assert list(model_cache.glob("**/*.*")) == []


def test_another_negative_prompt_is_another_video(models):
    first, other = (
        pixels(build(models("wan"), negative_prompt=text).generate(PROMPT))
        for text in (None, "dark")
    )
    assert not np.array_equal(first, other)


@pytest.mark.parametrize(
    ("name", "asked", "made"),
    [
        *(("wan", 8, 9), ("cosmos25", 6, 6), ("cogvideox", 6, 8)),
    ],
)
def test_the_real_frame_count_is_used_and_reported(name, asked, made, models):
    watcher = Watcher()
    video = build(models(name), frames=asked).generate(PROMPT, progress=watcher)
    assert video.frame_count == len(list(video)) == made
    is_told = any(f"made {made} frames, not {asked}" in line for line in watcher.lines)
    assert is_told == (made != asked)


def test_cancelling_between_steps_leaves_nothing_and_the_next_run_works(models, model_cache):
    generator = build(models("wan"))
    with pytest.raises(KeyboardInterrupt):
        generator.generate(PROMPT, progress=Watcher(stop_at=1))
    assert list((model_cache / "videos").glob("*")) == []
    assert generator.generate(PROMPT).frame_count >= 5


def test_a_batch_of_new_and_known_prompts_loads_its_model_once(models, monkeypatch):
    loaded = []
    real = pipeline_loading._load
    monkeypatch.setattr(
        pipeline_loading, "_load", lambda *given: loaded.append(given) or real(*given)
    )
    watcher = Watcher()
    for prompt, seed in ((PROMPT, 3), (PROMPT, 4), ("a blue dog", 3), (PROMPT, 5)):
        build(models("wan"), seed=seed).generate(prompt, progress=watcher)
    assert len(loaded) == 1
    assert [line.split()[0] for line in watcher.lines] == ["loading"]


def test_the_frame_rate_is_an_input_of_cosmos_and_only_a_clock_for_wan(models):
    slow, fast = (build(models("cosmos"), fps=fps).generate(PROMPT) for fps in (8, 30))
    assert not np.array_equal(pixels(slow), pixels(fast))
    slow, fast = (build(models("wan"), fps=fps).generate(PROMPT) for fps in (8, 30))
    assert np.array_equal(pixels(slow), pixels(fast))
    assert [frame.t_us for frame in fast][1] == 33_333


def test_the_decoder_of_wan_stays_in_float32_as_its_page_asks(models):
    path = models("wan")
    assert MODELS["wan-1.3b"].needs_float32_vae
    placement = Placement("cpu", "bfloat16", "none", tiles_decoder=False)
    pipe = load_pipeline(LoadRequest(path, "", None, placement, decoder_in_float32=True))
    assert (pipe.transformer.dtype, pipe.vae.dtype) == (torch.bfloat16, torch.float32)


def test_an_image_starts_the_video_where_the_pipeline_can(models, tmp_path):
    from PIL import Image

    Image.new("RGB", (200, 100), "red").save(tmp_path / "start.png")
    with_image = build(models("cosmos25"), image=tmp_path / "start.png").generate(PROMPT)
    assert not np.array_equal(
        pixels(with_image), pixels(build(models("cosmos25")).generate(PROMPT))
    )
    watcher = Watcher()
    with pytest.raises(ConfigError, match="starts from text alone"):
        build(models("wan"), image=tmp_path / "start.png").generate(PROMPT, progress=watcher)
    assert watcher.lines == [], "refused before anything was loaded"
    with pytest.raises(InputError, match="there is no image"):
        build(models("cosmos25"), image=tmp_path / "none.png").generate(PROMPT)
    (tmp_path / "bad.png").write_bytes(b"no image")
    with pytest.raises(InputError, match="cannot be read as an image"):
        build(models("cosmos25"), image=tmp_path / "bad.png").generate(PROMPT)


def test_an_image_starts_wan_through_its_other_pipeline_with_the_same_weights(models, tmp_path):
    from PIL import Image

    folder = tmp_path / "Wan2.2-TI2V-5B-Diffusers"
    shutil.copytree(models("wan"), folder)
    index = json.loads((folder / "model_index.json").read_text())
    (folder / "model_index.json").write_text(json.dumps({**index, "expand_timesteps": True}))
    first_frames = []
    for colour in ("red", "blue"):
        Image.new("RGB", (200, 100), colour).save(tmp_path / f"{colour}.png")
        video = build(folder, image=tmp_path / f"{colour}.png").generate(PROMPT)
        assert video.metadata["pipeline"] == "WanImageToVideoPipeline"
        first_frames.append(pixels(video)[0])
    assert not np.array_equal(*first_frames)
    assert build(folder).generate(PROMPT).metadata["pipeline"] == "WanPipeline"


def test_the_middle_of_an_image_is_fitted_to_the_video_and_noted(models, tmp_path):
    """A band at each side is cut away; a camera's note that the image is turned is followed."""
    from PIL import Image

    folder = tmp_path / "LTX-Video"
    shutil.copytree(models("ltx"), folder)
    rng = np.random.default_rng(0)
    middle = rng.integers(0, 255, (32, 32, 3), dtype=np.uint8)
    wide = np.concatenate((np.zeros((32, 16, 3), np.uint8), middle, middle[:, :16]), axis=1)
    exif = b"Exif\0\0MM\0*\0\0\0\x08\0\1\1\x12\0\3\0\0\0\1\0\6\0\0\0\0\0\0"
    Image.fromarray(middle).save(tmp_path / "middle.png")
    Image.fromarray(wide).save(tmp_path / "wide.png")
    Image.fromarray(np.rot90(middle, 1).copy()).save(tmp_path / "turned.png", exif=exif)
    Image.fromarray(255 - middle).save(tmp_path / "other.png")
    made = {}
    for name in ("middle", "wide", "turned", "other"):
        image = tmp_path / f"{name}.png"
        video = build(folder, image=image).generate(PROMPT)
        made[name] = pixels(video)
        assert video.metadata["pipeline"] == "LTXImageToVideoPipeline"
        assert video.metadata["files"][0]["file"] == str(image)
        assert len(video.metadata["files"][0]["sha256"]) == 64
    assert np.array_equal(made["middle"], made["wide"])
    assert np.array_equal(made["middle"], made["turned"])
    assert not np.array_equal(made["middle"], made["other"])


def test_the_guardrail_sees_the_prompt_and_every_frame(models):
    import cosmos_guardrail

    checker = cosmos_guardrail.CosmosSafetyChecker
    for name in ("cosmos", "cosmos25"):
        before = checker.checked_frames
        video = build(models(name)).generate(PROMPT)
        assert checker.checked_frames == before + 5
        assert video.metadata["guardrail"] == "0.0.0"
        with pytest.raises(InputError, match="guardrail blocks this prompt"):
            build(models(name)).generate("a weapon")


def test_an_error_inside_the_guardrail_counts_as_a_refusal(models):
    watcher = Watcher()
    with pytest.raises(TexventError, match="guardrail failed"):
        build(models("cosmos")).generate("break it", progress=watcher)
    assert watcher.steps == []


def test_cosmos_does_not_run_without_its_guardrail(models, monkeypatch):
    monkeypatch.setitem(sys.modules, "cosmos_guardrail", None)
    with pytest.raises(MissingDependencyError, match=r"texvent\[cosmos\]"):
        build(models("cosmos")).generate(PROMPT)


def test_a_pipeline_that_would_not_ask_its_guardrail_is_refused(models, monkeypatch):
    from diffusers.pipelines.cosmos import pipeline_cosmos2_5_predict

    monkeypatch.setattr(pipeline_cosmos2_5_predict, "CosmosSafetyChecker", type("Other", (), {}))
    with pytest.raises(TexventError, match="does not use its guardrail"):
        build(models("cosmos25")).generate(PROMPT)


def test_a_guardrail_whose_weights_are_missing_stops_everything(models, monkeypatch):
    import cosmos_guardrail

    def gated(self):
        raise OSError("403: accept the terms")

    monkeypatch.setattr(cosmos_guardrail.CosmosSafetyChecker, "__init__", gated)
    with pytest.raises(TexventError, match="must not run without it: 403"):
        build(models("cosmos")).generate(PROMPT)
    assert guardrail.needs_guardrail({"_class_name": "Cosmos3OmniPipeline"})


def test_offline_the_missing_file_and_its_place_are_named_after_the_licence(capsys):
    watcher = Watcher()
    part = GENERATORS.load("wan-1.3b")
    generator = part(part.config_type(), seed=0, size=None)
    with pytest.raises(TexventError, match=r"model_index.json and .*Fetch them") as caught:
        generator.generate(PROMPT, progress=watcher)
    assert "generator=./FOLDER" in str(caught.value)
    read = "licence: Apache-2.0 (read in github.com/Wan-Video/Wan2.1: README.md;"
    assert read in watcher.lines[0]
    with pytest.raises(TexventError):
        build("hub:org/name").generate(PROMPT, progress=watcher)
    assert watcher.lines[1].endswith("licence: not known to texvent; read the model's page")
    assert "stacktrace" not in str(caught.value)
    assert capsys.readouterr() == ("", "")


def test_a_plan_says_what_is_to_be_done_and_ends_when_the_video_is_there(models):
    generator = build(models("wan"))
    plan = generator.plan(PROMPT)
    assert "5 frames, 2 steps" in plan
    assert str(models("wan")) in plan
    generator.generate(PROMPT)
    assert generator.plan(PROMPT) is None
    part = GENERATORS.load("cosmos-7b")
    absent = part(part.config_type(), seed=0, size=None).plan(PROMPT)
    assert "it has to be fetched first; licence: NVIDIA Open Model License" in absent
    assert "GPU memory 74 GB, 24.4 GB with --offload model, torch finds" in absent
    assert absent.endswith("; download not known, time not known")
    part = GENERATORS.load("wan-1.3b")
    for options, told in (({}, "4090"), ({"width": 416}, "(for 81 frames of 832x480, 50 steps)")):
        config = dataclasses.replace(part.config_type(), **options)
        assert part(config, seed=0, size=None).plan(PROMPT).endswith(told)


def test_damaged_weights_are_one_line(models, tmp_path):
    path = tmp_path / "damaged"
    shutil.copytree(models("wan"), path)
    file = next((path / "transformer").glob("*.safetensors"))
    file.write_bytes(file.read_bytes()[:-9])
    with pytest.raises(FileFormatError, match="damaged cannot be loaded as WanPipeline") as caught:
        build(path).generate(PROMPT)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("part", ["transformer", "text_encoder", "vae"])
def test_weights_that_a_file_lacks_are_named_instead_of_drawn(part, models, model_cache, tmp_path):
    files = pytest.importorskip("safetensors.torch")
    path = tmp_path / "incomplete"
    shutil.copytree(models("wan"), path)
    file = next((path / part).glob("*.safetensors"))
    tensors = files.load_file(file)
    lost = max(tensors, key=lambda name: (name.endswith("weight"), "norm" in name, name))
    del tensors[lost]
    files.save_file(tensors, file, metadata={"format": "pt"})
    with pytest.raises(FileFormatError, match=rf"lacks weights of WanPipeline, {lost}, which"):
        build(path).generate(PROMPT)
    assert not [one for one in model_cache.rglob("*") if one.is_file()]


def test_a_text_encoder_that_knows_no_word_is_refused(models, tmp_path):
    files = pytest.importorskip("safetensors.torch")
    path = tmp_path / "wordless"
    shutil.copytree(models("wan"), path)
    file = next((path / "text_encoder").glob("*.safetensors"))
    tensors = files.load_file(file)
    tensors["shared.weight"].zero_()
    files.save_file(tensors, file, metadata={"format": "pt"})
    with pytest.raises(FileFormatError, match="embedding of text_encoder is all 0"):
        build(path).generate(PROMPT)


def test_options_are_compared_with_what_a_pipeline_takes():
    class FromImages:
        def __call__(self, image, prompt=None, num_frames=8):
            return image, prompt, num_frames

    assert "num_frames" in check_options(FromImages, DiffusersConfig(image="a.png", frames=9))
    with pytest.raises(ConfigError, match="FromImages starts from an image; give image=PATH"):
        check_options(FromImages, DiffusersConfig())
    with pytest.raises(ConfigError, match="steps is set, but FromImages does not take it"):
        check_options(FromImages, DiffusersConfig(image="a.png", steps=5))
