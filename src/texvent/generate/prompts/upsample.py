"""Short prompts → detailed ones, by any chat model: a server's or a local one.

Video models were trained on long captions and do better with them. A server is anything that speaks
the OpenAI chat protocol (vLLM, llama.cpp, Ollama, hosted ones); a local model is a folder that
transformers saved. Answers are kept: a chat model may answer differently tomorrow, and then the
video would be generated anew.
"""

from __future__ import annotations

import json
import os
from pathlib import Path
from typing import Any

import requests

from texvent._require import require
from texvent.errors import InputError, TexventError
from texvent.generate.prompts.upsample_config import UpsampleConfig
from texvent.generate.video_models.loading import loading
from texvent.generate.videos.video_cache import content_key, made_folder
from texvent.io.atomic import atomic_file

EXTRA = "generate"
KEY_VARIABLE = "TEXVENT_CHAT_KEY"
"""Environment variable with the server's key, if it wants one; never stored."""
INSTRUCTION = (
    "Rewrite the user's prompt as one paragraph of 60 to 100 words that describes a short video "
    "for a text-to-video model: the things, their colours and motion, the camera, the place and "
    "the light. Keep everything the prompt says and add nothing that contradicts it. Answer with "
    "the paragraph alone."
)
TIMEOUT_S = 120.0
LONGEST = 256
"""Most tokens of an answer."""


def upsample_prompt(prompt: str, config: UpsampleConfig) -> str:
    """The prompt made detailed, or as it is where no model is named.

    Args:
        prompt: what to show, in a few words.
        config: which model.

    Raises:
        InputError: there is no such model, or it gives an empty answer.
        TexventError: the server does not answer as it should.
        MissingDependencyError: a local model needs transformers, which is not installed.
    """
    if config.upsample is None:
        return prompt
    facts = {"chat": config.upsample, "model": config.upsample_model, "instruction": INSTRUCTION}
    note = made_folder("upsampled") / f"{content_key({**facts, 'prompt': prompt})}.json"
    known = _read_note(note)
    if known is not None:
        return known
    ask = _ask_server if config.upsample.startswith(("http://", "https://")) else _ask_local
    answer = " ".join(ask(prompt, config).split())
    if not answer:
        raise InputError(f"{config.upsample} answers nothing to {prompt!r}; leave out `upsample`")
    with atomic_file(note, overwrite=True) as part:
        text = json.dumps({**facts, "prompt": prompt, "answer": answer}, ensure_ascii=False)
        part.write_text(text, encoding="utf-8")
    return answer


def _messages(prompt: str) -> list[dict[str, str]]:
    return [{"role": "system", "content": INSTRUCTION}, {"role": "user", "content": prompt}]


def _read_note(path: Path) -> str | None:
    try:
        answer = json.loads(path.read_text(encoding="utf-8"))["answer"]
    except (OSError, ValueError, KeyError, TypeError):
        return None
    return str(answer)


def _ask_server(prompt: str, config: UpsampleConfig) -> str:
    address = f"{str(config.upsample).rstrip('/')}/chat/completions"
    key = os.environ.get(KEY_VARIABLE)
    question: dict[str, Any] = {
        "messages": _messages(prompt),
        "temperature": 0,
        "max_tokens": LONGEST,
        "model": config.upsample_model or "default",
    }
    try:
        reply = requests.post(
            address,
            json=question,
            headers={"Authorization": f"Bearer {key}"} if key else {},
            timeout=TIMEOUT_S,
        )
    except requests.RequestException as error:
        raise TexventError(
            f"the chat server {address} cannot be reached ({type(error).__name__}); "
            "check `upsample`"
        ) from error
    if not reply.ok:
        hint = f"; set {KEY_VARIABLE} to its key" if reply.status_code in (401, 403) else ""
        raise TexventError(
            f"the chat server {address} answers {reply.status_code}: "
            f"{' '.join(reply.text.split())[:200]}{hint}"
        )
    try:
        return str(reply.json()["choices"][0]["message"]["content"])
    except (ValueError, LookupError, TypeError) as error:
        raise TexventError(
            f"the chat server {address} does not speak the OpenAI chat protocol"
        ) from error


def _ask_local(prompt: str, config: UpsampleConfig) -> str:
    folder = Path(str(config.upsample)).expanduser()
    if not (folder / "config.json").is_file():
        raise InputError(
            f"there is no chat model in {folder} (no config.json); give the address of a server "
            "or the folder of a model saved by transformers"
        )
    torch = require("torch", extra=EXTRA)
    transformers = require("transformers", extra=EXTRA)
    with loading(folder, "a chat model"):
        tokenizer = transformers.AutoTokenizer.from_pretrained(str(folder), local_files_only=True)
        model = transformers.AutoModelForCausalLM.from_pretrained(
            str(folder), local_files_only=True, use_safetensors=True
        ).eval()
    if tokenizer.chat_template is None:
        raise InputError(f"the model in {folder} has no chat template; it is no chat model")
    asked = tokenizer.apply_chat_template(
        _messages(prompt), add_generation_prompt=True, tokenize=False
    )
    tokens = tokenizer(asked, return_tensors="pt", add_special_tokens=False)
    with torch.no_grad():
        answer = model.generate(**tokens, max_new_tokens=LONGEST, do_sample=False)
    return str(
        tokenizer.decode(answer[0, tokens["input_ids"].shape[1] :], skip_special_tokens=True)
    )
