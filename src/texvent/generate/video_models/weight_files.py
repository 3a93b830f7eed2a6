"""Check a folder of saved weights before anything reads it, so that errors name the file.

A safetensors file starts with the length of its header (8 bytes, little endian) and the header:
JSON with the place of every tensor. The last place is the end of the file, so a truncated
download shows without reading the weights.

Source: the safetensors format description.
"""

from __future__ import annotations

import hashlib
import json
from pathlib import Path
from typing import Any

from texvent.errors import FileFormatError, InputError, one_line

INDEX = "model_index.json"
CONFIG = "config.json"
LENGTH_BYTES = 8
LARGEST_HEADER = 100_000_000
POINTER = b"version https://git-lfs"
"""First bytes of the small text file that git leaves where a large file was not fetched."""
PICKLES = (".bin", ".pt", ".pth", ".ckpt")


def read_pipeline_index(folder: Path) -> dict[str, Any]:
    """What `model_index.json` of a saved pipeline says: its class and parts.

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


def check_weight_files(folder: Path) -> None:
    """Refuse a model folder with missing, truncated or pickled weights, by file name.

    Raises:
        InputError: a part lacks its weights, or has them only as a pickle.
        FileFormatError: a file is damaged.
    """
    index = read_pipeline_index(folder)
    for part, entry in index.items():
        is_part = isinstance(entry, list) and len(entry) == 2 and entry[0] is not None
        if not part.startswith("_") and is_part and part != "safety_checker":
            check_part(folder / part, str(entry[1]))


def check_part(folder: Path, class_name: str = "a network") -> None:
    """Refuse the folder of one part if its weights are missing, truncated or pickled.

    A network must have safetensors; schedulers and tokenizers have only JSON.

    Raises:
        InputError: the part lacks its weights, or has them only as a pickle.
        FileFormatError: a file is damaged.
    """
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
    for path in weights:
        check_safetensors(path)
    if not weights and _is_network(folder):
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


def _is_network(folder: Path) -> bool:
    """Networks have a config.json; tokenizers and schedulers have configs of other names."""
    return (folder / CONFIG).is_file()


def check_safetensors(path: Path) -> None:
    """Refuse a weights file that is truncated or not the weights, without reading them.

    Raises:
        FileFormatError: see above.
    """
    size = path.stat().st_size
    with path.open("rb") as file:
        start = file.read(max(LENGTH_BYTES, len(POINTER)))
        if start.startswith(POINTER):
            raise FileFormatError(
                f"{path} is a git-lfs pointer, not the weights; run: git lfs pull"
            )
        length = int.from_bytes(start[:LENGTH_BYTES], "little")
        if len(start) < LENGTH_BYTES or not 2 <= length <= min(LARGEST_HEADER, size):
            raise FileFormatError(f"{path} is damaged: it is no safetensors file; fetch it again")
        file.seek(LENGTH_BYTES)
        header = file.read(length)
    try:
        tensors = json.loads(header)
        ends = [entry["data_offsets"][1] for name, entry in tensors.items() if name[:2] != "__"]
        expected = LENGTH_BYTES + length + max(ends, default=0)
    except (ValueError, KeyError, TypeError, IndexError, AttributeError) as error:
        raise FileFormatError(
            f"{path} is damaged: its header cannot be read; fetch it again"
        ) from error
    if size != expected:
        raise FileFormatError(
            f"{path} is damaged: it has {size} bytes, its header says {expected}; fetch it again"
        )


def read_json(path: Path) -> dict[str, Any]:
    """What a JSON file of a model says, by name.

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
