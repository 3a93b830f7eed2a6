"""Captions by a tiny random LLaVA of the real format."""

import json
import os
from pathlib import Path

import pytest

pytestmark = pytest.mark.torch
os.environ["HF_HUB_OFFLINE"] = "1"
torch = pytest.importorskip("torch")
transformers = pytest.importorskip("transformers")
torch.set_num_threads(1)

from PIL import Image  # noqa: E402
from tests.generation import tiny_pipelines  # noqa: E402

from texvent.cli.app import main  # noqa: E402
from texvent_lab.nt_imagenet import images  # noqa: E402
from texvent_lab.nt_imagenet.files import MADE, read_captioned  # noqa: E402

from .tiny_data import WNIDS, stream_id, write_images, write_n_imagenet  # noqa: E402


@pytest.fixture(scope="module")
def data(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("data")
    write_n_imagenet(folder / "N", {WNIDS[0]: {1: 3_000, 2: 3_000, 3: 3_000}})
    write_images(folder / "val", (1, 2, 3))
    tiny_pipelines.save_llava(folder / "llava")
    return folder


@pytest.fixture(autouse=True)
def _short(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(images, "MOST_TOKENS", 8)


def nt(data: Path, out: Path, *more: str) -> int:
    words = ["--n-imagenet", str(data / "N"), "--imagenet", str(data / "val"), "--device", "cpu"]
    words += ["--model", str(data / "llava"), "--class-count", "1", "-q", "-o", str(out)]
    return main(["nt-imagenet", *words, *more])


def captions(out: Path) -> dict[str, str]:
    return {one.id: one.caption for one in read_captioned(out / "captions.jsonl")}


def test_a_caption_is_the_answer_of_the_model_to_the_papers_question(data, tmp_path):
    (tmp_path / "some.csv").write_text(f"id,caption\n{stream_id(2)},A tench.\n")
    assert nt(data, tmp_path / "nt", "--captions", str(tmp_path / "some.csv")) == 0
    found = captions(tmp_path / "nt")
    model = transformers.LlavaForConditionalGeneration.from_pretrained(data / "llava").eval()
    processor = transformers.AutoProcessor.from_pretrained(data / "llava")
    for number in (1, 3):
        with Image.open(data / "val" / WNIDS[0] / f"{stream_id(number)}.JPEG") as image:
            asked = "USER: <image>\nCaption the image in detail. ASSISTANT:"
            inputs = processor(images=image.convert("RGB"), text=asked, return_tensors="pt")
        tokens = model.generate(**inputs, max_new_tokens=8, do_sample=False)
        answer = processor.decode(tokens[0, inputs["input_ids"].shape[1] :], True)
        assert found[stream_id(number)] == " ".join(answer.split())
    assert found[stream_id(2)] == "A tench."
    assert len(set(found.values())) == 3


def test_a_stopped_run_goes_on_and_captions_of_two_models_are_not_mixed(data, tmp_path):
    assert nt(data, tmp_path / "nt") == 0
    kept = tmp_path / "nt" / MADE
    made = json.loads(kept.read_text())
    (model,) = made
    made[model] = {stream_id(1): "kept", stream_id(2): made[model][stream_id(2)]}
    kept.write_text(json.dumps({**made, "another": {stream_id(3): "of another"}}))
    before = captions(tmp_path / "nt")
    assert nt(data, tmp_path / "nt") == 0
    assert captions(tmp_path / "nt") == {**before, stream_id(1): "kept"}
    kept.write_text("damaged")
    assert nt(data, tmp_path / "nt") == 2


def test_a_damaged_image_costs_its_caption_alone_and_a_missing_one_is_named_before_the_model(
    data, tmp_path, capsys
):
    write_images(tmp_path / "val", (1, 2, 3))
    image = tmp_path / "val" / WNIDS[0] / f"{stream_id(2)}.JPEG"
    image.write_bytes(b"damaged")
    assert nt(data, tmp_path / "nt", "--imagenet", str(tmp_path / "val")) == 1
    assert "cannot be read as an image" in capsys.readouterr().err
    assert list(captions(tmp_path / "nt")) == [stream_id(1), stream_id(3)]
    image.unlink()
    words = ["--imagenet", str(tmp_path / "val"), "--model", "no model"]
    assert nt(data, tmp_path / "nt", *words) == 2
    assert f"lacks 1 of 3 images, such as {stream_id(2)}.JPEG" in capsys.readouterr().err
    assert nt(data, tmp_path / "nt", "--model", str(tmp_path)) == 2
    assert "there is no image-and-text model in" in capsys.readouterr().err
