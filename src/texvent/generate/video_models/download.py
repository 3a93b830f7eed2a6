"""Where a model's files are: a local folder, or the model hub's cache on this machine."""

from __future__ import annotations

import contextlib
import logging
import os
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from texvent._require import require
from texvent.errors import InputError, TexventError
from texvent.generate.video_models.known_models import VideoModel
from texvent.generate.video_models.weight_files import CONFIG, INDEX, check_part, check_weight_files

EXTRA = "generate"


@dataclass(frozen=True)
class ModelFiles:
    """A model folder that was checked, and the commit it is of."""

    folder: Path
    commit: str | None
    """Commit of the hub's repository; None for a local folder."""
    motion_adapter: Path | None = None
    """Folder of the motion adapter of an image model."""


def find_files(model: VideoModel, announce: Callable[[str], None]) -> ModelFiles:
    """The files of a model, fetched first if they are not on this machine.

    Args:
        model: the model.
        announce: receives size and licence before anything is fetched.

    Raises:
        InputError: the model is not here and cannot be fetched, or a file is missing.
        FileFormatError: a file is damaged.
        MissingDependencyError: diffusers is not installed.
    """
    if model.folder is not None:
        check_weight_files(model.folder)
        return ModelFiles(model.folder, None)
    folder = find_downloaded(model)
    if folder is None:
        require("diffusers", extra=EXTRA)  # before a download is announced that cannot begin
        announce(describe_terms(model))
        folder = _download(model)
    check_weight_files(folder)
    if model.motion_adapter is None:
        return ModelFiles(folder, folder.name)
    adapter = _find_cached(model.motion_adapter, None, check_part)
    return ModelFiles(folder, folder.name, adapter)


def find_downloaded(model: VideoModel) -> Path | None:
    """Folder of a model that the hub's cache holds already, or None. Touches no network.

    Raises:
        MissingDependencyError: huggingface-hub is not installed.
    """
    if model.motion_adapter and not _find_cached(model.motion_adapter, None, check_part):
        return None
    return _find_cached(model.repo, model.revision, check_weight_files)


def _find_cached(repo: str, revision: str | None, check: Callable[[Path], None]) -> Path | None:
    hub = require("huggingface_hub", extra=EXTRA)
    first = INDEX if check is check_weight_files else CONFIG
    found = hub.try_to_load_from_cache(repo, first, revision=revision)
    if not isinstance(found, str):
        return None
    # The index is the first file that is fetched; the rest may be missing after an interruption.
    folder = Path(found).parent
    try:
        check(folder)
    except InputError:
        return None
    return folder


def describe_terms(model: VideoModel) -> str:
    """Licence and origin, for the user to read before the download."""
    is_known = model.licence != VideoModel.licence
    read = f"read in {model.licence_source}" if model.licence_source else "not read by texvent"
    origin = f" ({read}; check the model's page)" if is_known else ""
    terms = f"licence: {model.licence_and_terms}{origin}"
    return f"fetching {model.source} from the model hub; {terms}"


def _download(model: VideoModel) -> Path:
    diffusers = require("diffusers", extra=EXTRA)
    errors = require("huggingface_hub.errors", extra=EXTRA)
    try:
        with _without_warnings():
            if model.motion_adapter is not None:
                require("huggingface_hub", extra=EXTRA).snapshot_download(
                    model.motion_adapter, allow_patterns=[CONFIG, "*.safetensors"]
                )
            return Path(
                _downloading_class(diffusers, model).download(
                    model.repo, revision=model.revision, use_safetensors=True
                )
            )
    except errors.GatedRepoError as error:
        raise InputError(
            f"{model.repo} is gated: accept its terms on the model's page and log in with: hf "
            "auth login"
        ) from error
    except errors.RepositoryNotFoundError as error:
        raise InputError(
            f"the model hub has no repository {model.repo!r}, or it is private"
        ) from error
    except (OSError, ValueError) as error:
        raise TexventError(_missing_text(model, error)) from error


def _downloading_class(diffusers: Any, model: VideoModel) -> Any:
    """The class that knows which files are needed; an index may name one of another library."""
    own = None if model.motion_adapter is not None else model.pipeline
    return getattr(diffusers, own or "", diffusers.DiffusionPipeline)


@contextlib.contextmanager
def _without_warnings() -> Iterator[None]:
    """Keep what diffusers says about the hub out of the terminal; the error says it in one line."""
    logger = logging.getLogger("diffusers.pipelines.pipeline_utils")
    level = logger.level
    logger.setLevel(logging.ERROR)
    try:
        yield
    finally:
        logger.setLevel(level)


def _missing_text(model: VideoModel, error: BaseException) -> str:
    while error.__cause__ is not None:
        error = error.__cause__  # the libraries wrap the reason in advice about their own options
    constants = require("huggingface_hub.constants", extra=EXTRA)
    offline = " (HF_HUB_OFFLINE is set)" if os.environ.get("HF_HUB_OFFLINE") else ""
    text = str(error).strip() or type(error).__name__
    reason = text.splitlines()[0].rstrip(".")
    return (
        f"{INDEX} and the weights of {model.source} are not on this machine and the model hub "
        f"cannot be reached{offline}: {reason}. Fetch them elsewhere (hf download "
        f"{model.repo}) and put them into the hub's cache {constants.HF_HUB_CACHE}, "
        "or into any folder and pass generator=./FOLDER"
    )
