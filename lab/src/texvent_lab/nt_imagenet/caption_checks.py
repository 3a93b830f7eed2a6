"""What is doubtful about captions: their length, refusals, a class not named, one said twice."""

from __future__ import annotations

import re
import unicodedata
from collections import defaultdict
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

FEWEST_WORDS, MOST_WORDS = 39, 124
"""Paper, Table 10: text length 39 to 124. The unit is not said; words are likely."""
CHECKS = ("length", "refusal", "class", "duplicate")
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
    names_class: bool | None
    """Whether it says a name of its class; None where the names are not known."""
    names_kind: bool | None
    """Whether it says at least the last word of one, such as "shark" of "white shark"."""
    is_duplicate: bool
    """Whether an earlier caption is the same but for case and punctuation."""

    @property
    def problems(self) -> tuple[str, ...]:
        """Names out of `CHECKS`."""
        found = {
            "length": not FEWEST_WORDS <= self.words <= MOST_WORDS,
            "refusal": self.is_refusal,
            "class": self.names_class is False,
            "duplicate": self.is_duplicate,
        }
        return tuple(name for name in CHECKS if found[name])


def check_captions(
    captions: Mapping[str, str],
    wnids: Mapping[str, str],
    names: Mapping[str, Sequence[str]],
) -> dict[str, CaptionCheck]:
    """Check all captions.

    Args:
        captions: id → caption.
        wnids: id → class.
        names: class → its names; may lack some.
    """
    groups = find_duplicates(captions)
    later = {id for group in groups for id in group[1:]}
    checks = {}
    for id, caption in captions.items():
        known = names.get(wnids[id], ())
        text = normalised(caption)
        kinds = [normalised(name).split()[-1] for name in known if normalised(name)]
        checks[id] = CaptionCheck(
            words=len(caption.split()),
            is_refusal=bool(_REFUSAL.search(_plain(caption))),
            names_class=any(_says(text, normalised(name)) for name in known) if known else None,
            names_kind=any(_says(text, kind) for kind in kinds) if known else None,
            is_duplicate=id in later,
        )
    return checks


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


def _says(text: str, name: str) -> bool:
    """True if the name, or its regular plural, stands in the text as words of its own."""
    return bool(name) and re.search(rf"\b{re.escape(name)}(?:s|es)?\b", text) is not None
