"""English words: their parts of speech, base forms, and the nearest known spelling.

Parts of speech and base forms come from LemmInflect, which brings the NIH's Specialist Lexicon.
"""

from __future__ import annotations

import difflib
from collections.abc import Collection
from dataclasses import dataclass
from enum import Enum, auto
from functools import lru_cache

from texvent.scenes.language.words.dictionary import open_dictionary

SHORTEST_CORRECTED = 5
"""Letters of the shortest word whose spelling is corrected."""
LONGEST_WORD = 40
"""Letters of the longest word that is looked up."""
LIKENESS = 0.85
"""How like a known word a misspelt one must be (`difflib` ratio)."""


class Pos(Enum):
    """Parts of speech and signs."""

    NOUN = auto()
    VERB = auto()
    ADJECTIVE = auto()
    ADVERB = auto()
    DETERMINER = auto()
    NUMBER = auto()
    PREPOSITION = auto()
    CONJUNCTION = auto()
    SUBORDINATOR = auto()
    RELATIVE = auto()
    PRONOUN = auto()
    AUXILIARY = auto()
    NEGATION = auto()
    TO = auto()
    ADJUNCT = auto()
    """A phrase that says when, how fast, in which light or from where, wherever it stands."""
    SIGN = auto()


class VerbForm(Enum):
    """Forms of a verb."""

    BASE = "base"
    THIRD = "s"
    ING = "ing"
    PAST = "ed"
    """Past tense or past participle."""


@dataclass(frozen=True)
class Reading:
    """One part of speech that a word can be, with its base form."""

    pos: Pos
    lemma: str
    form: VerbForm | None = None
    """Of verbs."""
    is_plural: bool = False
    """Of nouns."""


_POS = {
    "NOUN": Pos.NOUN,
    "PROPN": Pos.NOUN,
    "VERB": Pos.VERB,
    "ADJ": Pos.ADJECTIVE,
    "ADV": Pos.ADVERB,
}


@lru_cache(maxsize=4096)
def list_readings(word: str) -> tuple[Reading, ...]:
    """What an English word can be; empty for a word that no dictionary lists.

    Example:
        >>> [(one.pos.name, one.lemma) for one in list_readings("leaves")]
        [('NOUN', 'leaf'), ('VERB', 'leave')]
    """
    if len(word) > LONGEST_WORD:
        return ()
    found: list[Reading] = []
    for tag, lemmas in open_dictionary().getAllLemmas(word).items():
        pos = _POS.get(tag)
        if pos is None:
            continue
        lemma = lemmas[-1]
        if pos is Pos.VERB:
            found.append(Reading(pos, lemma, decide_form(word, lemma)))
        else:
            found.append(Reading(pos, lemma, is_plural=pos is Pos.NOUN and word != lemma))
    if word in _UNLISTED_NOUNS:
        found.append(Reading(Pos.NOUN, word))
    return tuple(found)


_UNLISTED_NOUNS = frozenset({"pan", "trunk", "frosting", "seating", "lettering", "flooring"})
"""Common nouns that the dictionary lacks."""


def decide_form(word: str, lemma: str) -> VerbForm:
    """Form of a verb with that base.

    Example:
        >>> decide_form("ran", "run").name, decide_form("runs", "run").name
        ('PAST', 'THIRD')
    """
    if word == lemma:
        return VerbForm.BASE
    if word.endswith("ing") and len(word) > len(lemma):
        return VerbForm.ING
    if word.endswith("s") and not word.endswith("ss"):
        return VerbForm.THIRD
    return VerbForm.PAST


@lru_cache(maxsize=2048)
def list_verb_forms(base: str) -> tuple[tuple[str, VerbForm], ...]:
    """All forms of a verb, regular and irregular, in British and American spelling.

    Example:
        >>> [word for word, _ in list_verb_forms("swim")]
        ['swim', 'swims', 'swimming', 'swam', 'swum']
    """
    words = open_dictionary()
    tables = words.getAllInflections(base, "VERB") or words.getAllInflectionsOOV(base, "VERB")
    forms: dict[str, VerbForm] = {base: VerbForm.BASE}
    for tag in ("VBZ", "VBG", "VBD", "VBN"):
        for word in tables.get(tag, ()):
            forms.setdefault(word, decide_form(word, base))
    for word in list(forms):
        if base.endswith("l") and word.startswith(base) and word[len(base) : len(base) + 1] == "l":
            continue
        if base.endswith("l") and word in (f"{base}ing", f"{base}ed"):
            forms.setdefault(f"{base}l{word[len(base) :]}", forms[word])
    return tuple(forms.items())


def _may_be_meant(one: str, word: str) -> bool:
    """Whether both begin alike and end alike: by two letters, or four at the start and one."""
    if abs(len(one) - len(word)) > 1 or one[:1] != word[:1] or one[-1:] != word[-1:]:
        return False
    return one[-2:] == word[-2:] or one[:4] == word[:4]


def correct_spelling(word: str, known: Collection[str]) -> str | None:
    """The known word that a misspelt one stands for, or None.

    Only words that no dictionary lists are corrected.

    Example:
        >>> correct_spelling("flikering", ["flickering", "bicycle"])
        'flickering'
        >>> correct_spelling("cart", ["car"]) is None
        True
    """
    if (
        not SHORTEST_CORRECTED <= len(word) <= LONGEST_WORD
        or not word.isalpha()
        or list_readings(word)
    ):
        return None
    if word.removesuffix("s") in known:
        return None
    near = [one for one in known if _may_be_meant(one, word)]
    swapped = [one for one in near if sorted(one) == sorted(word)]
    if swapped:
        return min(swapped)
    found = difflib.get_close_matches(word, near, n=1, cutoff=LIKENESS)
    return found[0] if found else None


def _words(text: str) -> frozenset[str]:
    return frozenset(text.split())


_ENGLISH = _words(
    "the a and of on is are with to from by at his her its into through over under their as who"
    " while two three past near"
)
_OTHER_GRAMMARS = (
    _words("der das ein eine einer einem einen und mit auf im ist zum zur nach dem des durch vor"
           " neben am über unter sich"),
    _words("le la les un une du et dans sur avec qui au aux est"),
    _words("el la los las un una y en con por del que sobre hacia"),
    _words("il lo gli un una con nel nella sul sulla che di della"),
)  # fmt: skip
"""Small words of German, French, Spanish, Italian."""
_FEWEST_OTHERS = 2
_OTHER_ARTICLES = _words("ein eine das der une il una")
"""What no English sentence begins with."""


def is_of_other_grammar(prompt: str) -> bool:
    """Whether its small words are those of German, French, Spanish or Italian, none English.

    One is enough if it is an article that opens the prompt.

    Nouns alone do not tell: many German ones are English words too.

    Example:
        >>> is_of_other_grammar("ein Ball im Sand"), is_of_other_grammar("a ball in the sand")
        (True, False)
    """
    words = prompt.casefold().replace(",", " ").replace(".", " ").split()
    said = set(words)
    is_opened = len(words) > 1 and words[0] in _OTHER_ARTICLES
    others = max(len(said & one) for one in _OTHER_GRAMMARS)
    return not said & _ENGLISH and (is_opened or others >= _FEWEST_OTHERS)
