"""Phrases to words with a part of speech: the neighbours decide."""

from __future__ import annotations

from collections.abc import Sequence

from texvent.scenes.language.words.cutting import correct_token, cut_tokens
from texvent.scenes.language.words.english import Pos, VerbForm, list_readings
from texvent.scenes.language.words.lexicon import Lexicon, Meaning, Role
from texvent.scenes.language.words.read_so_far import NOMINAL, ReadSoFar
from texvent.scenes.language.words.tokens import Token
from texvent.scenes.language.words.word import Word, is_possessive

_OPENS_NOUN = frozenset({Pos.DETERMINER, Pos.NUMBER, Pos.ADJECTIVE})
"""After these a noun or one more adjective follows."""
_ONLY_OPENS = frozenset({Pos.DETERMINER, Pos.PRONOUN, Pos.NUMBER})
"""Before these a noun cannot end: "the headlights of a lorry blind the driver"."""
_OF_FILM = (Role.CAMERA, Role.CAMERA_MOVE, Role.VIEW, Role.FRAMING)
"""What a verb follows at once: "the camera pans", "an aerial view shows"."""
_STATES = frozenset({"open", "clean", "dry", "empty"})
"""Verbs that are adjectives before a bare noun: "open suitcase", unlike "open the suitcase"."""
_STARTS_GROUP = _OPENS_NOUN | {Pos.NOUN, Pos.PRONOUN}


def tag_words(tokens: Sequence[Token], known: Lexicon) -> tuple[list[Word], list[str]]:
    """Cut the tokens into words, each with the reading that suits its neighbours.

    Returns:
        The words, and a note for each spelling that was corrected.
    """
    notes: list[str] = []
    tokens = [
        token if _is_written_as_name(tokens, number) else correct_token(token, known, notes)
        for number, token in enumerate(tokens)
    ]
    spans = list(cut_tokens(tokens, known))
    texts = [" ".join(token.text for token in span) for span, _ in spans]
    owners = frozenset(number for number, (span, _) in enumerate(spans) if is_possessive(span[-1]))
    tagger = _Tagger([candidates for _, candidates in spans], texts, owners)
    words: list[Word] = []
    for index, (span, candidates) in enumerate(spans):
        chosen = tagger.choose(index)
        others = tuple(one for one in candidates if one is not chosen)
        text = texts[index]
        lemma = next((one.lemma for one in list_readings(text) if one.pos is chosen.pos), text)
        words.append(Word(tuple(span), chosen, lemma, others=others))
    for word, before in zip(words[1:], words, strict=False):
        is_unknown = word.role is Role.UNKNOWN and word.pos is Pos.NOUN
        word.is_name = is_unknown and _is_written_as_name([before.tokens[-1], word.tokens[0]], 1)
    return words, notes


def _is_written_as_name(tokens: Sequence[Token], number: int) -> bool:
    """Whether a word inside a sentence has a capital letter: "along the Seine"."""
    is_inside = number > 0 and tokens[number - 1].text not in (".", "!", "?", ":")
    return is_inside and tokens[number].written[:1].isupper()


class _Tagger(ReadSoFar):
    """Chooses readings from left to right."""

    def choose(self, index: int) -> Meaning:
        """The reading of word `index`, after those before it."""
        options = self._candidates[index]
        by_pos = {meaning.pos: meaning for meaning in reversed(options)}
        chosen = by_pos[self._decide(index, by_pos)]
        self._note(chosen)
        self._chosen.append(chosen)
        return chosen

    def _decide(self, index: int, by_pos: dict[Pos, Meaning]) -> Pos:
        if len(by_pos) == 1:
            return next(iter(by_pos))
        for rule in (self._closed_class, self._verb_or_not, self._after_object, self._open_class):
            found = rule(index, by_pos)
            if found is not None:
                return found
        return next(iter(by_pos))

    def _closed_class(self, index: int, by_pos: dict[Pos, Meaning]) -> Pos | None:
        """Prepositions, adverbs, relatives and other words of grammar."""
        before, after = self._before(), self._after(index)
        if Pos.TO in by_pos:
            coming = self._candidates[index + 1] if after else []
            return Pos.TO if self._is_infinitive(index, coming) else Pos.PREPOSITION
        if Pos.RELATIVE in by_pos:
            if before in (Pos.NOUN, Pos.PRONOUN, Pos.SIGN, Pos.PREPOSITION, Pos.ADJUNCT):
                is_determiner = Pos.DETERMINER in by_pos and before is Pos.PREPOSITION
                return Pos.DETERMINER if is_determiner else Pos.RELATIVE
            return Pos.DETERMINER if Pos.DETERMINER in by_pos else Pos.RELATIVE
        if self._texts[index] == "other":
            return Pos.ADJECTIVE if before is Pos.NUMBER else Pos.DETERMINER
        if Pos.DETERMINER in by_pos and Pos.PRONOUN in by_pos:
            return Pos.DETERMINER if after & (NOMINAL | {Pos.ADVERB}) else Pos.PRONOUN
        if Pos.NUMBER in by_pos:
            return Pos.NUMBER
        if Pos.AUXILIARY in by_pos:
            return Pos.AUXILIARY if after & {Pos.VERB, Pos.NEGATION} else Pos.VERB
        if Pos.PREPOSITION in by_pos:
            return self._preposition(by_pos, after)
        if Pos.SUBORDINATOR in by_pos and Pos.ADVERB in by_pos:
            return Pos.SUBORDINATOR if before in (None, Pos.SIGN, Pos.CONJUNCTION) else Pos.ADVERB
        return None

    def _is_infinitive(self, index: int, coming: Sequence[Meaning]) -> bool:
        """As in "stops to tie his shoe", unlike "to hot oil" and "to tie"."""
        if not any(one.pos is Pos.VERB and one.form is VerbForm.BASE for one in coming):
            return False
        object_follows = self._after(index, 2)
        if index and self._texts[index - 1] in ("where", "how", "what", "when"):
            return True
        if object_follows and object_follows <= _ONLY_OPENS:
            return True
        is_known_verb = any(one.pos is Pos.VERB and one.role is not Role.UNKNOWN for one in coming)
        is_attribute = any(one.pos is Pos.ADJECTIVE for one in coming) and not is_known_verb
        if is_attribute and object_follows & NOMINAL:
            return False
        return not any(one.pos is not Pos.VERB and one.role is not Role.UNKNOWN for one in coming)

    def _preposition(self, by_pos: dict[Pos, Meaning], after: frozenset[Pos]) -> Pos | None:
        before = self._before()
        if before in (Pos.DETERMINER, Pos.NUMBER) and by_pos.keys() & NOMINAL:
            return None
        opens_clause = Pos.SUBORDINATOR in by_pos and before in (None, Pos.SIGN)
        if opens_clause and not after & {Pos.DETERMINER, Pos.NUMBER}:
            return Pos.SUBORDINATOR
        if after & (_STARTS_GROUP | {Pos.VERB, Pos.NEGATION, Pos.RELATIVE}):
            return Pos.PREPOSITION
        if Pos.ADVERB in by_pos:
            return Pos.ADVERB
        return Pos.PREPOSITION

    def _verb_or_not(self, index: int, by_pos: dict[Pos, Meaning]) -> Pos | None:
        """Whether a word that can be a verb is one."""
        verb = by_pos.get(Pos.VERB)
        if verb is None:
            return None
        others = by_pos.keys() - {Pos.VERB}
        last = self._chosen[-1] if self._chosen else None
        is_one = last is not None and last.role is Role.COUNT and last.value == 1
        if is_one and verb.form is VerbForm.THIRD:
            return Pos.VERB
        if not others or self._before() is Pos.TO or self._is_of_camera(index, verb):
            return Pos.VERB
        if index - 1 in self._owners and Pos.NOUN in others and verb.form is not VerbForm.ING:
            return None  # "a woman's hands"
        adverb = by_pos.get(Pos.ADVERB)
        is_adverb = adverb is not None and adverb.role is not Role.UNKNOWN
        if self._is_of_leave(index):
            return Pos.VERB
        if is_adverb and (verb.role is Role.UNKNOWN or verb.form is VerbForm.PAST):
            return None
        if self._goes_on(index, verb):
            return Pos.VERB
        noun = by_pos.get(Pos.NOUN)
        is_noun = noun is not None and noun.role is not Role.UNKNOWN
        is_known = is_noun or self._is_known(index, Pos.ADJECTIVE)
        if (
            verb.role is Role.UNKNOWN
            and is_known
            and self._before() in _OPENS_NOUN | {None, Pos.PREPOSITION, Pos.SIGN}
        ):
            return None
        return self._verb_by_context(index, verb, others)

    def _is_of_leave(self, index: int) -> bool:
        """As in "is left alone", "left the garage": a form of "leave", and no direction."""
        if self._texts[index] != "left":
            return False
        is_passive = self._before() is Pos.AUXILIARY
        leaves = self._before() is Pos.NOUN and not self._has_verb and self._after(index) == {
            Pos.DETERMINER
        }  # fmt: skip
        return is_passive or leaves

    def _is_of_camera(self, index: int, verb: Meaning) -> bool:
        """As in "the camera tracks him": no tracks of a camera."""
        last = self._chosen[-1] if self._chosen else None
        is_finite = verb.form is VerbForm.THIRD or verb.role is Role.FUNCTION
        if last is None or not is_finite or not self._texts[index].endswith("s"):
            return False
        if last.role in _OF_FILM:
            return not self._has_verb and not self._finite_follows(index)
        own = self._sentence_so_far()
        while own and own[-1].pos is Pos.ADVERB:
            own.pop()
        can_be_move = any(one.role is Role.CAMERA_MOVE for one in self._candidates[index])
        if not can_be_move or not own or own[-1].pos is not Pos.CONJUNCTION:
            return False
        nouns = [one for one in own if one.pos in (Pos.NOUN, Pos.PRONOUN)]
        return bool(nouns) and nouns[0].role is Role.CAMERA

    def _goes_on(self, index: int, verb: Meaning) -> bool:
        """As "arches" in "tosses the ball, arches her back": one more verb, and its object."""
        after = self._after(index)
        is_next = self._before() in (Pos.SIGN, Pos.CONJUNCTION) and verb.form is VerbForm.THIRD
        return (
            is_next and bool(after) and after <= _ONLY_OPENS and self._last_verb_form() is verb.form
        )

    def _verb_by_context(
        self, index: int, verb: Meaning, others: set[Pos] | frozenset[Pos]
    ) -> Pos | None:
        before, after = self._before(), self._after(index)
        if self._is_clothed() and verb.role is not Role.UNKNOWN and not after & NOMINAL:
            return Pos.VERB
        if before in (Pos.PRONOUN, Pos.RELATIVE, Pos.AUXILIARY):
            is_adjective = Pos.ADJECTIVE in others and verb.form is VerbForm.BASE
            return Pos.ADJECTIVE if is_adjective else Pos.VERB
        if verb.form is VerbForm.ING:
            return self._gerund(index, verb, others)
        if verb.form is VerbForm.PAST and before in _OPENS_NOUN | {None, Pos.SIGN, Pos.PREPOSITION}:
            return self._attribute(index, others, after)
        if before is Pos.NOUN:
            return self._after_noun(index, verb)
        if before in (Pos.CONJUNCTION, Pos.SIGN, Pos.SUBORDINATOR, Pos.ADVERB):
            return self._coordinated(index, verb, others)
        is_attribute = Pos.ADJECTIVE in others and after & NOMINAL and not after & _ONLY_OPENS
        is_state = verb.role is Role.UNKNOWN or self._texts[index] in _STATES
        if before is None and is_attribute and is_state:
            return Pos.ADJECTIVE  # "busy street"
        is_order = before is None and verb.form is VerbForm.BASE and Pos.NOUN not in others
        return Pos.VERB if is_order and not after & {Pos.VERB, Pos.AUXILIARY} else None

    def _gerund(self, index: int, verb: Meaning, others: set[Pos] | frozenset[Pos]) -> Pos | None:
        before, after = self._before(), self._after(index)
        if Pos.NOUN in others and verb.role is Role.UNKNOWN and self._finite_follows(index):
            return Pos.NOUN
        if (
            any(one.role is Role.GLOW for one in self._candidates[index])
            and not after & _ONLY_OPENS
        ):
            return Pos.NOUN  # "warm lighting"
        is_with = before is Pos.PREPOSITION and self._ends_with(index - 1, "with", "in")
        if is_with and Pos.NOUN in others and not after & _STARTS_GROUP:
            return Pos.NOUN  # "a cake with frosting"
        if before in _OPENS_NOUN:
            if after & NOMINAL and not after & {Pos.PREPOSITION}:
                is_verb = verb.role is not Role.UNKNOWN and not self._is_known(index, Pos.ADJECTIVE)
                return Pos.ADJECTIVE if Pos.ADJECTIVE in others and not is_verb else Pos.VERB
            return Pos.NOUN if Pos.NOUN in others else Pos.VERB
        if before is Pos.NOUN and Pos.NOUN in others and verb.role is Role.UNKNOWN:
            is_head = after & {Pos.VERB, Pos.AUXILIARY} and not after & {Pos.NOUN}
            return Pos.NOUN if is_head else Pos.VERB
        return Pos.VERB

    def _ends_with(self, index: int, *words: str) -> bool:
        """Whether a word, or the phrase that is one, ends with one of these."""
        return self._texts[index].split()[-1] in words

    def _is_known(self, index: int, pos: Pos) -> bool:
        """Whether the lexicon has it as that part of speech."""
        options = self._candidates[index]
        return any(one.pos is pos and one.role is not Role.UNKNOWN for one in options)

    def _attribute(
        self, index: int, others: set[Pos] | frozenset[Pos], after: frozenset[Pos]
    ) -> Pos | None:
        """A past participle before its noun: "a parked car", "painted walls"."""
        rest = [one for one in self._candidates[index] if one.pos in others]
        known = [one for one in rest if one.role is not Role.UNKNOWN]
        is_noun = Pos.NOUN in {one.pos for one in known} and bool(after)
        if is_noun and (self._is_gerund(index + 1) or self._ends_group(index)):
            return Pos.NOUN  # "an LED blinks", "LED blinking"
        if after & NOMINAL:
            return Pos.ADJECTIVE if Pos.ADJECTIVE in others else Pos.VERB
        return (known or rest)[0].pos if rest else Pos.VERB

    def _after_noun(self, index: int, verb: Meaning) -> Pos | None:
        """Subject and verb agree in number: "a dog barks", "dogs bark", but "dog barks"."""
        after = self._after(index)
        if verb.form is VerbForm.PAST:
            return Pos.VERB
        is_known_base = verb.form is VerbForm.BASE and verb.role is not Role.UNKNOWN
        if is_known_base and self._perceives():
            return Pos.VERB
        if self._has_verb and not self._opens_clause():
            return None
        if after & {Pos.AUXILIARY} or (self._finite_follows(index) and not after & NOMINAL):
            return None
        if after and after <= _ONLY_OPENS and verb.form is VerbForm.BASE:
            return None if self._is_fronted() else Pos.VERB
        is_singular = verb.form is VerbForm.THIRD
        numbers = (self._is_plural, self._subject_is_plural)
        agrees = any(plural is None or is_singular != plural for plural in numbers)
        return Pos.VERB if agrees else None

    def _coordinated(
        self, index: int, verb: Meaning, others: set[Pos] | frozenset[Pos]
    ) -> Pos | None:
        """After "and", a comma or an adverb: a verb like the one before, or else a noun."""
        after = self._after(index)
        if Pos.NOUN not in others and Pos.ADJECTIVE not in others:
            return Pos.VERB
        if after & {Pos.AUXILIARY} or (verb.form is VerbForm.BASE and self._finite_follows(index)):
            return None
        form = self._last_verb_form()
        is_parallel = form is not None and form is verb.form
        if self._before() is Pos.ADVERB and form is None and verb.form is VerbForm.THIRD:
            return Pos.VERB
        return Pos.VERB if is_parallel else None

    def _after_object(self, index: int, by_pos: dict[Pos, Meaning]) -> Pos | None:
        """As "high" in "throws the ball high", "back" in "snaps back", which are no nouns."""
        is_known = any(one.role is not Role.UNKNOWN for one in by_pos.values())
        if is_known or Pos.ADVERB not in by_pos or self._after(index) & NOMINAL:
            return None
        if self._before() is Pos.VERB or self._follows_object_pronoun():
            return Pos.ADVERB
        group = [one.pos for one in self._chosen]
        while group and group[-1] in NOMINAL | {Pos.DETERMINER}:
            group.pop()
        is_object = self._before() is Pos.NOUN and group and group[-1] is Pos.VERB
        return Pos.ADVERB if is_object else None

    def _open_class(self, index: int, by_pos: dict[Pos, Meaning]) -> Pos | None:
        """Nouns, adjectives and adverbs."""
        before, after = self._before(), self._after(index)
        known = {pos: one for pos, one in by_pos.items() if one.role is not Role.UNKNOWN}
        known.pop(Pos.VERB, None)
        opens = before in _OPENS_NOUN or before in (Pos.PREPOSITION, None, Pos.NEGATION)
        if {Pos.ADVERB, Pos.ADJECTIVE} <= known.keys() and Pos.NOUN not in known:
            return Pos.ADJECTIVE if after & NOMINAL and opens else Pos.ADVERB
        if len(known) == 1:
            pos = next(iter(known))
            is_substance = known[pos].role is Role.MATERIAL and Pos.NOUN in by_pos
            if is_substance and not after & {Pos.NOUN, Pos.ADJECTIVE}:
                return Pos.NOUN
            if pos in NOMINAL or not (opens and by_pos.keys() & {Pos.NOUN}):
                return pos
        colour = by_pos.get(Pos.ADJECTIVE)
        is_colour = colour is not None and colour.role is Role.COLOUR
        if is_colour and self._chosen and self._chosen[-1].form is VerbForm.PAST:
            return Pos.ADJECTIVE
        if Pos.ADJECTIVE in by_pos and Pos.NOUN in by_pos:
            is_attribute = after & {Pos.NOUN, Pos.ADJECTIVE} and not self._ends_group(index)
            if is_attribute or (before in _OPENS_NOUN and self._participle_follows(index)):
                return Pos.ADJECTIVE
            return Pos.NOUN if before is not Pos.AUXILIARY else Pos.ADJECTIVE
        if Pos.ADVERB in by_pos and Pos.ADJECTIVE in by_pos:
            is_attribute = after & NOMINAL and (opens or before is Pos.SIGN)
            return Pos.ADJECTIVE if is_attribute else Pos.ADVERB
        if Pos.NOUN in by_pos and (opens or before in (Pos.VERB, Pos.NOUN)):
            return Pos.NOUN
        rest = [pos for pos in by_pos if pos is not Pos.VERB]
        return rest[0] if rest else Pos.VERB

    def _participle_follows(self, index: int) -> bool:
        """As in "the high elevated peaks": a past participle and its noun come next."""
        coming = self._candidates[index + 1] if index + 1 < len(self._candidates) else []
        is_past = any(one.form is VerbForm.PAST for one in coming)
        return is_past and Pos.NOUN in self._after(index, 2)

    def _is_gerund(self, index: int) -> bool:
        return any(one.form is VerbForm.ING for one in self._candidates[index])

    def _ends_group(self, index: int) -> bool:
        """Whether what follows is rather a verb: "the red leaves"."""
        after = self._candidates[index + 1]
        can_be_verb = any(
            one.pos is Pos.VERB and (one.role is Role.VERB or one.form is VerbForm.THIRD)
            for one in after
        )
        is_known_verb = any(
            one.pos is Pos.VERB and one.role is not Role.UNKNOWN and one.form is VerbForm.THIRD
            for one in after
        )
        if is_known_verb and not self._after(index, 2) & {Pos.NOUN, Pos.VERB, Pos.AUXILIARY}:
            return True
        return can_be_verb and not any(
            one.pos is Pos.NOUN and one.role is not Role.UNKNOWN for one in after
        )
