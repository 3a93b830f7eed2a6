"""Alignment by a tiny random CLIP of the real format, of our events and of recorded streams."""

import json
import os
from pathlib import Path
from typing import Any

import numpy as np
import pytest

pytestmark = pytest.mark.torch
os.environ["HF_HUB_OFFLINE"] = "1"
torch = pytest.importorskip("torch")
transformers = pytest.importorskip("transformers")
torch.set_num_threads(1)

from tests.generation import tiny_pipelines  # noqa: E402

from texvent.cli.app import main  # noqa: E402
from texvent.events import EventStream  # noqa: E402
from texvent.sensor import SensorSize  # noqa: E402
from texvent_lab.alignment.align import align  # noqa: E402
from texvent_lab.alignment.clip_model import ClipModel  # noqa: E402
from texvent_lab.alignment.recordings import (  # noqa: E402
    DrawnEvents,
    TextRecording,
    list_samples,
)

from ..nt_imagenet.tiny_data import WNIDS, stream_id, write_n_imagenet  # noqa: E402

CAPTIONS = ["a red car drives left", "a dog runs", "a ball bounces", "a blue bus drives right"]


@pytest.fixture(scope="module")
def clip(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tiny_pipelines.save_clip(tmp_path_factory.mktemp("models") / "clip")


@pytest.fixture(scope="module")
def data(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Captions, streams with them, and our events of all but the last caption."""
    folder = tmp_path_factory.mktemp("data")
    write_n_imagenet(folder / "N", {WNIDS[0]: {1: 3_000, 2: 4_000, 3: 5_000, 4: 6_000}})
    lines = [json.dumps({"id": stream_id(number), "caption": one})
             for number, one in enumerate(CAPTIONS, start=1)]  # fmt: skip
    (folder / "c.jsonl").write_text("\n".join(lines))
    words = ["--n-imagenet", str(folder / "N"), "--captions", str(folder / "c.jsonl"),
             "--class-count", "1", "-o", str(folder / "nt"), "-q"]  # fmt: skip
    assert main(["nt-imagenet", *words]) == 0
    short = (folder / "nt" / "captions.jsonl").read_text().splitlines()[:3]
    (folder / "nt" / "three.jsonl").write_text("\n".join(short))
    specification = (folder / "nt" / "specification.toml").read_text()
    specification = f"filters = {{min_events = 0}}\n{specification}"
    specification = specification.replace("captions.jsonl", "three.jsonl")
    specification = specification.replace('"640x480" ', '"32x24"\nduration = 0.1')
    (folder / "nt" / "three.toml").write_text(specification)
    words = [str(folder / "nt" / "three.toml"), "-o", str(folder / "events"), "--workers", "1"]
    assert main(["dataset", "make", *words, "-q"]) == 0
    return folder


def recordings(events: list[EventStream], texts: list[str]) -> list[TextRecording]:
    return [
        TextRecording(str(number), text, lambda one=one: one)
        for number, (one, text) in enumerate(zip(events, texts, strict=True))
    ]


def test_vectors_are_those_of_the_whole_model(clip):
    texts = ["a red cat walks", "dogs " * 40]
    rng = np.random.default_rng(3)
    images = [rng.integers(0, 256, (32, 32, 3), dtype=np.uint8) for _ in range(3)]
    model = ClipModel(clip)
    whole = transformers.CLIPModel.from_pretrained(clip).eval()
    tokenizer = transformers.AutoTokenizer.from_pretrained(clip)
    words = tokenizer(texts, truncation=True, max_length=40, padding=True, return_tensors="pt")
    processor = transformers.CLIPImageProcessorPil(
        size={"height": 32, "width": 32}, do_center_crop=False
    )
    pixels = processor(images=images, return_tensors="pt")["pixel_values"]
    with torch.no_grad():
        outputs = whole(**words, pixel_values=pixels)
    np.testing.assert_allclose(model.embed_images(images), outputs.image_embeds, atol=1e-4)
    np.testing.assert_allclose(model.embed_texts(texts), outputs.text_embeds, atol=1e-5)


def test_the_score_is_that_of_the_similarities_of_transformers(clip, data):
    samples = list_samples(data / "events")["texvent"]
    draw = DrawnEvents(images=2, events_per_image=15)
    report = align({"ours": samples}, draw, ClipModel(clip))["ours"]
    whole = transformers.CLIPModel.from_pretrained(clip).eval()
    tokenizer = transformers.AutoTokenizer.from_pretrained(clip)
    processor = transformers.CLIPImageProcessorPil(
        size={"shortest_edge": 32}, crop_size={"height": 32, "width": 32}
    )
    similarity, counts = np.empty((3, 3)), []
    for place, sample in enumerate(samples):
        images = [np.asarray(image) for image in draw(sample.load())]
        counts.append(len(images))
        words = tokenizer([one.text for one in samples], padding=True, return_tensors="pt")
        pixels = processor(images=images, return_tensors="pt")["pixel_values"]
        with torch.no_grad():
            out = whole(**words, pixel_values=pixels)
        mean = out.image_embeds.mean(0)
        similarity[place] = (mean / mean.norm()) @ out.text_embeds.T
    assert report.measured.mean_similarity == pytest.approx(np.diag(similarity).mean(), abs=0.005)
    assert report.chance.mean_similarity == pytest.approx(similarity.mean(), abs=0.005)
    assert max(counts) == 2
    assert (report.recordings, report.texts) == (3, 3)


def test_recordings_of_one_text_are_right_with_the_same_text(clip):
    model, size = ClipModel(clip), SensorSize(32, 32)
    rng = np.random.default_rng(1)
    x, y, t = rng.integers(0, 32, 200), rng.integers(0, 32, 200), np.arange(200)
    events = EventStream(x, y, t, rng.integers(0, 2, 200), size)
    same = recordings([events] * 4, ["a cat", "a cat", "a dog", "a dog"])
    report = align({"same": same}, DrawnEvents(), model)["same"]
    # One image is nearer to one of two texts, whatever the model: half of them are right.
    assert report.texts == 2
    assert report.measured.recall[1] == 0.5
    assert report.chance.recall[1] == 0.5


def run(clip: Path, out: Path, *words: str) -> Any:
    assert main(["align", *words, "--clip", str(clip), "-o", str(out), "-q"]) == 0
    return json.loads(out.read_text())


def test_ours_and_recorded_streams_rank_the_captions_that_both_have(clip, data, tmp_path, capsys):
    real = ["--n-imagenet", str(data / "N"), "--captions", str(data / "nt" / "captions.jsonl")]
    both = run(clip, tmp_path / "both.json", str(data / "events"), *real)
    said = capsys.readouterr().out
    assert [row["source"] for row in both["rows"]] == ["texvent", "N-ImageNet"]
    assert [row["texts"] for row in both["rows"]] == [3, 3]
    assert said.count("texts exchanged") == said.count("chance") == 2
    alone = run(clip, tmp_path / "real.json", *real)
    assert [row["texts"] for row in alone["rows"]] == [4]
    assert alone["rows"][0]["chance"]["recall"] == {"1": 0.25, "5": 1.0, "10": 1.0}
    ours = run(clip, tmp_path / "ours.json", str(data / "events"))
    assert ours["rows"][0]["measured"] == both["rows"][0]["measured"]
    assert ours["texts_cut"] == 0
    capsys.readouterr()
    every = run(clip, tmp_path / "all.json", str(data / "events"), "--least-similarity", "2")
    assert len(every["rows"][0]["misfits"]) == 3
    said = capsys.readouterr().out
    assert "texvent: 3 of 3 fit their text too little" in said
    keys = {f"{one.key}  own" for one in list_samples(data / "events")["texvent"]}
    assert len(keys) == 3
    assert all(key in said for key in keys)
    first = (data / "nt" / "captions.jsonl").read_text().split("\n")[0]
    (tmp_path / "one.jsonl").write_text(first)
    alone = ["--n-imagenet", str(data / "N"), "--captions", str(tmp_path / "one.jsonl")]
    assert main(["align", *alone, "--clip", "no model", "--least-similarity", "0"]) == 2
    assert "N-ImageNet has one text alone" in capsys.readouterr().err
    limited = run(clip, tmp_path / "two.json", *real, "--limit", "2")
    assert limited["rows"][0]["recordings"] == 2
