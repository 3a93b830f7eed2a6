"""Kept claims of sentences: what the staged scene must hold for their words to be shown.

    python -m tests.scenes.read.claims    # writes them anew; CHANGELOG.md says why

`claims.txt` has a line for each sentence of `sentences.txt`, of `checks/words.txt` and of
`golden/reported.txt`: a checksum of its words and of what they depend on, then its claims. Scenes
alone, which `sentences.txt` has, do not show them.
"""

import re
from collections.abc import Mapping
from functools import cache
from pathlib import Path
from zlib import crc32

from tests.scenes.golden.golden import read_lines
from tests.scenes.read.expected import sentences

from texvent.errors import InputError
from texvent_scenes.description import SEEN, Claim
from texvent_scenes.models.nouns import NOUNS
from texvent_scenes.read import Reading, read

CLAIMS = Path(__file__).with_name("claims.txt")
WORDS = Path(__file__).parents[1] / "checks" / "words.txt"

read_once = cache(lambda sentence: read(sentence, NOUNS))


def list_sentences() -> list[str]:
    """All sentences, each once."""
    checked = re.findall(r"^([^#\n].*) => ", WORDS.read_text("utf-8"), re.MULTILINE)
    said = [prompt for prompt, _ in sentences()]
    return [*dict.fromkeys([*said, *checked, *read_lines("reported.txt")])]


def _say_claim(one: Claim) -> str:
    about = [*([] if one.subject is None else [one.subject]), *one.targets]
    return " ".join([f"{one.word}:", one.kind, *([str(one.value)] * (one.value != "")),
                     *map(str, about)])  # fmt: skip


def say_claims(reading: Reading) -> str:
    """A checksum of words and of what they depend on, then all claims but that bodies are seen."""
    words = reading.shown, reading.open_words, reading.dependences, [
        one for one in reading.claims if one.kind == SEEN]  # fmt: skip
    claims = dict.fromkeys(_say_claim(one) for one in reading.claims if one.kind != SEEN)
    return "; ".join([f"{crc32(repr(words).encode()):08x}", *claims])


def list_claims() -> Mapping[str, str]:
    """Sentence → what it claims."""
    found = {}
    for sentence in list_sentences():
        try:
            found[sentence] = say_claims(read_once(sentence))
        except InputError:
            found[sentence] = "refused"
    return found


def stored_claims() -> Mapping[str, str]:
    """Sentence → what it claimed."""
    lines = CLAIMS.read_text("utf-8").splitlines()
    return dict(line.split(" => ", 1) for line in lines)  # type: ignore[misc]


if __name__ == "__main__":
    lines = (f"{sentence} => {said}\n" for sentence, said in list_claims().items())
    CLAIMS.write_text("".join(lines), "utf-8")
