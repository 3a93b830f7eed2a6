"""Files of models: found in the model hub's cache or a local folder, fetched, and checked.

Missing and pickled weights are refused before anything is loaded, so that errors name the file.
"""

from __future__ import annotations

import contextlib
import functools
import hashlib
import json
import logging
import re
from collections.abc import Callable, Collection, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from texvent._require import require
from texvent.errors import FileFormatError, InputError, TexventError, one_line

if TYPE_CHECKING:
    from texvent.generation.video_models.config import VideoModel

EXTRA = "generate"
LIBRARIES = ("diffusers", "transformers")
DAMAGE = (OSError, ValueError, RuntimeError, AttributeError, TypeError, LookupError)
"""Exceptions of the libraries for files that do not fit, beside that of safetensors."""
LONGEST_REASON, MOST_NAMES = 300, 3
REPOSITORY = r"[A-Za-z0-9]\w*(?:[.-]\w+)*/[A-Za-z0-9]\w*(?:[.-]\w+)*"
"""`organisation/name` as the model hub allows it: no two dots or hyphens in a row."""
HUB = "hub:"
"""Prefix of a repository of the model hub: `hub:org/name`."""
INDEX = "model_index.json"
CONFIG = "config.json"
PICKLES = (".bin", ".pt", ".pth", ".ckpt")
PLAIN_TYPES = ("F32", "F16", "BF16")
"""Number formats of weights whose shape is that of their layer; packed ones have other shapes."""
NOT_READ = "not known to texvent; read the model's page"


@dataclass(frozen=True)
class ModelFiles:
    """A model folder that was checked, and the commit it is of."""

    folder: Path
    commit: str | None
    """Commit of the hub's repository; None for a local folder."""


def find_files(model: VideoModel, announce: Callable[[str], None]) -> ModelFiles:
    """The files of a model, fetched first if they are not on this machine.

    Raises:
        InputError: the model is not here and cannot be fetched, or a file is missing.
        FileFormatError: a file is damaged.
        MissingDependencyError: diffusers is not installed.
    """
    if model.folder is not None:
        check_weight_files(model.folder, elsewhere_parts(model))
        return ModelFiles(model.folder, None)
    folder = find_downloaded(model)
    if folder is None:
        require("diffusers", extra=EXTRA)  # before a download is announced that cannot begin
        announce(describe_terms(model))
        folder = _download(model)
    check_weight_files(folder, elsewhere_parts(model))
    return ModelFiles(folder, folder.name)


def find_downloaded(model: VideoModel) -> Path | None:
    """Folder of a model that the hub's cache holds already, or None. Touches no network.

    Raises:
        MissingDependencyError: huggingface-hub is not installed.
    """
    hub = require("huggingface_hub", extra=EXTRA)
    found = hub.try_to_load_from_cache(model.repo, INDEX, revision=model.revision)
    if not isinstance(found, str):
        return None
    # The index is the first file that is fetched; the rest may be missing after an interruption.
    folder = Path(found).parent
    try:
        check_weight_files(folder, elsewhere_parts(model))
    except InputError:
        return None
    return folder


CONTROL_PART = "controlnet"


def elsewhere_parts(model: VideoModel) -> tuple[str, ...]:
    """Parts of a model that may lie in folders of their own, or are not needed."""
    return (*((CONTROL_PART,) if model.control_revision else ()), *model.unused)


def find_network(repo: str, revision: str, announce: Callable[[str], None]) -> Path:
    """Folder of a single network of the model hub, fetched if it is not here.

    Raises:
        TexventError: it is not here and cannot be fetched.
    """
    hub = require("huggingface_hub", extra=EXTRA)
    wanted = [CONFIG, "*.safetensors", "*.safetensors.index*.json"]
    fetch = functools.partial(hub.snapshot_download, repo, revision=revision, allow_patterns=wanted)
    # Files may be missing after an interruption.
    with contextlib.suppress(OSError, ValueError, InputError):
        folder = Path(fetch(local_files_only=True))
        _check_part(folder, CONTROL_PART)
        if (folder / CONFIG).is_file():
            return folder
    announce(f"fetching {repo}@{revision} from the model hub")
    try:
        return Path(fetch())
    except (OSError, ValueError) as error:
        raise TexventError(
            f"{repo}@{revision} is not on this machine and cannot be fetched: {one_line(error)}"
        ) from error


def find_file(
    model: VideoModel, name: str, role: str, announce: Callable[[str], None] | None
) -> Path | None:
    """A single file that a row names; None: it is not here, and may not be fetched.

    A folder of a model holds it beside its parts.

    Args:
        model: the row.
        name: `organisation/name/path` on the model hub.
        role: what it is, for messages.
        announce: told before a download; None: nothing is fetched.

    Raises:
        InputError: the model's folder lacks it.
        TexventError: it is not here and cannot be fetched.
    """
    organisation, repo, file = name.split("/", 2)
    if model.folder is not None:
        path = model.folder / Path(file).name
        if not path.is_file():
            raise InputError(f"the model lacks the {role} {path}, of {name}; put the file there")
        return path
    hub, repo = require("huggingface_hub", extra=EXTRA), f"{organisation}/{repo}"
    here = hub.try_to_load_from_cache(repo, file)
    if isinstance(here, str):
        return Path(here)
    if announce is None:
        return None
    announce(f"fetching the {role} {name} from the model hub; licence: {model.licence_and_terms}")
    try:
        return Path(hub.hf_hub_download(repo, file))
    except (OSError, ValueError) as error:
        raise TexventError(
            f"the {role} {name} is not on this machine and cannot be fetched: {one_line(error)}"
        ) from error


def shapes_in(file: Path) -> dict[str, tuple[int, ...] | None]:
    """Name of each weight in a file → its shape; None where that is packed.

    Raises:
        FileFormatError: it is damaged.
    """
    safetensors, found = require("safetensors", extra=EXTRA), {}
    with loading(file, "weights"), safetensors.safe_open(file, framework="pt") as weights:
        for name in weights.keys():  # noqa: SIM118  (the file is no mapping)
            weight = weights.get_slice(name)
            is_plain = weight.get_dtype() in PLAIN_TYPES
            found[name] = tuple(weight.get_shape()) if is_plain else None
    return found


def describe_terms(model: VideoModel) -> str:
    """Licence and origin, for the user to read before the download."""
    is_known = model.licence != NOT_READ
    read = f"read in {model.licence_source}" if model.licence_source else "not read by texvent"
    origin = f" ({read}; check the model's page)" if is_known else ""
    terms = f"licence: {model.licence_and_terms}{origin}"
    return f"fetching {model.source} from the model hub; {terms}"


def _download(model: VideoModel) -> Path:
    from texvent.generation.diffusers_models.modular import MODULAR

    diffusers = require("diffusers", extra=EXTRA)
    errors = require("huggingface_hub.errors", extra=EXTRA)
    try:
        with _without_warnings():
            # The class knows which files are needed; an index may name one of another library.
            name = model.pipeline or ""
            pipeline = MODULAR.get(name) or getattr(diffusers, name, diffusers.DiffusionPipeline)
            return Path(
                pipeline.download(model.repo, revision=model.revision, use_safetensors=True)
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
    return (
        f"{INDEX} and the weights of {model.source} are not on this machine and the model hub "
        f"cannot be reached: {one_line(error)}. Fetch them elsewhere (hf download {model.repo}) "
        "and pass generator=./FOLDER"
    )


def read_pipeline_index(folder: Path) -> dict[str, Any]:
    """Class and parts of a saved pipeline, from its `model_index.json`.

    Raises:
        InputError: there is no such folder, or it is no saved pipeline.
        FileFormatError: the file is damaged.
    """
    if not folder.is_dir():
        raise InputError(
            f"there is no model folder {folder}; give the folder of a saved diffusers pipeline "
            f"(it holds {INDEX})"
        )
    path = folder / INDEX
    if not path.is_file():
        raise InputError(
            f"{folder} holds no {INDEX}, so it is no saved diffusers pipeline; put the model's "
            "files there, subfolders included"
        )
    index = read_json(path)
    if not isinstance(index.get("_class_name"), str):
        raise FileFormatError(f"{path} names no pipeline class; it is not of a diffusers pipeline")
    return index


def check_weight_files(folder: Path, elsewhere_parts: Collection[str] = ()) -> None:
    """Refuse a model folder with missing or pickled weights, by file name.

    Args:
        folder: of the model.
        elsewhere_parts: parts that lie in folders of their own.

    Raises:
        InputError: a part lacks its weights, or has them only as a pickle.
        FileFormatError: a file is damaged.
    """
    index = read_pipeline_index(folder)
    for part, entry in index.items():
        # Modular pipelines have a third value: where else the part may be.
        is_part = isinstance(entry, list) and len(entry) in (2, 3) and entry[0] is not None
        elsewhere = part == "safety_checker" or part in elsewhere_parts
        if not part.startswith("_") and is_part and not elsewhere:
            _check_part(folder / part, str(entry[1]))


def _check_part(folder: Path, class_name: str) -> None:
    """A network must have safetensors; schedulers and tokenizers have only JSON."""
    if not folder.is_dir():
        raise InputError(
            f"the model lacks the folder {folder} ({class_name}); put the model's files there"
        )
    weights = sorted(folder.glob("*.safetensors"))
    for index_path in sorted(folder.glob("*.safetensors.index*.json")):
        for name in sorted(set(read_json(index_path).get("weight_map", {}).values())):
            if not (folder / name).is_file():
                raise InputError(
                    f"the model lacks the weights {folder / name}, which {index_path.name} "
                    "names; put the file there"
                )
    # Networks have a config.json; tokenizers and schedulers have configs of other names.
    if not weights and (folder / CONFIG).is_file():
        pickled = [path for path in folder.iterdir() if path.suffix in PICKLES]
        if pickled:
            raise InputError(
                f"{pickled[0]} is a pickle, which can run code when it is read; texvent reads "
                "weights from .safetensors only: save the model with safe_serialization=True"
            )
        raise InputError(f"the model lacks its weights in {folder}; put its .safetensors there")


def fingerprint(folder: Path) -> str:
    """Digest of a model folder that costs a moment even for 100 GB.

    It covers the text of the JSON files, name and size of every file, and when the weights were
    last changed.
    """
    digest = hashlib.sha256()
    for path in sorted(folder.rglob("*")):
        if not path.is_file() or any(part.startswith(".") for part in path.parts[-2:]):
            continue
        stat = path.stat()
        digest.update(f"{path.relative_to(folder)} {stat.st_size}\n".encode())
        if path.suffix == ".json":
            digest.update(path.read_bytes())
        elif path.suffix == ".safetensors":
            digest.update(str(stat.st_mtime_ns).encode())
    return digest.hexdigest()


def read_json(path: Path) -> dict[str, Any]:
    """Content of a JSON file of a model, by name.

    Raises:
        FileFormatError: it is damaged.
    """
    try:
        content = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise FileFormatError(f"{path} is damaged: {one_line(error)}; fetch it again") from error
    if not isinstance(content, dict):
        raise FileFormatError(f"{path} is damaged: it holds no names; fetch it again")
    return content


@contextlib.contextmanager
def loading(folder: Path, role: str) -> Iterator[None]:
    """Inside, a library loads `folder`; it shows no bars, and a damaged folder is refused.

    Raises:
        FileFormatError: a file is damaged, of another network, or lacks weights, which the
            libraries would fill with random numbers.
        MissingDependencyError: a package is not installed.
    """
    damage = require("safetensors", extra=EXTRA).SafetensorError
    try:
        with without_bars(), _MissingWeights() as missing:
            yield
    except (*DAMAGE, damage) as error:
        reason = " ".join(str(error).split())[:LONGEST_REASON]
        raise FileFormatError(f"{folder} cannot be loaded as {role}: {reason}") from error
    if missing.names:
        raise FileFormatError(
            f"{folder} lacks weights of {role}, {', '.join(missing.names[:MOST_NAMES])}, which "
            "would be random numbers; fetch the model again"
        )


class _MissingWeights(logging.Handler):
    """Inside, remembers weights that the libraries report as missing from the files."""

    def __init__(self) -> None:
        super().__init__(level=logging.WARNING)
        self.names: list[str] = []
        self._levels: dict[str, int] = {}

    def __enter__(self) -> _MissingWeights:
        for name in LIBRARIES:
            logger = logging.getLogger(name)
            self._levels[name] = logger.level
            logger.setLevel(min(logger.level or logging.WARNING, logging.WARNING))
            logger.addHandler(self)
        return self

    def __exit__(self, *_: object) -> None:
        for name, level in self._levels.items():
            logging.getLogger(name).removeHandler(self)
            logging.getLogger(name).setLevel(level)

    def emit(self, record: logging.LogRecord) -> None:
        """Keep the names of a report: a list by diffusers, a table by transformers."""
        text = re.sub(r"\x1b\[[0-9;]*m", "", record.getMessage())
        if "newly initialized" in text:
            names = re.findall(r"^(\S+) *\| *MISSING|'([\w.]+)'|^- ([\w.]+): ", text, re.MULTILINE)
            self.names += ["".join(one) for one in names] or ["of which it names none"]


@contextlib.contextmanager
def without_bars() -> Iterator[None]:
    """Inside, the libraries show no progress bars."""
    with contextlib.ExitStack() as stack:
        for name in LIBRARIES:
            bars = require(f"{name}.utils.logging", extra=EXTRA)
            if bars.is_progress_bar_enabled():
                bars.disable_progress_bar()
                stack.callback(bars.enable_progress_bar)
        yield
