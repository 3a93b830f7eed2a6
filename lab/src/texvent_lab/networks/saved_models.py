"""Models that transformers saved: in a folder, or on the model hub."""

from __future__ import annotations

from pathlib import Path

from texvent.errors import InputError, TexventError, one_line
from texvent.extending import require
from texvent.generation.video_models.model_files import CONFIG, EXTRA, HUB


def find_model(model: str | Path, kind: str, example: str) -> Path:
    """Folder of a model that transformers saved, fetched first where the model hub is named.

    Args:
        model: a folder, or `hub:org/name`.
        kind: of model, for messages.
        example: one of that kind on the hub.

    Raises:
        InputError: the folder has no `config.json`.
        TexventError: the hub has no such model, or cannot be reached.
        MissingDependencyError: a package is not installed.
    """
    if not str(model).startswith(HUB):
        folder = Path(model).expanduser()
        if not (folder / CONFIG).is_file():
            raise InputError(
                f"there is no {kind} in {folder} (no config.json); give the folder of one "
                f"saved by transformers, or hub:org/name, such as hub:{example}"
            )
        return folder
    hub = require("huggingface_hub", extra=EXTRA)
    repo = str(model).removeprefix(HUB)
    try:
        return Path(hub.snapshot_download(repo, ignore_patterns=["*.bin", "*.pt", "*.pth"]))
    except (OSError, ValueError) as error:
        raise TexventError(
            f"{repo} is not on this machine and the model hub cannot be reached: "
            f"{one_line(error)}. Fetch it elsewhere (hf download {repo}) and name its folder"
        ) from error
