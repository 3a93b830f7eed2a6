"""Captions that a model made, kept one by one, so that a run that was killed goes on."""

from __future__ import annotations

import json
import os
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from texvent.batch.list_files import read_list
from texvent.errors import ConfigError, FileFormatError, InputError, one_line
from texvent.io.atomic import atomic_file

FILE = "made_captions.jsonl"


def read_captions(path: Path) -> dict[str, str]:
    """Captions made elsewhere: id → caption.

    Args:
        path: `.csv` or `.jsonl` with `id` (or `name`), ImageNet's name of the image without
            extension, and `caption` (or `prompt`, `text`).

    Raises:
        InputError: there is no such file, or no caption in it.
        FileFormatError: a line cannot be read, has no id, or gives one id another caption.
    """
    captions: dict[str, str] = {}
    for entry in read_list(path):
        if entry.name is None or entry.prompt is None:
            raise FileFormatError(f"{entry.where} needs id and caption")
        caption = one_paragraph(entry.prompt)
        if captions.setdefault(entry.name, caption) != caption:
            raise FileFormatError(f"{entry.where} gives {entry.name} another caption than before")
    return captions


def one_paragraph(text: str) -> str:
    """The text on one line."""
    return " ".join(text.split())


@dataclass(frozen=True)
class CaptionStore:
    """A file that grows by one caption at a time.

    Its first line says what makes the captions, so that those of two models are never mixed.
    """

    path: Path
    facts: Mapping[str, Any]
    """What decides a caption: model, instruction ..."""

    def read(self) -> dict[str, str]:
        """The captions so far; a last line that was cut off is dropped.

        Raises:
            ConfigError: they were made by something else.
            FileFormatError: the file is damaged.
        """
        try:
            lines = self.path.read_text(encoding="utf-8", errors="replace").split("\n")[:-1]
        except FileNotFoundError:
            return {}
        except OSError as error:
            raise InputError(f"cannot read {self.path}: {one_line(error)}") from error
        try:
            tables = [json.loads(line) for line in lines]
            captions = {str(one["id"]): str(one["caption"]) for one in tables[1:]}
        except (ValueError, TypeError, KeyError) as error:
            raise FileFormatError(f"{self.path} is damaged ({one_line(error)})") from error
        if tables and tables[0] != dict(self.facts):
            raise ConfigError(
                f"{self.path} holds captions of {tables[0]}, and now {dict(self.facts)} is asked "
                "for; name another folder with -o"
            )
        return captions

    def fill(
        self, ids: Sequence[str], make: Callable[[str], str]
    ) -> tuple[dict[str, str], dict[str, str]]:
        """Make the captions that are missing.

        Args:
            ids: which are wanted.
            make: id → caption; may raise `InputError`, which costs that caption alone.

        Returns:
            All captions of `ids`, and id → why there is none.
        """
        captions, failures = self.read(), dict[str, str]()
        self._rewrite(captions)
        with self.path.open("a", encoding="utf-8") as file:
            for id in ids:
                if id in captions:
                    continue
                try:
                    captions[id] = one_paragraph(make(id))
                except InputError as error:
                    failures[id] = str(error)
                    continue
                file.write(_line({"id": id, "caption": captions[id]}))
                file.flush()
                os.fsync(file.fileno())
        return {id: captions[id] for id in ids if id in captions}, failures

    def _rewrite(self, captions: Mapping[str, str]) -> None:
        """Begin the file, or end it after its last whole line."""
        lines = [dict(self.facts), *({"id": id, "caption": one} for id, one in captions.items())]
        with atomic_file(self.path, overwrite=True) as part:
            part.write_text("".join(map(_line, lines)), encoding="utf-8")


def _line(table: Mapping[str, Any]) -> str:
    return json.dumps(table, ensure_ascii=False) + "\n"
