"""Options of prompt upsampling, apart from what carries it out, so that help loads nothing."""

from __future__ import annotations

from dataclasses import dataclass

from texvent.errors import ConfigError


@dataclass(frozen=True, kw_only=True)
class UpsampleConfig:
    """Which chat model makes prompts longer; none does by default."""

    upsample: str | None = None
    """Chat model that makes the prompt detailed first: the address of a server that speaks the
    OpenAI protocol (http://localhost:8000/v1), or the folder of a model saved by transformers."""
    upsample_model: str | None = None
    """Name of the model on that server."""

    def __post_init__(self) -> None:
        if self.upsample_model is not None and self.upsample is None:
            raise ConfigError("upsample_model is set, but no server with `upsample`")
