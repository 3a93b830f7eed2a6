"""Captions by a tiny random LLaVA of the real format."""

from __future__ import annotations

import json
import os
from pathlib import Path

import pytest

pytestmark = pytest.mark.torch
os.environ["HF_HUB_OFFLINE"] = "1"
torch = pytest.importorskip("torch")
pytest.importorskip("transformers")
torch.set_num_threads(1)

from tests.generate import tiny_pipelines  # noqa: E402

from texvent.cli.app import main  # noqa: E402
from texvent_lab.nt_imagenet.captioner import Captioner  # noqa: E402
from texvent_lab.nt_imagenet.files import read_captioned  # noqa: E402

from .tiny_data import WNIDS, stream_id, write_imagenet, write_n_imagenet  # noqa: E402

CHAT = (
    "{% for m in messages %}USER: {% for c in m['content'] %}"
    "{% if c['type'] == 'image' %}<image>\n{% else %}{{ c['text'] }}{% endif %}"
    "{% endfor %}{% endfor %} ASSISTANT:"
)


@pytest.fixture(scope="module")
def data(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("data")
    write_n_imagenet(folder / "N_Imagenet", {WNIDS[0]: {1: 3_000, 2: 3_000, 3: 3_000}})
    write_imagenet(folder / "ImageNet", {1: WNIDS[0], 2: WNIDS[0], 3: WNIDS[0]})
    tiny_pipelines.save_llava(folder / "llava", chat_template=CHAT)
    return folder


def nt(data: Path, out: Path, *more: str) -> int:
    words = ["--n-imagenet", str(data / "N_Imagenet"), "--imagenet", str(data / "ImageNet"),
             "--model", str(data / "llava"), "--class-count", "1", "--longest", "8",
             "--device", "cpu", "-q"]  # fmt: skip
    return main(["nt-imagenet", *words, "-o", str(out), *more])


def test_captions_are_those_of_the_model_one_per_image(data: Path, tmp_path: Path) -> None:
    assert nt(data, tmp_path / "nt") == 0
    captioned = read_captioned(tmp_path / "nt" / "captions.jsonl")
    captioner = Captioner(str(data / "llava"), device="cpu")
    for one in captioned:
        image = data / "ImageNet" / "val" / WNIDS[0] / f"{one.id}.JPEG"
        assert one.caption == " ".join(captioner.caption(image, longest=8).split())
    assert len({one.caption for one in captioned}) == 3
    made_by = json.loads((tmp_path / "nt" / "report.json").read_text())["made_by"]
    assert made_by["instruction"] == "Caption the image in detail."
    assert not any(path.suffix in (".JPEG", ".npz") for path in (tmp_path / "nt").iterdir())


def test_a_damaged_or_missing_image_costs_its_caption_alone(
    data: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    write_imagenet(tmp_path / "ImageNet", {1: WNIDS[0], 2: WNIDS[0]})
    damaged = tmp_path / "ImageNet" / "val" / WNIDS[0] / f"{stream_id(1)}.JPEG"
    damaged.write_bytes(b"damaged")
    assert nt(data, tmp_path / "nt", "--imagenet", str(tmp_path / "ImageNet")) == 1
    assert "2 of 3 streams have no caption" in capsys.readouterr().err
    missing = json.loads((tmp_path / "nt" / "report.json").read_text())["captions"]["missing"]
    assert list(missing) == [stream_id(1), stream_id(3)]
    assert "cannot be read as an image" in missing[stream_id(1)]
    assert nt(data, tmp_path / "none", "--imagenet", str(tmp_path / "nt")) == 2
    assert "has none of the images" in capsys.readouterr().err


def test_a_chat_template_puts_the_image_before_the_instruction(data: Path) -> None:
    captioner = Captioner(str(data / "llava"), device="cpu")
    assert captioner._prompt() == "USER: <image>\nCaption the image in detail. ASSISTANT:"
