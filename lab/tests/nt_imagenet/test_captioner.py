"""Captions by a tiny random LLaVA."""

import os

import numpy as np
import pytest

pytestmark = pytest.mark.torch
os.environ["HF_HUB_OFFLINE"] = "1"
torch = pytest.importorskip("torch")
pytest.importorskip("transformers")
torch.set_num_threads(1)

from PIL import Image  # noqa: E402
from tests.generate import tiny_pipelines  # noqa: E402

from texvent.batch.list_files import read_list  # noqa: E402
from texvent.cli.app import main  # noqa: E402
from texvent_lab.nt_imagenet.captioner import Captioner, find_images  # noqa: E402

TEMPLATE = (
    "{% for m in messages %}ASK: {% for c in m['content'] %}"
    "{% if c['type'] == 'image' %}<image> {% else %}{{ c['text'] }}{% endif %}"
    "{% endfor %}{% endfor %} ANSWER:"
)


@pytest.fixture(scope="module")
def model(tmp_path_factory):
    return tiny_pipelines.save_llava(tmp_path_factory.mktemp("models") / "llava")


@pytest.fixture
def images(tmp_path):
    folder = tmp_path / "images"
    folder.mkdir()
    for seed in (1, 2):
        noise = np.random.default_rng(seed).integers(0, 255, (20, 30, 3), dtype=np.uint8)
        Image.fromarray(noise).save(folder / f"p{seed}.png")
    (folder / "notes.txt").write_text("no image")
    return folder


def test_a_caption_repeats_and_follows_the_image_and_the_instruction(model, images):
    captioner = Captioner(str(model), device="cpu")
    first, second = (captioner.caption(one, longest=12) for one in find_images(images))
    assert first
    assert captioner.caption(images / "p1.png", longest=12) == first
    other = captioner.caption(images / "p1.png", longest=12, instruction="Name the colours.")
    assert len({first, second, other}) == 3


def test_a_chat_template_is_used_where_the_model_brings_one(tmp_path, images):
    folder = tiny_pipelines.save_llava(tmp_path / "chat", chat_template=TEMPLATE)
    captioner = Captioner(str(folder), device="cpu")
    assert captioner._ask("What is it?") == "ASK: <image> What is it? ANSWER:"
    assert captioner.caption(images / "p1.png", longest=8)


def test_captions_become_a_file_of_prompts(model, images, tmp_path, capsys):
    out = tmp_path / "prompts.csv"
    words = ["caption", str(images), "--model", str(model), "--longest", "8", "-o", str(out)]
    assert main(words) == 0
    lines = read_list(out)
    assert [line.name for line in lines] == ["p1", "p2"]
    assert main(words) == 3
    assert "exists already" in capsys.readouterr().err
    assert main(["caption", str(images / "p1.png"), *words[2:6], "-q"]) == 0
    assert capsys.readouterr().out.strip() == lines[0].prompt


def test_a_damaged_image_does_not_cost_the_captions_of_the_others(model, images, capsys):
    (images / "p0.png").write_bytes(b"damaged")
    out = images / "prompts.csv"
    words = ["--model", str(model), "--longest", "8", "-o", str(out), "-q"]
    assert main(["caption", str(images), *words]) == 1
    assert [line.name for line in read_list(out)] == ["p1", "p2"]
    said = capsys.readouterr().err
    assert "p0.png cannot be read as an image" in said
    assert said.endswith("error: 1 of 3 images have no caption\n")
    out.unlink()
    assert main(["caption", str(images / "p0.png"), *words]) == 2
    assert not out.exists()
