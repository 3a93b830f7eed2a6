"""ImageNet's validation images: found, captioned by a model that the user has, their brightness."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

from texvent.errors import FileFormatError, InputError, one_line
from texvent.extending import require
from texvent.generation.diffusers_models.pipeline_loading import resolve_device
from texvent.generation.video_models.model_files import EXTRA, loading
from texvent.io.atomic import atomic_file
from texvent_lab.networks.saved_models import find_model

QUESTION = "Caption the image in detail."
"""The paper's, to LLaVA-v1.5-13B."""
EXAMPLE = "llava-hf/llava-1.5-13b-hf"
MOST_TOKENS = 256
"""Most tokens of a caption; the paper's have up to 124 words."""
EXTENSIONS = (".jpeg", ".jpg", ".png")


def find_images(folder: Path, ids: Sequence[str]) -> dict[str, Path]:
    """Id → image, in any folder below `folder`.

    Raises:
        InputError: some are missing.
    """
    wanted, files = set(ids), sorted(folder.rglob("*.*"))
    found = {one.stem: one for one in files if one.suffix.lower() in EXTENSIONS}
    missing = sorted(wanted - set(found))
    if missing:
        raise InputError(
            f"{folder} lacks {len(missing)} of {len(wanted)} images, such as {missing[0]}.JPEG; "
            "give the folder of ImageNet's validation images"
        )
    return {id: found[id] for id in ids}


def mean_levels(images: Mapping[str, Path]) -> list[float]:
    """Mean grey level of each image that can be read, 0..255."""
    import cv2

    grey = (cv2.imread(str(one), cv2.IMREAD_REDUCED_GRAYSCALE_4) for one in images.values())
    return [float(one.mean()) for one in grey if one is not None]


def make_captions(
    images: Mapping[str, Path],
    model: str,
    kept: Path,
    *,
    device: str = "auto",
    progress: Callable[[str, int, int], None] = lambda stage, done, total: None,
) -> tuple[dict[str, str], dict[str, str]]:
    """Captions of images by an image-text-to-text model, and why others are missing, by id.

    Args:
        images: id → file.
        model: folder of a model saved by transformers, or `hub:org/name`.
        kept: holds captions by model and id as soon as they are made: a stopped run goes on.
        device: "auto", or a torch device.
        progress: told of ("captions", done, total).

    Raises:
        InputError, FileFormatError: the model is not there, cannot be loaded, or `kept` is damaged.
        MissingDependencyError: torch, transformers or Pillow is not installed.
    """
    try:
        made = json.loads(kept.read_text(encoding="utf-8")) if kept.exists() else {}
        own = {str(id): str(one) for id, one in made.setdefault(model, {}).items()}
    except (OSError, ValueError, AttributeError) as error:
        raise FileFormatError(f"{kept} is damaged ({one_line(error)}); delete it") from error
    todo, failures = [id for id in images if id not in own], dict[str, str]()
    pipeline = _load(model, device) if todo else None
    for done, id in enumerate(todo):
        progress("captions", done, len(todo))
        try:
            own[id] = _describe(images[id], pipeline)
        except InputError as error:
            failures[id] = str(error)
            continue
        with atomic_file(kept, overwrite=True) as part:
            text = json.dumps({**made, model: own}, ensure_ascii=False, indent=0)
            part.write_text(text, encoding="utf-8")
    return {id: own[id] for id in images if id in own}, failures


def _load(model: str, device: str) -> Any:
    place, free = resolve_device(device)
    folder = find_model(model, "image-and-text model", EXAMPLE)
    transformers = require("transformers", extra=EXTRA)
    with loading(folder, "an image-and-text model"):
        pipeline = transformers.pipeline(
            "image-text-to-text",
            model=str(folder),
            device=place,
            dtype="bfloat16" if free else "float32",
            model_kwargs={"use_safetensors": True},
        )
    if pipeline.processor.chat_template is None:
        raise FileFormatError(f"{folder} has no chat template; give a model that answers questions")
    return pipeline


def _describe(path: Path, pipeline: Any) -> str:
    """Answer in one line; decoding is greedy, so an image has one."""
    pil_image = require("PIL.Image", extra=EXTRA)
    try:
        with pil_image.open(path) as opened:
            image = opened.convert("RGB")
    except OSError as error:
        raise InputError(f"{path} cannot be read as an image ({one_line(error)})") from error
    content = [{"type": "image", "image": image}, {"type": "text", "text": QUESTION}]
    limits = {"do_sample": False, "max_new_tokens": MOST_TOKENS}
    said = [{"role": "user", "content": content}]
    (answer,) = pipeline(text=said, return_full_text=False, generate_kwargs=limits)
    caption = " ".join(str(answer["generated_text"]).split())
    if not caption:
        raise InputError(f"the model says nothing about {path}")
    return caption
