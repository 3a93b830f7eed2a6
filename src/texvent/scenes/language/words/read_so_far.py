"""What the tagger has read of a sentence, and what may come."""

from __future__ import annotations

from texvent.scenes.language.vocabulary.function import SENTENCE_OPENERS
from texvent.scenes.language.words.english import Pos, VerbForm, list_readings
from texvent.scenes.language.words.lexicon import Meaning, Role

NOMINAL = frozenset({Pos.NOUN, Pos.ADJECTIVE, Pos.NUMBER})
_OPENS_CLAUSE = frozenset({Pos.SUBORDINATOR, Pos.RELATIVE, Pos.SIGN})
_PASSED_OVER = (Role.SIDE, Role.LIGHT)
"""Adjuncts that stand between a subject and its verb: "a car at night drives left"."""
_PERCEIVED = frozenset({"watch", "see", "hear", "let", "make", "help", "film"})
"""Verbs before a noun and a verb in its base form: "watches a fish swim"."""


class ReadSoFar:
    """The readings chosen so far, and those that each word can have."""

    def __init__(
        self, candidates: list[list[Meaning]], texts: list[str], owners: frozenset[int]
    ) -> None:
        self._candidates = candidates
        self._texts = texts
        self._owners = owners
        """Numbers of the words that end in a possessive 's."""
        self._chosen: list[Meaning] = []
        self._sentence_start = 0
        """Number of the first word of the sentence."""
        self._has_verb = False
        """Whether the clause has a finite verb."""
        self._is_plural: bool | None = False
        """Whether the last noun group is plural; None = it can be either."""
        self._counts_group = False
        """Whether a number opened the noun group."""
        self._subject_is_plural: bool | None = False
        """The same of the subject: the first noun group of the clause."""
        self._has_subject = False

    def _note(self, meaning: Meaning) -> None:
        if ends_sentence := meaning.pos is Pos.SIGN and meaning.value in ".;!?:":
            self._sentence_start = len(self._chosen) + 1
        if ends_sentence or meaning.pos in (Pos.SUBORDINATOR, Pos.RELATIVE):
            self._has_verb = False
        elif meaning.pos is Pos.AUXILIARY or (
            meaning.pos is Pos.VERB and meaning.form is not VerbForm.ING
        ):
            self._has_verb = True
        elif meaning.pos is Pos.NOUN:
            self._is_plural = self._decide_plural(meaning)
            if not self._has_subject:
                self._subject_is_plural = self._is_plural
        elif meaning.pos is Pos.PREPOSITION:
            self._has_subject = True
        elif meaning.pos is Pos.CONJUNCTION and not self._has_verb:
            self._subject_is_plural = self._is_plural = None
            self._has_subject = True
        is_next = meaning.pos is Pos.CONJUNCTION and self._has_verb
        if is_next or meaning.pos in _OPENS_CLAUSE:
            self._has_subject = False
        self._counts_group = meaning.pos is Pos.NUMBER or (
            self._counts_group and meaning.pos in NOMINAL
        )

    def _decide_plural(self, meaning: Meaning) -> bool | None:
        """None where both fit: "a flock of birds crosses" and "cross", "deer stands", "stand"."""
        if self._counts_group or meaning.can_be_both:
            return None
        return meaning.is_plural

    def _before(self) -> Pos | None:
        """Part of speech of the word before; None at the start of a sentence.

        Adjuncts ("the kid on the left jumps") and "not" after an auxiliary are passed over.
        """
        for number in range(len(self._chosen) - 1, -1, -1):
            meaning = self._chosen[number]
            if meaning.pos is Pos.SIGN and meaning.value in ".;!?:":
                return None
            is_not = meaning.pos is Pos.NEGATION and number > 0
            if is_not and self._chosen[number - 1].pos is Pos.AUXILIARY:
                continue
            if meaning.pos is Pos.ADJUNCT and number > 0 and meaning.role in _PASSED_OVER:
                continue
            is_opener = meaning.pos is Pos.SUBORDINATOR and meaning.value in SENTENCE_OPENERS
            if is_opener and number > 0 and self._chosen[number - 1].pos is Pos.PRONOUN:
                continue
            return meaning.pos
        return None

    def _after(self, index: int, steps: int = 1) -> frozenset[Pos]:
        if index + steps >= len(self._candidates):
            return frozenset()
        return frozenset(meaning.pos for meaning in self._candidates[index + steps])

    def _sentence_so_far(self) -> list[Meaning]:
        """What was chosen of the sentence before this word; commas do not end it."""
        return self._chosen[self._sentence_start :]

    def _is_fronted(self) -> bool:
        """Whether the clause is a phrase so far: "At a skate park a man ..." has no subject yet."""
        own = self._sentence_so_far()
        if not own or own[0].pos is not Pos.PREPOSITION:
            return False
        return sum(one.pos is Pos.DETERMINER for one in own) < 2

    def _finite_follows(self, index: int) -> bool:
        """Whether the next word can be a verb in the third person."""
        coming = self._candidates[index + 1] if index + 1 < len(self._candidates) else []
        return any(one.pos is Pos.VERB and one.form is VerbForm.THIRD for one in coming)

    def _is_clothed(self) -> bool:
        """As in "a keeper in green": a verb may follow."""
        at = len(self._chosen)
        return at > 1 and self._chosen[-1].role is Role.COLOUR and self._texts[at - 2] == "in"

    def _perceives(self) -> bool:
        """As in "watches a fish swim": the last verb says that it is seen or heard."""
        for number in range(len(self._chosen) - 1, -1, -1):
            if self._chosen[number].pos is Pos.VERB:
                text = self._texts[number]
                return any(one.lemma in _PERCEIVED for one in list_readings(text))
        return False

    def _follows_object_pronoun(self) -> bool:
        """As in "pulls himself ...", unlike "he ..."."""
        pair = [one.pos for one in self._chosen[-2:]]
        return pair == [Pos.VERB, Pos.PRONOUN]

    def _opens_clause(self) -> bool:
        """Whether another finite verb may come: after a comma, "and", or a relative clause."""
        is_after_verb = False
        for meaning in reversed(self._chosen):
            if meaning.pos is Pos.RELATIVE:
                return True
            if meaning.pos in (Pos.SUBORDINATOR, Pos.CONJUNCTION, Pos.SIGN):
                return not is_after_verb
            is_finite = meaning.pos is Pos.AUXILIARY or (
                meaning.pos is Pos.VERB and meaning.form in (VerbForm.THIRD, VerbForm.BASE)
            )
            if is_finite and is_after_verb:
                return False
            is_after_verb = is_after_verb or is_finite
        return not is_after_verb

    def _last_verb_form(self) -> VerbForm | None:
        for meaning in reversed(self._chosen):
            if meaning.pos is Pos.SIGN and meaning.value in ".;!?":
                return None
            if meaning.pos is Pos.RELATIVE or (
                meaning.pos is Pos.SUBORDINATOR and meaning.value not in SENTENCE_OPENERS
            ):
                return None
            if meaning.pos is Pos.AUXILIARY and meaning.value in ("is", "are"):
                return VerbForm.THIRD if meaning.value == "is" else VerbForm.BASE
            if meaning.pos is Pos.VERB and meaning.form in (VerbForm.THIRD, VerbForm.BASE):
                return meaning.form
        return None
