"""Folders of models that transformers saved, also from the model hub."""

from __future__ import annotations

from pathlib import Path

from texvent._require import require
from texvent.errors import InputError, TexventError
from texvent.generate.video_models.hub_names import HUB

EXTRA = "generate"


def find_saved_model(model: str | Path, kind: str, *, example: str) -> Path:
    """The folder of a model, fetched first where the model hub is named.

    Args:
        model: folder of a model saved by transformers, or `hub:org/name`.
        kind: what it is, for messages: "CLIP model".
        example: a repository of such a model, org/name.

    Raises:
        InputError: the folder has no `config.json`.
        TexventError: the hub has no such model, or cannot be reached.
        MissingDependencyError: a package is not installed.
    """
    if not str(model).startswith(HUB):
        folder = Path(model).expanduser()
        if not (folder / "config.json").is_file():
            raise InputError(
                f"there is no {kind} in {folder} (no config.json); give the folder of one saved by "
                f"transformers, or hub:org/name, such as hub:{example}"
            )
        return folder
    hub = require("huggingface_hub", extra=EXTRA)
    repo = str(model).removeprefix(HUB)
    try:
        return Path(hub.snapshot_download(repo, ignore_patterns=["*.bin", "*.pt", "*.pth"]))
    except (OSError, ValueError) as error:
        reason = str(error).strip().splitlines()[0]
        raise TexventError(
            f"{repo} is not on this machine and the model hub cannot be reached: {reason}. Fetch "
            f"it elsewhere (hf download {repo}) and name its folder"
        ) from error
