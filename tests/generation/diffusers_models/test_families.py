"""A tiny pipeline of every family of the table, from its files to frames.

Saved by `save_pretrained`; found, checked, loaded, called and decoded by the code that runs the
published models. Offline.
"""

import shutil

import numpy as np
import pytest

pytestmark = [
    pytest.mark.torch,
    pytest.mark.usefixtures("model_cache"),
    # Of noise schedules in diffusers 0.42.1 under NumPy 2; texvent cannot change it.
    pytest.mark.filterwarnings("ignore:__array_:DeprecationWarning"),
]
torch = pytest.importorskip("torch")
pytest.importorskip("diffusers")


from texvent.errors import ConfigError, FileFormatError, InputError  # noqa: E402

from .. import tiny_pipelines  # noqa: E402
from ..tiny_families import FAMILIES  # noqa: E402
from ..tiny_models import PROMPT, build, pixels  # noqa: E402
from ..watcher import Watcher  # noqa: E402


@pytest.fixture
def start_image(tmp_path):
    from PIL import Image

    path = tmp_path / "start.png"
    Image.fromarray(np.random.default_rng(0).integers(0, 255, (48, 64, 3), np.uint8)).save(path)
    return path


@pytest.fixture
def make(models, start_image):
    """Make a family's video with some seed and options; the steps it reported."""

    def run(name, seed=3, **options):
        family = FAMILIES[name]
        image = {"image": start_image} if family.takes_image else {}
        watcher = Watcher()
        generator = build(models(name), seed=seed, **{**family.options, **image, **options})
        return generator.generate(PROMPT, progress=watcher), watcher.steps

    return run


@pytest.mark.parametrize("name", FAMILIES)
def test_every_family_goes_from_its_files_to_frames(name, make):
    family = FAMILIES[name]
    video, steps = make(name)
    frames = pixels(video)
    assert video.metadata["pipeline"] == family.pipeline
    assert frames.shape == (family.frames, family.side, family.side, 3)
    assert frames.std(axis=(1, 2, 3)).min() > 0, "every frame shows something"
    assert steps == [("denoise", step + 1, family.steps) for step in range(family.steps)]


def test_guidance_reaches_pipelines_that_keep_it_in_a_guider(make):
    name = "hunyuan15"
    weak, strong = (pixels(make(name, guidance=scale)[0]) for scale in (1.5, 20.0))
    assert not np.array_equal(weak, strong)
    again = pixels(make(name, guidance=1.5, reuse_video=False)[0])
    assert np.array_equal(weak, again), "the scale of one call does not stay for the next"


@pytest.mark.parametrize("name", ["cosmos3", "ltx2-distilled"])
def test_the_frame_rate_is_an_input_of_cosmos_3_and_ltx(make, name):
    slow, fast = (pixels(make(name, fps=fps)[0]) for fps in (24, 50))
    assert not np.array_equal(slow, fast)


def test_the_guardrail_of_cosmos_3_stays_on_whatever_its_index_says(models, make):
    import json

    import cosmos_guardrail

    path = models("cosmos3") / "model_index.json"
    index = json.loads(path.read_text())
    path.write_text(json.dumps({**index, "enable_safety_checker": False}))
    before = cosmos_guardrail.CosmosSafetyChecker.checked_frames
    video, _ = make("cosmos3", seed=11)
    path.write_text(json.dumps(index))
    assert cosmos_guardrail.CosmosSafetyChecker.checked_frames == before + video.frame_count
    with pytest.raises(InputError, match="guardrail blocks this prompt"):
        build(models("cosmos3")).generate("a weapon")


H3 = FAMILIES["minimax-h3"].options


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ({"frames": 100}, "frames is 100; .*MiniMax-H3 makes 120 to 345 frames"),
        ({"width": 40}, "width is 40; .*MiniMax-H3 takes multiples of 32"),
        ({"guidance": 3.0}, "guidance is set, but MiniMaxH3ModularPipeline does not take it"),
        ({"negative_prompt": "dark"}, "negative_prompt is set, but MiniMaxH3ModularPipeline"),
    ],
)
def test_what_minimax_h3_does_not_take_is_refused_before_it_is_loaded(models, options, said):
    watcher = Watcher()
    with pytest.raises(ConfigError, match=said):
        build(models("minimax-h3"), **{**H3, **options}).generate(PROMPT, progress=watcher)
    assert watcher.lines == []


def test_parts_of_a_modular_pipeline_that_lack_or_are_damaged_are_named(models, tmp_path):
    folder = shutil.copytree(models("minimax-h3"), tmp_path / "MiniMax-H3")
    weights = next((folder / "vae").glob("*.safetensors"))
    weights.write_bytes(b"no weights")
    with pytest.raises(FileFormatError, match=r"MiniMax-H3 cannot be loaded .* vae") as told:
        build(folder, **H3).generate(PROMPT)
    assert "\n" not in str(told.value)
    weights.unlink()
    with pytest.raises(InputError, match=r"lacks its weights in .*vae"):
        build(folder, **H3).generate(PROMPT)
    shutil.rmtree(folder / "vae")
    with pytest.raises(InputError, match=r"lacks the folder .*vae "):
        build(folder, **H3).generate(PROMPT)


def test_a_lora_reaches_minimax_h3_and_one_of_another_model_is_refused(models, make, tmp_path):
    from safetensors.torch import load_file, save_file

    weights = load_file(next((models("minimax-h3") / "transformer").glob("*.safetensors")))
    layer = next(name for name in weights if name.endswith("to_q.weight"))
    rows, columns = weights[layer].shape
    path = tmp_path / "fast.safetensors"
    name = f"transformer.{layer.removesuffix('.weight')}.lora_"
    for size in (columns, columns + 1):
        factors = {"A": torch.ones(2, size), "B": torch.ones(rows, 2)}
        save_file({f"{name}{one}.weight": factor for one, factor in factors.items()}, path)
        if size == columns:
            plain, other = (pixels(make("minimax-h3", lora=one)[0]) for one in ((), (str(path),)))
            assert not np.array_equal(plain, other)
    with pytest.raises(FileFormatError, match=f"is {rows}x{columns + 1} in it, and not {rows}x"):
        make("minimax-h3", lora=(str(path),))


def test_the_turbo_lora_of_minimax_h3_runs_at_its_own_noise_levels(models, tmp_path, monkeypatch):
    from safetensors.torch import load_file, save_file

    folder = shutil.copytree(models("minimax-h3"), tmp_path / "minimax-h3-turbo")
    weights = load_file(next((folder / "transformer").glob("*.safetensors")))
    layer = next(name for name in weights if name.endswith("to_q.weight"))
    rows, columns = weights[layer].shape
    name = f"transformer.{layer.removesuffix('.weight')}.lora_"
    factors = {f"{name}A.weight": torch.ones(2, columns), f"{name}B.weight": torch.ones(rows, 2)}
    save_file(factors, folder / "minimax_h3_fl2v_turbo_4step_v1.0_768p_bf16.safetensors")
    levels = []
    kind = tiny_pipelines.diffusers.MiniMaxH3Scheduler
    real = kind.set_timesteps

    def note(self, *args, **named):
        real(self, *args, **named)
        levels.append(self.sigmas.tolist())

    monkeypatch.setattr(kind, "set_timesteps", note)
    made = build(folder, **H3, steps=5).generate(PROMPT)
    assert len(made.metadata["lora_sha256"]) == 1
    base = np.array([1, 0.75, 0.5, 0.25, 0])
    for found, shift in zip(levels, (6, 3), strict=True):  # frames, then sound
        assert np.allclose(found, shift * base / (1 + (shift - 1) * base))


TEMPORAL = FAMILIES["ltx2-temporal"].options
SPACE, TIME = (
    f"ltx-2.5-latent-{one}-upscaler-x2-bf16-1.0.safetensors" for one in ("spatial", "temporal")
)


def test_stages_of_twice_the_frames_are_those_of_their_publisher(make, monkeypatch):
    """Frame rate that the network is told, noise and tokens of every step, computed by hand.

    17 frames at half size are 9 latent ones of 4x4 and two keyframes; then of 8x8; then two pieces
    of the 17 latent frames that these become, between keyframes at 8 and 16: 9 of them with the
    first keyframe and a new one before it; all of them, for the second starts a keyframe early,
    with both and two new ones.
    """
    steps = []
    kind = tiny_pipelines.diffusers.LTX2VideoTransformer3DModel
    real = kind.forward

    def note(self, hidden_states, *args, **named):
        steps.append((named["fps"], round(float(named["sigma"][0])), hidden_states.shape[1]))
        return real(self, hidden_states, *args, **named)

    monkeypatch.setattr(kind, "forward", note)
    make("ltx2-temporal")
    first = [(25, level, 16 * (9 + 2)) for level in (1000, 994, 988, 981, 975, 909, 725, 422)]
    second = [(25, level, 64 * (9 + 2)) for level in (909, 725, 422)]
    assert steps[:11] == first + second
    levels = [975, 909, 725, 422]
    assert [one[:2] for one in steps[11:]] == [(60, level) for level in 2 * levels]
    tokens = [one[2] for one in steps[11:]]
    assert tokens == 4 * [64 * (9 + 1 + 1)] + 4 * [64 * (17 + 2 + 2)]


@pytest.mark.parametrize("file", [SPACE, TIME])
def test_both_upscalers_count_and_one_that_lacks_or_is_another_is_one_line(models, tmp_path, file):
    from safetensors.torch import load_file, save_file

    folder = shutil.copytree(models("ltx2-temporal"), tmp_path / "ltx2.5-temporal")
    usual = build(folder, **TEMPORAL).generate(PROMPT)
    assert len(usual.metadata["temporal_latent_upsampler_sha256"]) == 64
    weights = load_file(folder / file)
    save_file(weights | {"final_conv.bias": weights["final_conv.bias"] + 1}, folder / file)
    other = build(folder, **TEMPORAL).generate(PROMPT)
    assert not np.array_equal(pixels(usual), pixels(other))
    fewer = {name: one for name, one in weights.items() if not name.startswith("final")}
    wider = {"initial_conv.weight": torch.zeros(32, 5, 3, 3, 3)}
    watcher = Watcher()
    for content, error, said in (
        (
            load_file(folder / (TIME if file == SPACE else SPACE)),
            FileFormatError,
            "is no upscaler in",
        ),
        (weights | wider, FileFormatError, "takes latents of 5 channels, and .* makes 4"),
        ({"other": torch.zeros(1)}, FileFormatError, "holds no upscaler that doubles latents"),
    ):
        save_file(content, folder / file)
        with pytest.raises(error, match=said) as told:
            build(folder, **TEMPORAL).generate(PROMPT, progress=watcher)
        assert "\n" not in str(told.value)
    (folder / file).unlink()
    with pytest.raises(InputError, match=f"lacks the upscaler .*{file}, of Lightricks/.*put the"):
        build(folder, **TEMPORAL).plan(PROMPT)
    assert watcher.lines == [], "refused before anything was loaded"
    save_file(fewer, folder / file)
    with pytest.raises(FileFormatError, match="cannot be loaded as an upscaler of latents"):
        build(folder, **TEMPORAL).generate(PROMPT)


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ({"frames": 40}, "frames is 40; .* takes multiples of 16 and one more, such as 33"),
        ({"width": 96}, "width is 96; .* takes multiples of 64"),
        ({"steps": 8}, "steps is set, but LTX2DFRTemporalRefinePipeline does not take it"),
        ({"negative_prompt": "dark"}, "negative_prompt is set, but LTX2DFRTemporalRefinePipeline"),
    ],
)
def test_what_twice_the_frames_do_not_take_is_refused_before_they_are_loaded(models, options, said):
    watcher = Watcher()
    with pytest.raises(ConfigError, match=said):
        build(models("ltx2-temporal"), **{**TEMPORAL, **options}).generate(PROMPT, progress=watcher)
    assert watcher.lines == []


def test_a_network_without_keyframes_makes_no_frames_in_between(models, tmp_path):
    folder = shutil.copytree(models("ltx2-temporal"), tmp_path / "ltx2.5-temporal")
    shutil.rmtree(folder / "transformer")
    shutil.copytree(models("ltx2-distilled") / "transformer", folder / "transformer")
    with pytest.raises(InputError, match="a network that makes no keyframes"):
        build(folder, **TEMPORAL).plan(PROMPT)


def test_fifty_frames_per_second_start_from_an_image_and_become_events(models, start_image):
    from texvent.pipeline import text_to_events
    from texvent.settings.resolution import resolve

    of_run = {**TEMPORAL, "generator": str(models("ltx2-temporal")), "on_failure": "ignore"}
    video = {}
    for image in (None, str(start_image)):
        of_image = {} if image is None else {"image": image}
        run = text_to_events(PROMPT, resolve("generate", {**of_run, **of_image, "sensor": "24x16"}))
        events = run.packets.collect()
        assert len(events) > 0
        assert events.size == (24, 16)
        assert [frame.t_us for frame in run.video] == list(range(0, 33 * 20_000, 20_000))
        video[image] = pixels(run.video)
    assert not np.array_equal(*video.values())
