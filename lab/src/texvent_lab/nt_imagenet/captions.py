"""Captions of N-ImageNet: kept, checked, and compared with each other."""

from __future__ import annotations

import json
import os
import re
import unicodedata
from collections import defaultdict
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from texvent.batch.list_files import read_list
from texvent.errors import ConfigError, FileFormatError, InputError, one_line
from texvent.io.atomic import atomic_file

FEWEST_WORDS, MOST_WORDS = 39, 124
"""Paper, Table 10: text length 39 to 124. The unit is not said; words are likely."""
CHECKS = ("length", "refusal", "duplicate")
_REFUSAL = re.compile(
    r"\b(i am sorry|i'm sorry|sorry,|i apologi[sz]e|i cannot|i can't|i am unable|i'm unable|"
    r"i am not able|as an ai|as a language model|unable to (see|view|process|describe|provide)|"
    r"no image (is|was) (provided|given|attached))\b"
)


@dataclass(frozen=True, kw_only=True)
class CaptionCheck:
    """What was found about one caption."""

    words: int
    is_refusal: bool
    """Whether it excuses itself instead of describing."""
    is_duplicate: bool
    """Whether an earlier caption is the same but for case and punctuation."""

    @property
    def problems(self) -> tuple[str, ...]:
        """Names out of `CHECKS`."""
        found = {
            "length": not FEWEST_WORDS <= self.words <= MOST_WORDS,
            "refusal": self.is_refusal,
            "duplicate": self.is_duplicate,
        }
        return tuple(name for name in CHECKS if found[name])


def check_captions(captions: Mapping[str, str]) -> dict[str, CaptionCheck]:
    """Check all captions, id → caption."""
    later = {id for group in find_duplicates(captions) for id in group[1:]}
    return {
        id: CaptionCheck(
            words=len(caption.split()),
            is_refusal=bool(_REFUSAL.search(_plain(caption))),
            is_duplicate=id in later,
        )
        for id, caption in captions.items()
    }


def find_duplicates(captions: Mapping[str, str]) -> list[tuple[str, ...]]:
    """Groups of ids whose captions are the same but for case and punctuation."""
    groups: dict[str, list[str]] = defaultdict(list)
    for id, caption in captions.items():
        groups[normalised(caption)].append(id)
    return [tuple(ids) for ids in groups.values() if len(ids) > 1]


def normalised(text: str) -> str:
    """Letters and digits in lower case, one space between words.

    Example:
        >>> normalised("A Great-White  shark's fin.")
        'a great white shark s fin'
    """
    return " ".join(re.findall(r"\w+", _plain(text)))


def _plain(text: str) -> str:
    return unicodedata.normalize("NFKC", text).casefold().replace("’", "'")


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
