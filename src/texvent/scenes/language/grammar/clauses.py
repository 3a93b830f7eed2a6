"""Words to clauses: every verb gets the subjects and objects of its own clause.

The rules, in the order in which they apply to a verb:

1. After "is", "are" ... it completes the clause.
2. A clause with a subject and no verb takes it.
3. A relative ("that", "who") gives it the noun before.
4. After "and", a comma or "then" it has the subjects of the verb before, and comes after it.
5. A participle after a comma has the subjects of the clause; directly after a noun, that noun.
6. A finite verb after a participle or a relative clause has the subjects before that clause.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

from texvent.scenes.description import FORMATIONS
from texvent.scenes.language.grammar.group_attachment import GroupAttachment
from texvent.scenes.language.grammar.noun_groups import PEOPLE, read_group, starts_group
from texvent.scenes.language.grammar.syntax import Clause, NounGroup
from texvent.scenes.language.vocabulary.function import (
    CONTRASTS,
    NOBODY,
    SENTENCE_OPENERS,
    TIME_ORDER,
)
from texvent.scenes.language.vocabulary.verbs import Verb
from texvent.scenes.language.words.english import Pos, VerbForm
from texvent.scenes.language.words.lexicon import Meaning, Role
from texvent.scenes.language.words.word import Word

SENTENCE_SIGNS = frozenset(".;!?:\n")
_AWAITS_NOUN = frozenset(
    {None, Pos.SIGN, Pos.PREPOSITION, Pos.CONJUNCTION, Pos.SUBORDINATOR, Pos.VERB}
)
"""Parts of speech after which a participle may open a noun group."""
_VIEWS = frozenset({"view", "shot", "perspective", "footage"})
"""Words after which "from behind" says where the camera is: "a view from behind the rider"."""
_JOINING_SIGNS = frozenset(",()[]")
_FIRST = ("when", "after", "once", "whenever")
"""Subordinators whose clause, at the start of a sentence, comes before the main clause."""


def read_clauses(words: Sequence[Word]) -> list[Clause]:
    """All clauses of a prompt, in order."""
    return _ClauseReader(words).read()


class _ClauseReader(GroupAttachment):
    """One pass over the words."""

    def __init__(self, words: Sequence[Word]) -> None:
        super().__init__(words)
        self._readers: dict[Pos, Callable[[Word], None]] = {
            Pos.SIGN: self._read_sign,
            Pos.CONJUNCTION: self._read_conjunction,
            Pos.SUBORDINATOR: self._open_subordinate,
            Pos.RELATIVE: self._open_relative,
            Pos.NEGATION: self._read_negation,
            Pos.AUXILIARY: self._read_auxiliary,
            Pos.TO: self._read_to,
            Pos.PREPOSITION: self._read_preposition,
        }

    def read(self) -> list[Clause]:
        """All clauses."""
        while self._at < len(self._words):
            self._step()
        self._close()
        return [clause for clause in self._clauses if not clause.is_empty]

    def _step(self) -> None:
        word = self._words[self._at]
        read = self._readers.get(word.pos)
        coming = self._words[self._at + 1 : self._at + 2]
        is_view = self._at > 0 and self._words[self._at - 1].text in _VIEWS
        is_before_noun = bool(coming) and coming[0].pos is Pos.DETERMINER
        if word.text == "from behind" and is_before_noun and not is_view:
            # As in "watches from behind a fence": no view of the camera.
            word.meaning = Meaning(Role.RELATION, Pos.PREPOSITION, "behind")
            self._read_preposition(word)
        elif read is not None:
            read(word)
        elif word.pos is Pos.DETERMINER and self._is_before_adjunct():
            self._skip(word)
        elif self._starts_group():
            self._read_group(word)
        elif word.pos is Pos.VERB:
            self._read_verb(word)
        else:
            self._read_adverb(word)

    def _read_group(self, word: Word) -> None:
        group, end = read_group(self._words, self._at)
        if end == self._at:
            self._read_adverb(word)  # as in "between in camera zoom dark"
            return
        self._at = end
        self._add_group(group)

    def _read_adverb(self, word: Word) -> None:
        self._at += 1
        if word.role is not Role.SIDE or word.meaning.value in FORMATIONS:
            self._clause.adverbs.append(word)
            return
        before = self._words[self._at - 2 : self._at - 1]
        if self._last is not None and before == [self._last.head]:
            self._last.sides.append(word)  # as in "a house on the left and a tree on the right"
            return
        if self._is_joined and starts_group(self._words, self._at, is_opening=True):
            self._close()  # as in "a man waves, on the right a woman claps"
        self._clause.adverbs.append(word)

    def _read_conjunction(self, word: Word) -> None:
        self._is_joined = "and"
        if self._clause.verb is None:
            self._clause.is_listed = True
        if word.text in CONTRASTS:
            self._negation = None
        self._skip(word)

    def _read_negation(self, word: Word) -> None:
        if word.text.split()[0] in ("without", "with", "free"):
            self._read_preposition(word, negation=word)
            return
        self._at += 1
        if word.text == "neither" and self._verb_comes():
            self._clause.negation = word
            return
        self._negation = word
        if word.text in NOBODY:
            self._add_group(NounGroup(head=word))

    def _verb_comes(self) -> bool:
        """Whether a verb comes before the sentence ends."""
        for word in self._words[self._at :]:
            if word.pos is Pos.VERB:
                return True
            if word.pos is Pos.SIGN and word.text in SENTENCE_SIGNS:
                return False
        return False

    def _read_to(self, word: Word) -> None:
        self._skip(word)
        self._continue_with_same_subjects("after")

    def _is_before_adjunct(self) -> bool:
        """As in "A close-up of", "a slow tracking shot of": no noun follows."""
        first = self._at + 1
        is_paced = first < len(self._words) and self._words[first].role is Role.PACE
        first += 1 if is_paced else 0
        coming = self._words[first : first + 2]
        return bool(coming) and coming[0].pos is Pos.ADJUNCT and (
            len(coming) == 1 or coming[1].pos not in (Pos.NOUN, Pos.ADJECTIVE)
        )  # fmt: skip

    def _starts_group(self) -> bool:
        before = self._words[self._at - 1].pos if self._at else None
        awaits_noun = before in _AWAITS_NOUN
        is_verb_wanted = bool(self._clause.auxiliaries) and self._clause.verb is None
        is_subject_open = bool(self._clause.subjects) and self._clause.verb is None
        is_opening = awaits_noun and not is_verb_wanted and not (
            is_subject_open and before not in (Pos.PREPOSITION,)
        )  # fmt: skip
        return starts_group(self._words, self._at, is_opening=is_opening)

    def _read_sign(self, word: Word) -> None:
        self._at += 1
        word.is_used = True
        if word.text in SENTENCE_SIGNS:
            self._close()
            self._sentence = len(self._clauses)
            self._clause.sentence += 1
            self._outer = []
            self._negation = None
            self._last = self._anchor = None
            self._is_joined = ""
            self._next_order = "same"
        elif word.text == "/":
            self._is_joined = "and"
            self._clause.is_listed = self._clause.is_listed or self._clause.verb is None
        elif word.text in _JOINING_SIGNS:
            self._is_joined = ","

    def _open_subordinate(self, word: Word) -> None:
        coming = self._words[self._at + 1 : self._at + 3]
        if [one.pos for one in coming] == [Pos.NUMBER, Pos.NOUN] and coming[1].role is Role.UNIT:
            self._read_preposition(word)
            return
        if self._is_followed_by_thing(word):
            word.meaning = Meaning(Role.RELATION, Pos.PREPOSITION, "follow")
            self._read_preposition(word)
            return
        word.is_used = True
        self._at += 1
        is_first = self._clause.is_empty
        subjects = self._clause.subjects
        order = TIME_ORDER.get(word.text, "same")
        if word.text in SENTENCE_OPENERS:
            if is_first:
                self._clause.order = "after" if self._clauses else "same"
                self._clause.opener = word
                return
            if self._next_is_verb():
                self._close()
                self._clause.subjects, self._clause.opener = list(subjects), word
                self._clause.order = "after"
                self._is_joined = ""
                return
        self._outer = []
        if not is_first:
            self._close()
        self._clause.opener = word
        self._clause.order = "same" if is_first else order
        if is_first and word.text in _FIRST:
            self._next_order = "after"
        if self._next_is_verb():
            self._clause.subjects = list(subjects)
        self._is_joined = ""
        self._last = self._anchor = None

    def _is_followed_by_thing(self, word: Word) -> bool:
        """As in "a duck followed by three ducklings", unlike "a jump followed by a spin"."""
        at = self._at + 1
        if "followed" not in word.text or not starts_group(self._words, at, is_opening=True):
            return False
        head = read_group(self._words, at)[0].head
        return head is not None and head.read_as(Role.NOUN) is not None

    def _next_is_verb(self) -> bool:
        at = self._at
        while at < len(self._words) and self._words[at].pos is Pos.ADVERB:
            at += 1
        return at < len(self._words) and self._words[at].pos is Pos.VERB

    def _open_relative(self, word: Word) -> None:
        self._skip(word)
        antecedent, outer = self._last, self._clause
        self._outer.append(outer)
        self._close()
        self._clause.subjects = [antecedent] if antecedent is not None else []
        self._clause.hosts = [one for one in outer.subjects if one is not antecedent]
        self._clause.hosts_by = _find_by(outer, self._clause.subjects)
        self._anchor = None
        self._clause.is_relative, self._clause.opener = True, word
        self._is_joined = ""

    def _read_auxiliary(self, word: Word) -> None:
        if self._clause.verb is not None:
            outer = self._pop_outer()
            if outer is not None:
                self._close()
                self._clause.subjects = list(outer.subjects)
            else:
                self._continue_with_same_subjects("same")
        self._clause.auxiliaries.append(word)
        word.is_used = True
        self._clause.negation = self._clause.negation or self._take_negation()
        self._is_joined = ""
        self._at += 1

    def _read_verb(self, word: Word) -> None:
        form = word.meaning.form
        is_participle = form in (VerbForm.ING, VerbForm.PAST)
        self._split_list()
        self._negation = None if self._clause.verb is not None else self._negation
        clause = self._clause
        if is_participle and clause.verb is None and self._is_small_clause():
            self._outer.append(clause)
            subject = self._last
            self._close()
            self._clause.subjects = [subject] if subject is not None else []
            self._clause.hosts, self._clause.hosts_by = list(clause.subjects), "with"
            self._leave_onlookers(clause)
            clause = self._clause
        if clause.verb is None:
            clause.is_participle = is_participle and not clause.auxiliaries
        elif is_participle and self._is_joined != "and":
            self._open_participle()
            self._clause.is_participle = True
        elif self._goes_on_being(form):
            self._continue_with_same_subjects("same")
            self._clause.auxiliaries = list(clause.auxiliaries)
        elif self._is_joined and not (is_participle and not clause.is_participle):
            is_finite_after_participle = clause.is_participle and not is_participle
            outer = self._find_finite() if is_finite_after_participle else None
            outer = outer or (self._find_main() if clause.opener is not None else None)
            subjects = list((outer or clause).subjects)
            self._close()
            self._clause.subjects = subjects
            self._clause.order = "after"
            self._clause.is_participle = is_participle
        else:
            self._resume_outer(is_participle)
        self._clause.verb = word
        self._clause.negation = self._clause.negation or self._take_negation()
        self._is_joined, self._phrase = "", None
        self._at += 1

    def _goes_on_being(self, form: VerbForm | None) -> bool:
        """As in "is sitting on a bench and reading": the auxiliary holds for both."""
        clause = self._clause
        is_same = clause.verb is not None and clause.verb.meaning.form is form
        return is_same and form is VerbForm.ING and self._is_joined == "and" and bool(
            clause.auxiliaries
        )  # fmt: skip

    def _find_main(self) -> Clause | None:
        """As in "curls up when a fox comes, and stays still": the clause before "when"."""
        at = self._at - 1
        while at > 0 and self._words[at].pos in (Pos.CONJUNCTION, Pos.ADVERB):
            at -= 1
        if self._words[at].text != "," or self._clause.is_relative:
            return None
        before = self._clauses[self._sentence :]
        return next((one for one in reversed(before) if one.verb and one.opener is None), None)

    def _is_small_clause(self) -> bool:
        """As in "A boat (is on a lake) with dolphins jumping": the dolphins jump."""
        clause = self._clause
        phrases = clause.phrases or [one for group in clause.subjects[-1:] for one in group.phrases]
        if not phrases:
            return False
        last = phrases[-1]
        while last.groups[-1].phrases:
            last = last.groups[-1].phrases[-1]
        is_with = last.preposition.text == "with" and last.groups[-1] is self._last
        return is_with and not (clause.auxiliaries and last is phrases[0])

    def _leave_onlookers(self, clause: Clause) -> None:
        """As in "a man on a bicycle with people watching": they do so, and are not on it."""
        last = self._last.head if self._last is not None else None
        if last is None or last.text not in PEOPLE:
            return
        groups = [one for group in clause.subjects for one in (group, *_inner(group))]
        owners: list[Clause | NounGroup] = [clause, *groups]
        for owner in owners:
            owner.phrases = [one for one in owner.phrases if one.groups[-1] is not self._last]

    def _split_list(self) -> None:
        """As in "A chair, the light flickers": only the last is the subject."""
        clause = self._clause
        if clause.verb is None and len(clause.subjects) > 1 and not clause.is_listed:
            last = clause.subjects.pop()
            phrases, clause.phrases = clause.phrases, []
            auxiliaries, clause.auxiliaries = clause.auxiliaries, []
            self._close()
            self._clause.subjects, self._clause.phrases = [last], phrases
            self._clause.auxiliaries = auxiliaries

    def _open_participle(self) -> None:
        """As in ", leaving a wake" or "a dog chasing a cat"."""
        before = self._words[self._at - 1]
        has_noun_before = before.pos in (Pos.NOUN, Pos.PRONOUN) and self._last is not None
        if not self._is_joined and has_noun_before and self._last is not None:
            self._outer.append(self._clause)
            subjects, host = [self._last], self._clause
        else:
            subjects, host = list(self._clause.subjects), Clause()
        self._close()
        self._clause.subjects, self._clause.hosts = subjects, host.subjects
        self._clause.hosts_by = _find_by(host, subjects)

    def _resume_outer(self, is_participle: bool) -> None:
        """A verb without "and" after a complete clause."""
        clause = self._clause
        outer = self._pop_outer() if not is_participle else None
        if outer is None and clause.is_participle and not is_participle and clause.subjects:
            outer = clause
        if outer is not None:
            subjects = list(outer.subjects)
        elif self._last is not None and self._last not in clause.subjects:
            subjects = [self._last]
        else:
            subjects = list(clause.subjects)
        self._close()
        self._clause.subjects, self._clause.is_participle = subjects, is_participle


_HAVING = ("hold", "wear")


def _find_by(host: Clause, subjects: Sequence[NounGroup]) -> str:
    """How those groups are in a clause: see `Clause.hosts_by`."""
    value = host.verb.meaning.value if host.verb is not None else None
    if isinstance(value, Verb) and value.act in _HAVING and subjects == host.objects[-1:]:
        return "with"
    own = [phrase for group in host.subjects for phrase in group.phrases]
    by = [
        phrase.preposition.text
        for phrase in (*own, *host.phrases)
        if any(one in subjects for last in phrase.groups[-1:] for one in (last, *_inner(last)))
    ]
    return by[-1] if by else ""


def _inner(group: NounGroup) -> list[NounGroup]:
    """Groups of the phrases of a group, and of theirs."""
    own = [one for phrase in group.phrases for one in phrase.groups]
    return [*own, *(inner for one in own for inner in _inner(one))]
