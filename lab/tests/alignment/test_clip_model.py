"""A tiny random CLIP, saved as the real ones are, gives the vectors that transformers gives."""

import os

import numpy as np
import pytest

pytestmark = pytest.mark.torch
os.environ["HF_HUB_OFFLINE"] = "1"
torch = pytest.importorskip("torch")
transformers = pytest.importorskip("transformers")
torch.set_num_threads(1)

from tests.generate import tiny_pipelines  # noqa: E402

from texvent_lab.alignment.clip_model import ClipModel  # noqa: E402

TEXTS = ["a red cat walks", "dogs " * 40]


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return tiny_pipelines.save_clip(tmp_path_factory.mktemp("models") / "clip")


@pytest.fixture(scope="module")
def images():
    rng = np.random.default_rng(3)
    return [rng.integers(0, 256, (32, 32, 3), dtype=np.uint8) for _ in range(3)]


def test_vectors_are_those_of_the_whole_model(folder, images):
    model = ClipModel(folder)
    whole = transformers.CLIPModel.from_pretrained(folder).eval()
    tokenizer = transformers.AutoTokenizer.from_pretrained(folder)
    words = tokenizer(TEXTS, truncation=True, max_length=40, padding=True, return_tensors="pt")
    processor = transformers.CLIPImageProcessorPil(
        size={"height": 32, "width": 32}, do_center_crop=False
    )
    pixels = processor(images=images, return_tensors="pt")["pixel_values"]
    with torch.no_grad():
        outputs = whole(**words, pixel_values=pixels)
    np.testing.assert_allclose(model.embed_images(images), outputs.image_embeds, atol=1e-4)
    np.testing.assert_allclose(model.embed_texts(TEXTS), outputs.text_embeds, atol=1e-5)
