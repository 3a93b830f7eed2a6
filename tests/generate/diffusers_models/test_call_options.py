"""Steps, guidance and image reach the call of every pipeline, or are refused."""

import inspect
import os
import shutil
from fractions import Fraction

import numpy as np
import pytest

pytestmark = [pytest.mark.torch, pytest.mark.usefixtures("model_cache")]
os.environ["HF_HUB_OFFLINE"] = "1"
torch = pytest.importorskip("torch")
torch.set_num_threads(1)  # tiny arrays: more threads only wait for each other
diffusers = pytest.importorskip("diffusers")

from PIL import Image  # noqa: E402

from texvent.generate.diffusers_models.pipeline_call import call_pipeline  # noqa: E402
from texvent.generate.video_config import DiffusersConfig  # noqa: E402
from texvent.generate.video_models.known_models import MODELS, VideoModel  # noqa: E402
from texvent.runtime.progress import NoProgress  # noqa: E402

from ..tiny_models import PROMPT, build, pixels  # noqa: E402

PIPELINES = sorted(
    {name for row in MODELS.values() for name in (row.pipeline, row.image_pipeline) if name}
)


def stand_in(name):
    """An object with the signatures of a pipeline's class, which notes how it is called."""
    real = getattr(diffusers, name)
    calls = []

    def called(self, **arguments):
        calls.append((arguments, getattr(self, "guider", None)))
        return [np.zeros((1, 5, 8, 8, 3), np.float32)]

    called.__signature__ = inspect.signature(real.__call__)
    members = {"__call__": called, "maybe_free_model_hooks": lambda self: None}
    kind = type(name, (), {**members, "__signature__": inspect.signature(real)})
    pipe = kind()
    if "guider" in inspect.signature(real).parameters:
        pipe.guider = diffusers.ClassifierFreeGuidance(guidance_scale=9.0)
    return pipe, calls


def call(pipe, fps=Fraction(24), **options):
    return call_pipeline(
        pipe,
        PROMPT,
        DiffusersConfig(**options),
        model=VideoModel(name="someone's"),
        fps=fps,
        generator=torch.Generator("cpu").manual_seed(0),
        progress=NoProgress(),
    )


@pytest.fixture
def start(tmp_path):
    path = tmp_path / "start.png"
    Image.new("RGB", (64, 32), "red").save(path)
    return path


@pytest.mark.parametrize("name", PIPELINES)
def test_steps_and_guidance_reach_the_call_of_every_pipeline(name, start):
    pipe, calls = stand_in(name)
    accepted = inspect.signature(type(pipe).__call__).parameters
    image = {"image": start} if "image" in accepted else {}
    call(pipe, guidance=1.5, **image)
    arguments, guider = calls[0]
    assert arguments.get("guidance_scale", getattr(guider, "guidance_scale", None)) == 1.5
    assert set(arguments) <= set(accepted)
    if guider is not None:
        assert pipe.guider.guidance_scale == 9.0, "as it was for the next call"
    call(pipe, steps=7, **image)
    assert calls[1][0]["num_inference_steps"] == 7


def test_a_fractional_frame_rate_reaches_the_call():
    pipe, calls = stand_in("CosmosTextToWorldPipeline")
    for fps in (Fraction(24), Fraction(30_000, 1001)):
        call(pipe, fps=fps)
    assert [arguments["fps"] for arguments, _ in calls] == [24, 30_000 / 1001]
    assert isinstance(calls[0][0]["fps"], int)


def test_the_middle_of_an_image_is_fitted_to_the_video_and_noted(models, tmp_path):
    """A band at each side is cut away; a camera's note that the image is turned is followed."""
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
