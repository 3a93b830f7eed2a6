"""Clauses of a prompt: noun groups, one verb, and what is said of both.

Nothing is decided here about what can be shown: a token keeps all its senses.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

from texvent.scenes.read.tokens import NO_TOKEN, Token

_HEADS = ("noun", "place", "effect", "lights", "weather", "pose", "liquid")
"""Senses that a noun group may end with."""
_MODIFIERS = ("colour", "shade", "sizes", "materials", "counts", "lights", "weather", "paces",
              "place fields", "light fields", "effect adjective", "lamps", "place_phrases",
              "crossing")  # fmt: skip
"""Senses of what stands before it."""
_SETTINGS = ("lights", "weather", "place fields", "light fields", "place_phrases", "shots", "views",
             "framings", "film", "lamps", "effect adjective")  # fmt: skip
"""Senses of what stands alone, in any place."""
_SHOTS = ("shots", "views", "framings", "film")
_PREPOSITIONS = ("at ", "in ", "by ", "with ", "without ", "during ")
"""Begin phrases that stand alone: "at night"."""
_PARTICLES = ("up", "down", "off", "out", "over", "in", "on")
"""Prepositions that go with a verb right before them: "picks up"."""
_ADVERBS = ("directions", "paces", "placements")


@dataclass(frozen=True)
class Group:
    """Noun group: a head with what stands before it."""

    head: Token | None
    """None: it is not known."""
    modifiers: tuple[Token, ...] = ()
    unknown: tuple[Token, ...] = ()
    """Tokens without effect: words that are not known, or that another word stands before."""
    is_definite: bool = False
    """Whether "the" or an owner stands before it."""
    is_single: bool = False
    """Whether "a" stands before it."""
    of: Group | None = None
    """Group after "of"."""


@dataclass(frozen=True)
class Phrase:
    """Preposition with its groups; without any, it is about the group before it."""

    preposition: Token
    groups: tuple[Group, ...] = ()
    is_back: bool = False
    """Whether a pronoun follows: "behind them"."""


@dataclass(frozen=True)
class Clause:
    """Subjects, a verb and its objects, and what is said of them."""

    subjects: tuple[Group, ...] = ()
    verb: Token | None = None
    objects: tuple[Group, ...] = ()
    before: tuple[Phrase, ...] = ()
    """Phrases between the subject and the verb."""
    after: tuple[Phrase | Token, ...] = ()
    """Phrases, adverbs and words of the scene, and words that are not known."""
    absent: tuple[Group, ...] = ()
    is_camera: bool = False
    """Whether the camera is the subject."""
    is_joined: bool = False
    """Whether it goes on about the subjects of the clause before."""
    is_nearest: bool = False
    """Whether it is about the last group of the clause before: "that", "jumping"."""
    is_next: bool = False
    """Whether it happens after the clause before: "then"."""
    is_back: bool = False
    """Whether a pronoun is the object: "follows it"."""


def read_clauses(tokens: Sequence[Token]) -> tuple[Clause, ...]:
    """Clauses of the tokens, in order."""
    parser, found = _Parser(tokens), []
    while not parser.is_done:
        clause = parser.clause()
        if clause != Clause():
            found.append(clause)
    return tuple(found)


@dataclass
class _Draft:
    """Clause that is being read."""

    subjects: list[Group] = field(default_factory=list)
    verb: Token | None = None
    objects: list[Group] = field(default_factory=list)
    before: list[Phrase] = field(default_factory=list)
    after: list[Phrase | Token] = field(default_factory=list)
    absent: list[Group] = field(default_factory=list)
    is_camera: bool = False
    is_joined: bool = False
    is_nearest: bool = False
    is_next: bool = False
    is_back: bool = False

    @property
    def has_subject(self) -> bool:
        return bool(self.subjects) or self.is_joined or self.is_nearest or self.is_camera

    @property
    def is_plural(self) -> bool:
        """Whether a verb in its base form agrees with the subject."""
        return (
            self.is_joined
            or self.is_nearest
            or len(self.subjects) > 1
            or any(map(is_plural, self.subjects))
        )

    def freeze(self) -> Clause:
        values = vars(self)
        return Clause(**{k: tuple(v) if isinstance(v, list) else v for k, v in values.items()})


def is_plural(group: Group) -> bool:
    """Whether a group names several things."""
    if any(one.has("counts") or one.number is not None for one in group.modifiers):
        return not any(one.text.casefold() in ("one", "single", "1") for one in group.modifiers)
    noun = None if group.head is None else group.head.first("noun")
    return noun is not None and noun.value.is_plural


def _is_bare_verb(token: Token) -> bool:
    """Whether a token is nothing but the base form of a verb."""
    return bool(token.senses) and all(one.form == "base" for one in token.senses)


class _Parser:
    """Position in the tokens; each method reads on from there."""

    def __init__(self, tokens: Sequence[Token]) -> None:
        self._tokens = tokens
        self._at = 0
        self._next = _Draft()
        """What the next clause takes over from the one before."""
        self._is_of_phrase = False
        """Whether the group that is read stands after a preposition."""

    @property
    def is_done(self) -> bool:
        """Whether all tokens are read."""
        return self._at >= len(self._tokens)

    def _token(self, ahead: int = 0) -> Token:
        at = self._at + ahead
        return self._tokens[at] if 0 <= at < len(self._tokens) else NO_TOKEN

    def clause(self) -> Clause:
        """The next clause, up to a sign or a conjunction."""
        draft, self._next = self._next, _Draft()
        steps: tuple[Callable[[_Draft], bool], ...] = (
            self._read_camera, self._read_absence, self._read_setting, self._read_verb,
            self._read_phrase, self._read_pronoun, self._read_adverb, self._read_group,
        )  # fmt: skip
        while not self.is_done and not self._ends(draft):
            if not any(step(draft) for step in steps):
                self._read_rest(draft)
        return draft.freeze()

    # Where a clause ends

    def _ends(self, draft: _Draft) -> bool:
        token = self._token()
        word = token.text.casefold()
        if token.is_sign:
            self._at += 1
            return not (word == "," and self._continues_list(draft))
        if word in ("then", "and then") or token.has("conjunctions"):
            self._at += 1
            self._next.is_next = word == "then"
            self._next.is_joined = word == "then"
            return True
        is_said = self._token(1).picture is not None or not self._starts_group(1)
        if token.has("relatives") and is_said and draft.freeze() != Clause():
            self._at += 1
            self._next.is_nearest = True
            return True
        if word == "and":
            return self._ends_at_and(draft)
        if token.has("camera") and draft.freeze() != Clause() and self._is_camera_subject():
            return True
        if draft.verb is not None and self._is_verb(draft, is_second=True):
            forms = {one.form for one in token.all("verb")}
            self._next.is_nearest = "ing" in forms
            self._next.is_joined = not self._next.is_nearest
            return True
        return False

    def _ends_at_and(self, draft: _Draft) -> bool:
        self._at += 1
        if self._token().text.casefold() == "then":
            self._at += 1
            self._next.is_next = self._next.is_joined = True
            return True
        if draft.verb is None:
            return self._token().has("camera")
        joined = _Draft(is_joined=True)
        if self._is_verb(joined):
            self._next = joined
            return True
        return self._starts_group() or self._token().has("camera")

    def _continues_list(self, draft: _Draft) -> bool:
        """Whether a comma stands between subjects: "a car, a bus and a van drive"."""
        if not draft.subjects or draft.verb or draft.before or draft.after:
            return False
        start, is_list = self._at, False
        while self._starts_group() and not self._token().has("camera"):
            self._group()
            if self._token().text not in (",", "and"):
                break
            is_list = is_list or self._token().text == "and"
            self._at += 1
        self._at = start
        return is_list

    def _is_camera_subject(self) -> bool:
        after = self._token(1)
        return after.has("verb", "shots") or after.text.casefold() in ("is", "slowly", "quickly")

    # Parts of a clause

    def _read_camera(self, draft: _Draft) -> bool:
        ahead = 1 if self._token().has("articles") else 0
        if draft.has_subject or draft.verb or not self._token(ahead).has("camera"):
            return self._read_command(draft)
        self._at += ahead + 1
        draft.is_camera = True
        return True

    def _read_command(self, draft: _Draft) -> bool:
        """As "zoom in", "pan left" at the beginning of a clause."""
        is_command = any(one.value.who == "camera" for one in self._token().verbs("base"))
        if draft.freeze() != Clause() or not is_command or self._token().has("noun"):
            return False
        draft.is_camera = True
        draft.verb = self._token()
        self._at += 1
        return True

    def _read_absence(self, draft: _Draft) -> bool:
        if not self._token().has("negations"):
            return False
        if self._token(1).verbs("base", "ing", "ed"):
            draft.after.append(self._token())
            self._at += 2  # the verb is in no clause, and so not understood
            return True
        if not self._starts_group(1):
            return False
        self._at += 1
        draft.absent.append(self._group())
        return True

    def _read_setting(self, draft: _Draft) -> bool:
        token = self._token()
        ahead = 1 if token.has("articles") and self._token(1).has(*_SHOTS) else 0
        self._at += ahead  # "a time lapse of clouds"
        token = self._token()
        if not token.has(*_SETTINGS) or token.has("noun"):
            return False
        if token.has("verb") and draft.verb is None and self._is_verb(draft):
            return False
        after = self._token(1)
        is_before = token.has(*_MODIFIERS) and after.has(*_HEADS, *_MODIFIERS)
        if is_before and not after.has("relations") and not self._is_verb(draft, 1):
            return False
        draft.after.append(token)
        self._at += 1
        return True

    def _read_verb(self, draft: _Draft) -> bool:
        is_to = self._token().text.casefold() == "to"
        if is_to and self._token(1).verbs("base") and draft.verb and draft.verb.is_unknown:
            self._at += 1  # "bends down to drink": the second one is known
            draft.after.clear()
        elif draft.verb is not None or not self._is_verb(draft):
            return False
        if any(one.value.who == "auxiliary" for one in self._token().all("verb")):
            self._at += 1
            if self._token().text.casefold() == "to":
                self._at += 1
            draft.is_joined = True
            return True
        draft.verb = self._token()
        self._at += 1
        if self._token().has("pronouns"):
            draft.is_back = True
            self._at += 1
        elif self._starts_group() and not self._token().has(*_ADVERBS):
            draft.objects.extend(self._groups())
        return True

    def _is_verb(self, draft: _Draft, ahead: int = 0, *, is_second: bool = False) -> bool:
        """Whether the token is a verb of the clause.

        A bare form needs several subjects, and a word that is a noun too needs one right before.
        """
        token, last = self._token(ahead), self._token(ahead - 1)
        if last.has("articles") and not last.has("relatives") and ahead == 0:
            return False
        forms = {one.form for one in token.all("verb")}
        if not forms or (forms == {"base"} and not (draft.is_plural or draft.is_camera)):
            return False
        if is_second:
            return not token.has("noun", "relations") and bool(forms & {"ing", "s"})
        if token.has("noun", "effect", "place", "lights", "weather", "colour", "materials"):
            return (
                draft.has_subject
                and (not draft.after or draft.is_joined)
                and ("s" not in forms or not draft.is_plural or draft.is_joined)
            )
        if draft.has_subject:
            return True
        return "ing" in forms and not self._token(ahead + 1).has("noun")

    def _read_phrase(self, draft: _Draft) -> bool:
        token = self._token()
        if not token.has("relations", "small") or token.text.casefold() in ("and", "or"):
            return False
        if self._token(1).has("pronouns") and token.has("relations"):
            phrase = Phrase(token, is_back=True)
            self._at += 2
        elif self._starts_group(1) and not self._token(1).has(*_ADVERBS):
            self._at += 1
            self._is_of_phrase = True
            phrase = Phrase(token, tuple(self._groups()))
            self._is_of_phrase = False
        elif token.has("directions") or not token.has("relations"):
            return False
        else:
            self._at += 1
            return True
        is_before = draft.verb is None and bool(draft.subjects)
        (draft.before if is_before else draft.after).append(phrase)
        return True

    def _read_pronoun(self, draft: _Draft) -> bool:
        if not self._token().has("pronouns"):
            return False
        if not draft.has_subject and draft.verb is None:
            draft.is_joined = True
        self._at += 1
        return True

    def _read_adverb(self, draft: _Draft) -> bool:
        token = self._token()
        if not token.has(*_ADVERBS) and token.quantity is None:
            return False
        if token.has("paces") and self._starts_group(1) and not draft.has_subject:
            return False
        draft.after.append(token)
        self._at += 1
        return True

    def _read_group(self, draft: _Draft) -> bool:
        is_said = bool(draft.subjects) if draft.verb is None else bool(draft.objects or draft.after)
        if (self._token().is_unknown and is_said) or not self._starts_group():
            return False
        groups = draft.objects if draft.verb is not None else draft.subjects
        groups.append(self._group())
        return True

    def _read_rest(self, draft: _Draft) -> None:
        """A word that is not known right after the subject is taken to be its verb."""
        token = self._token()
        is_manner = token.text.endswith("ly")
        if token.is_unknown and draft.subjects and draft.verb is None and not is_manner:
            draft.verb = token
            if self._token(1).text.casefold() in _PARTICLES:
                self._at += 1
            if self._starts_group(1):
                self._at += 1
                draft.objects.extend(self._groups())
                return
        elif not token.has("small", "style", "articles"):
            draft.after.append(token)
        self._at += 1

    # Noun groups

    def _starts_group(self, ahead: int = 0) -> bool:
        token, after = self._token(ahead), self._token(ahead + 1)
        if token.has("articles"):
            return not after.has("camera") and not after.is_sign
        if token.has("camera", "pronouns", "conjunctions", "relatives") or token.is_sign:
            return False
        if token.has("noun", "place", "effect", "pose", "liquid", "colour", "sizes", "counts"):
            return True
        if token.number is not None or token.has("crossing"):
            return True
        if token.picture is not None:
            return after.has("noun")
        if token.text.casefold().startswith(_PREPOSITIONS):
            return False
        is_before = token.has(*_MODIFIERS) or bool(token.verbs("ing", "ed"))
        if is_before and after.has("noun", "place", *_MODIFIERS) and not after.has("relations"):
            return True
        is_manner = token.text.endswith("ly")
        return token.has("lights", "weather") or (token.is_unknown and not is_manner)

    def _groups(self) -> list[Group]:
        """Groups with "and" between them, but for one that begins a clause."""
        found = [self._group()]
        while self._token().text.casefold() == "and" and self._starts_group(1):
            start = self._at
            self._at += 1
            group = self._group()
            is_unknown = self._token().is_unknown and not self._token().text.endswith("ly")
            if is_unknown or self._is_verb(_Draft(subjects=[group])):
                self._at = start
                break
            found.append(group)
        return found

    def _group(self) -> Group:
        modifiers: list[Token] = []
        unknown: list[Token] = []
        head = None
        article = self._token().text.casefold()
        while self._token().has("articles"):
            self._at += 1
        while (token := self._token()) is not NO_TOKEN:
            if self._ends_group(token, is_empty=not modifiers and not unknown):
                break
            self._at += 1
            if token.is_unknown or _is_bare_verb(token):
                unknown.append(token)
            elif token.text.casefold() == "and":  # a second colour: "black and white"
                unknown.append(self._token())
                self._at += 1
            elif not token.has(*_HEADS) or self._stands_before(token):
                modifiers.append(token)
            elif self._is_compound():
                unknown.append(token)
            else:
                head = token
                break
        if head is None and not unknown and not modifiers:
            self._at += 1
            unknown.append(token)
        if head is not None and self._token().picture is not None:
            if not self._token(1).has("noun"):  # "the digit 7"
                modifiers.append(self._token())
                self._at += 1
        is_definite = article in ("the", "its", "his", "her", "their")
        is_single = article in ("a", "an")
        return Group(
            head, tuple(modifiers), tuple(unknown), is_definite, is_single, self._read_of()
        )

    def _ends_group(self, token: Token, *, is_empty: bool) -> bool:
        if token.is_sign or token.has("camera", "pronouns", "conjunctions", "relatives"):
            return True
        if token.text.casefold() == "and":
            return not (self._token(-1).has("colour") and self._token(1).has("colour"))
        if token.is_unknown or token.has(*_HEADS, *_MODIFIERS):
            return False
        if token.number is not None or token.picture is not None:
            return False
        if token.has("articles"):
            return not is_empty
        after = self._token(1)
        if _is_bare_verb(token) and self._token(-1).has("articles", *_MODIFIERS):
            return not after.has(*_HEADS)  # "an open field"
        is_attribute = bool(token.verbs("ing", "ed")) and (
            after.has(*_HEADS, *_MODIFIERS) or after.is_unknown
        )
        return not is_attribute

    def _stands_before(self, token: Token) -> bool:
        """Whether a word that may be a head, just read, is a modifier: "orange ball"."""
        after = self._token()
        if not token.has(*_MODIFIERS):
            return token.has("place") and after.has("place") and not after.has("noun")
        return after.has(*_HEADS, "colour", "materials", "sizes") and not after.has("relations")

    def _is_compound(self) -> bool:
        """Whether the word that follows is the head: "dog house", "bus driver waves"."""
        after, third = self._token(), self._token(1)
        if after.has("noun", "place") and not after.has("verb", "relations", "directions"):
            return True
        is_end = third.is_sign and self._is_of_phrase  # "in a traffic jam"
        is_verb = bool(third.verbs("s")) or third.text.casefold() == "is"
        return after.is_unknown and not after.text.endswith("ly") and (is_verb or is_end)

    def _read_of(self) -> Group | None:
        if self._token().text.casefold() != "of" or not self._starts_group(1):
            return None
        self._at += 1
        return self._group()
