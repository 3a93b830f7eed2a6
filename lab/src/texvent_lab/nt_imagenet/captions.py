"""Captions of N-ImageNet: read, checked, and compared with each other."""

from __future__ import annotations

import re
import unicodedata
from collections import defaultdict
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from texvent.dataset.specification.list_files import read_list
from texvent.errors import FileFormatError

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
    """Findings about one caption."""

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


def read_captions(path: Path) -> dict[str, str]:
    """Captions of a file: id → caption.

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
        caption = " ".join(entry.prompt.split())
        if captions.setdefault(entry.name, caption) != caption:
            raise FileFormatError(f"{entry.where} gives {entry.name} another caption than before")
    return captions
