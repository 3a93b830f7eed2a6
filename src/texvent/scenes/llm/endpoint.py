"""A chat completion of an OpenAI-compatible server, constrained to a JSON Schema."""

from __future__ import annotations

import http.client
import json
import os
import urllib.error
import urllib.request
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from texvent.errors import ConfigError, TexventError, one_line, shown

KEY_VARIABLE = "TEXVENT_CHAT_KEY"
"""Environment variable with the server's key, if it wants one; never stored."""
TIMEOUT_S = 300.0
MOST_TOKENS = 2000


@dataclass(frozen=True, kw_only=True)
class Endpoint:
    """A server, and which of its models answers."""

    url: str
    """Address up to and with the version, such as http://localhost:8080/v1."""
    model: str = "default"
    """Name of the model; servers of one model take any."""
    timeout_s: float = TIMEOUT_S
    """Longest wait for an answer, s."""

    def __post_init__(self) -> None:
        if not self.url.startswith(("http://", "https://")):
            raise ConfigError(
                f"llm_url is {shown(self.url)}; give an address such as http://localhost:8080/v1"
            )


def ask(endpoint: Endpoint, instruction: str, prompt: str, schema: Mapping[str, Any]) -> Any:
    """The values of an answer.

    Raises:
        TexventError: no server, no answer in time, or an answer that is no JSON.
    """
    question = {
        "model": endpoint.model,
        "messages": [
            {"role": "system", "content": instruction},
            {"role": "user", "content": prompt},
        ],
        "temperature": 0,
        "seed": 0,
        "max_tokens": MOST_TOKENS,
        "response_format": {
            "type": "json_schema",
            "json_schema": {"name": "scene", "strict": True, "schema": schema},
        },
    }
    reply = _post(endpoint, question)
    try:
        choice = json.loads(reply)["choices"][0]
        text, reason = str(choice["message"]["content"]), choice.get("finish_reason")
    except (ValueError, LookupError, TypeError, AttributeError) as error:
        raise TexventError(
            f"the model server {endpoint.url} does not speak the OpenAI chat protocol: "
            f"{shown(reply[:200])}"
        ) from error
    try:
        return json.loads(text)
    except ValueError as error:
        cut = f", cut off at {MOST_TOKENS} tokens" if reason == "length" else ""
        raise TexventError(
            f"the answer of {endpoint.url} is no JSON{cut}: {shown(text)}; its server must support "
            "response_format json_schema"
        ) from error


def _post(endpoint: Endpoint, question: Mapping[str, Any]) -> str:
    """The text of the server's reply."""
    address, key = f"{endpoint.url.rstrip('/')}/chat/completions", os.environ.get(KEY_VARIABLE)
    headers = {"Content-Type": "application/json"}
    if key:
        headers["Authorization"] = f"Bearer {key}"
    request = urllib.request.Request(address, json.dumps(question).encode(), headers)
    try:
        with urllib.request.urlopen(request, timeout=endpoint.timeout_s) as reply:
            return str(reply.read().decode("utf-8", errors="replace"))
    except urllib.error.HTTPError as error:
        hint = f"; set {KEY_VARIABLE} to its key" if error.code in (401, 403) else ""
        with error:
            said = " ".join(error.read(400).decode("utf-8", errors="replace").split())
        raise TexventError(
            f"the model server {address} answers {error.code}: {said}{hint}"
        ) from error
    except TimeoutError as error:
        raise TexventError(
            f"the model server {address} gave no answer in {endpoint.timeout_s:g} s; take a "
            "smaller model or a shorter prompt"
        ) from error
    except (OSError, http.client.HTTPException, ValueError) as error:
        raise TexventError(
            f"the model server {address} cannot be reached ({one_line(error)}); check llm_url"
        ) from error
