"""Images → prompts, by an image-and-text model that the user has (paper, data for 9.7).

The paper captions images with LLaVA and the instruction "Caption the image in detail." Any model
that transformers runs as "image-text-to-text" will do; decoding is greedy, so an image has one
caption.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

from texvent.errors import InputError, one_line
from texvent.extending import require
from texvent.generate.diffusers_models.pipeline_loading import resolve_device
from texvent.generate.video_models.model_files import loading
from texvent_lab.networks.saved_models import find_saved_model

EXTRA = "generate"
INSTRUCTION = "Caption the image in detail."
"""The paper's."""
PLAIN_CHAT = "USER: <image>\n{} ASSISTANT:"
"""Prompt of LLaVA 1.5, for models without a chat template."""


class Captioner:
    """A model that describes images, loaded once.

    Args:
        model: folder of a model saved by transformers, or `hub:org/name`.
        device: "auto", or a torch device.

    Raises:
        InputError: there is no such model.
        FileFormatError: it cannot be loaded.
        MissingDependencyError: transformers is not installed.
    """

    def __init__(self, model: str, *, device: str = "auto") -> None:
        self._device, free = resolve_device(device, "device")
        folder = find_saved_model(model, "image-and-text model", example="llava-hf/llava-1.5-7b-hf")
        self._processor, self._model = _load(folder, "bfloat16" if free else "float32")
        self._model.to(self._device)

    def caption(self, image: Path, *, longest: int = 124) -> str:
        """One line that describes an image.

        Args:
            image: its file.
            longest: most tokens of the answer; the paper's captions have up to 124.

        Raises:
            InputError: the image cannot be read, or the model has nothing to say.
        """
        torch = require("torch", extra=EXTRA)
        pil_image = require("PIL.Image", extra=EXTRA)
        try:
            with pil_image.open(image) as opened:
                rgb = opened.convert("RGB")
        except OSError as error:
            raise InputError(f"{image} cannot be read as an image ({one_line(error)})") from error
        inputs = self._processor(images=rgb, text=self._prompt(), return_tensors="pt").to(
            self._device
        )
        inputs["pixel_values"] = inputs["pixel_values"].to(self._model.dtype)
        with torch.no_grad():
            tokens = self._model.generate(**inputs, max_new_tokens=longest, do_sample=False)
        answer = tokens[0, inputs["input_ids"].shape[1] :]
        text = " ".join(self._processor.decode(answer, skip_special_tokens=True).split())
        if not text:
            raise InputError(f"the model says nothing about {image}")
        return text

    def _prompt(self) -> str:
        if getattr(self._processor, "chat_template", None) is None:
            return PLAIN_CHAT.format(INSTRUCTION)
        content = [{"type": "image"}, {"type": "text", "text": INSTRUCTION}]
        asked: str = self._processor.apply_chat_template(
            [{"role": "user", "content": content}], add_generation_prompt=True
        )
        return asked


def _load(folder: Path, dtype: str) -> tuple[Any, Any]:
    transformers = require("transformers", extra=EXTRA)
    torch = require("torch", extra=EXTRA)
    with loading(folder, "an image-and-text model"):
        processor = transformers.AutoProcessor.from_pretrained(str(folder), local_files_only=True)
        model = transformers.AutoModelForImageTextToText.from_pretrained(
            str(folder), dtype=getattr(torch, dtype), local_files_only=True, use_safetensors=True
        )
    return processor, model.eval()
