"""Scenes of clauses: which objects there are, what they do and where."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

from texvent_scenes.description import SEEN
from texvent_scenes.models.activities import PERSON_NOUNS
from texvent_scenes.models.effects import LAMPS
from texvent_scenes.models.protocol import Noun
from texvent_scenes.models.tables import nouns_with, trait_value
from texvent_scenes.read.abilities import is_of_people
from texvent_scenes.read.account import Reading, finish
from texvent_scenes.read.again import leave_places
from texvent_scenes.read.camera import (
    claim_way,
    find_move,
    go_through,
    is_ego,
    is_shot,
    is_standpoint,
    look_out,
    look_over,
    sit_in,
)
from texvent_scenes.read.clauses import Clause, read_clauses
from texvent_scenes.read.draft import SceneDraft, is_grammar, names_place
from texvent_scenes.read.groups import Group, Phrase
from texvent_scenes.read.lexicon import lexicon_of, word_set
from texvent_scenes.read.parts import are_own_parts, say_parts
from texvent_scenes.read.prepositions import (
    claim_mutual,
    claim_relation,
    dress,
    find_mutual,
    find_relation,
    go_to_place,
    hand_over,
    is_rained_on,
    keep_distance,
    lose_drift,
    lose_ways,
    names_formation,
    relate_one,
)
from texvent_scenes.read.senses import choose_senses
from texvent_scenes.read.things import ThingReader
from texvent_scenes.read.tokens import NO_TOKEN, Token, split_prompt
from texvent_scenes.spec.data import PLACING, SPACED, WAYS


def read(prompt: str, nouns: Mapping[str, Noun]) -> Reading:
    """The scene that any text describes, of these nouns; what it leaves open stays open."""
    tokens = choose_senses(split_prompt(prompt, lexicon_of(nouns)), nouns)
    draft = SceneDraft(tokens, nouns)
    reader = _SentenceReader(draft, nouns)
    for clause in read_clauses(tokens):
        reader.apply(clause)
    return finish(draft, prompt)


class _SentenceReader(ThingReader):
    """Applies clauses to a draft."""

    def __init__(self, draft: SceneDraft, nouns: Mapping[str, Noun]) -> None:
        super().__init__(draft, nouns)
        self._subjects: list[int] = []
        """Objects that the last clause was about."""
        self._earlier: list[int] = []
        """Objects that the clause before that one was about: "behind her"."""
        self._before = self._nearest
        """Those before the rest of the clause: "passes a bench and sits on it"."""
        self._where: list[int] = []
        """Objects of the last group before the clause: "under a bridge as a train crosses it"."""
        self._acts = False
        """Whether the clause has a verb: "is repairing it with a wrench"."""
        self._acted: list[int] = []
        """Objects of the last verb that had some: "picks up an apple from a bowl, puts it down"."""
        self._was_camera = False
        self._verb: Token | None = None
        """The last verb: "then right", "then a truck" say no other."""

    def apply(self, clause: Clause) -> None:
        """Add what a clause says."""
        is_told = any(isinstance(one, Phrase) or not one.has("scene") for one in clause.after)
        is_bare = clause.about == "then" and clause.verb is None and not self._was_camera
        if is_bare and (is_told or clause.subjects):
            clause = replace(clause, verb=self._verb)
        self._verb = clause.verb or self._verb
        self._is_then = clause.about == "then"
        self._goes_on = clause.about in ("meanwhile", "company") or bool(clause.subjects)
        self._draft.phase += clause.about == "then" and bool(self._draft.moves)
        is_later = bool(self._draft.things or self._draft.effects or self._draft.moves)
        self._draft.phases += clause.about == "then" and is_later
        for head in (group.head for group in clause.absent):
            if head is not None and head.has("noun") and not self._is_built_in(head, clause):
                self._draft.absent.append(head.all("noun")[0].value.noun)
                self._draft.show(head, *clause.negation)
        goes_on = self._was_camera and clause.about in ("same", "meanwhile", "then")
        heads = [one.head for one in clause.subjects if one.head is not None]
        is_aboard = any(self._draft.fates.get(one.at) == "camera" for one in heads)
        is_named = goes_on or is_aboard or clause.about == "camera"
        seated = (
            None if is_named else (sit_in(self._draft, clause) or look_out(self._draft, clause))
        )
        clause = seated or clause
        if seated is not None and not self._draft.things:
            self._nearest, self._subjects, self._before = [], [], []
        is_own = seated is not None or (not is_named and is_ego(self._draft, clause))
        is_camera = is_named or (is_shot(clause) and not is_own)
        self._was_camera = is_camera
        if self._says_of_parts(clause):
            pass
        elif is_camera or is_own:
            self._apply_to_camera(clause, is_own=is_own)
        else:
            self._apply_to_things(clause)

    def _is_built_in(self, head: Token, clause: Clause) -> bool:
        """Whether a body has what it is said to be without: "a car without wheels"."""
        before = self._draft.tokens[: clause.negation[-1].at] if clause.negation else ()
        words = [one for one in before if one.text != "with"][-1:]
        inner = word_set("things", "built_in")
        return any(one.has("noun") and not one.has("place") for one in words) and any(
            one.value.noun in inner for one in head.all("noun")
        )

    def _says_of_parts(self, clause: Clause) -> bool:
        """Whether a clause is about parts that a thing has: "its second hand moving"."""
        owners = word_set("things", "owners")
        if not clause.subjects or any(one.article not in owners for one in clause.subjects):
            return False
        first, *others = clause.subjects
        verb = () if clause.verb is None else (clause.verb,)
        said = (replace(first, unknown=(*first.unknown, *verb)), *others)
        known, nearest = range(len(self._draft.things)), self._nearest
        if not say_parts(self._draft, said, known):
            return False
        phrases = [one for one in clause.after if isinstance(one, Phrase) or one.has("scene")]
        self._say_after(phrases, nearest, nearest, nearest)  # where the whole is
        return True

    def _apply_to_things(self, clause: Clause) -> None:
        known, where = len(self._draft.things), self._nearest
        self._where = where
        told = subjects = self._find_subjects(clause)
        self._before = self._nearest
        first = clause.verb.at if clause.verb is not None else 0
        before = [one for one in clause.after
                  if isinstance(one, Phrase) and one.preposition.at < first]  # fmt: skip
        for phrase in before:
            if are_own_parts(self._draft, phrase, subjects):
                continue
            told = self._relate(phrase, subjects, subjects) or subjects
        told = subjects = subjects or self._add_doer(clause)
        objects = [index for group in clause.objects for index in self._name(group)]
        objects = objects or (self._find_object(clause, subjects, where) if clause.is_back else [])
        self._acted = objects or self._acted
        subjects, objects, after = self._turn_passive(clause, subjects, objects)
        if clause.about != "company":
            self._earlier = self._subjects if clause.subjects else self._earlier
            self._subjects = list(subjects)
        moved = subjects
        self._acts = clause.verb is not None
        if clause.verb is not None:
            subjects, moved = self._do_verb(clause, clause.verb, subjects, objects)
            told = moved or objects
        self._say_after(tuple(one for one in after if one not in before), subjects, moved, told)
        if clause.is_of_effect and not subjects:
            lose_drift(self._draft, after)
        is_known = bool(told) or not clause.subjects
        is_known |= any(one.head and self._draft.shows(one.head) for one in clause.subjects)
        if not is_known or (clause.verb is not None and not self._draft.shows(clause.verb)):
            lose_ways(self._draft, clause.after, has_subject=is_known)
        for index in subjects if clause.about == "where" and where else ():
            relate_one(self._draft, self._draft.place_by(where[0]), index, where)
        phases = self._draft.phases
        if clause.about == "then" or (phases and self._is_joined(clause)):  # others wait until then
            for motions in (self._draft.things[n]["motions"] for n in subjects if n >= known):
                motions[:0] = [{"kind": "stand"} for _ in range(phases if motions else 0)]

    def _add_doer(self, clause: Clause) -> list[int]:
        """A person for what only people do, where no subject is said: "slicing a tomato"."""
        draft, verb = self._draft, clause.verb
        if clause.about or clause.subjects or verb is None or draft.things:
            return []
        nouns = [group.noun.noun for group in clause.objects if group.noun is not None]
        acts = [one.value for one in verb.verbs("ing")]
        if not all(map(is_grammar, draft.tokens[: verb.at])):
            return []  # "rain falling"
        if not nouns and any(one.who != "person" for one in acts):
            return []  # "falling": what?
        things = [{"noun": noun, "motions": [], "count": 1, "relations": []}
                  for noun in ("person", *nouns)]  # fmt: skip
        draft.things += things
        acts = [one for one in acts if is_of_people(one) and len(nouns) == len(clause.objects)]
        is_so = any(draft.fits(one, [0], range(1, len(things)), bool(nouns)) for one in acts)
        del draft.things[is_so:]
        return [0][:is_so]

    def _do_verb(
        self, clause: Clause, verb: Token, subjects: list[int], objects: list[int]
    ) -> tuple[list[int], list[int]]:
        """Apply the verb of a clause; the subjects that do it, and who is moved."""
        heads = [one.head for one in clause.objects]
        is_known = not (clause.is_back and not objects)
        is_known &= all(one and not one.is_liquid and self._draft.shows(one) for one in heads)
        mutual = find_mutual(clause.objects, clause.after)
        is_known |= bool(mutual)
        ways = {one.value.relation for one in verb.all("verb")} & {*WAYS}
        is_open = bool(ways) and " " in verb.text and not (clause.objects or clause.is_back)
        is_known &= not is_open  # "passengers get on"
        is_within = bool(clause.objects) and not objects and bool(ways & {"into", "out of"})
        is_known &= not is_within  # "enters a room", where it is already
        is_lost = clause.is_back and not objects  # "throws a wug and catches it"
        found = None if is_lost else self._act(verb, subjects, objects, has_object=not is_known)
        kind = next((one.value.relation for one in verb.all("verb") if one.value.relation), None)
        if mutual and kind is not None and found:  # "pass each other"
            claim_mutual(self._draft, [verb, *mutual], kind, subjects)
        kinds = {one.value.kind for one in verb.all("verb")}
        is_own = bool(kinds & word_set("effects", "motions")) or kind == "out of"
        if not subjects and clause.is_of_effect and is_own:
            self._draft.show(verb)  # "smoke rises from a chimney", as it does by itself
            if kind == "out of" and objects:  # "drops leave a nozzle"
                self._draft.effects[-1]["source"] = objects[0]
            return [], []
        if found is not None:
            self._draft.claim(verb, SEEN, "", subjects, objects)
        for index in subjects if found is None else ():  # what it does is not made up
            self._draft.things[index]["is_lost"] = True
        return ([], []) if found is None else (subjects, found or subjects)

    def _say_after(
        self, after: Sequence[Phrase | Token], subjects: list[int], moved: list[int],
        told: list[int],
    ) -> None:  # fmt: skip
        """Apply what follows the verb: of "a cup on a plate on a table", the plate is on it."""
        last = NO_TOKEN
        for one in after:
            if isinstance(one, Phrase) and (
                self._hangs_on_unknown(one)
                or is_standpoint(self._draft, one)
                or are_own_parts(self._draft, one, subjects)
            ):
                continue
            if isinstance(one, Phrase):
                who = self._choose_placed(one, last, subjects, told)
                told = self._relate(one, who, moved) or moved
                last = one.preposition
                keep_distance(self._draft, last, who)
                self._push_with(subjects, who)
            elif not self._draft.set_scene(one, told):
                adverb = one.first("adverb")
                if one.has("relation") and not one.has("small", "adverb"):  # "close to" the camera
                    self._draft.mark(one, "lost")
                self._say(one, told if adverb and adverb.value[0] == "placement" else moved)

    def _push_with(self, subjects: Sequence[int], riders: Sequence[int]) -> None:
        """Have who is pushed in or on something pushed with it; no swing is pushed."""
        draft = self._draft
        for index in subjects:
            for row in [one for one in draft.things[index]["relations"] if one["kind"] == "push"]:
                below = [one["to"] for n in riders for one in draft.things[n]["relations"]
                         if one["kind"] in ("in", "on") and n in row["to"]]  # fmt: skip
                for to in below[:1]:
                    is_swing = draft.things[to[0]]["noun"] in nouns_with("swings")
                    row |= {"kind": "behind" if is_swing else "push", "to": to}
                    if is_swing and self._verb is not None:
                        draft.mark(self._verb, "lost")
                        draft.claims.pop(self._verb.at, None)

    def _hangs_on_unknown(self, phrase: Phrase) -> bool:
        """Whether it is part of what is not known: "a tray with glasses"."""
        before = self._draft.tokens[phrase.preposition.at - 1]
        is_noun = before.is_unknown and not before.text.endswith("ly") and before is not self._verb
        return phrase.preposition.text == "with" and is_noun

    def _choose_placed(
        self, phrase: Phrase, last: Token, subjects: list[int], told: list[int]
    ) -> list[int]:
        """Objects of a phrase: of "a cup on a plate on a table" the plate, "next to" one both."""
        draft = self._draft
        kind, before = (str(one and one.value) for one in
                        (phrase.preposition.first("relation"), last.first("relation")))  # fmt: skip
        if kind == "with" and draft.tokens[phrase.preposition.at - 1].has("noun"):
            others = {draft.things[index]["noun"] for index in {*self._nearest} - {*subjects}}
            if others and others <= PERSON_NOUNS | word_set("things", "vessels"):
                return self._nearest  # "passes a man with a suitcase", "carries a tray with cups"
        if before == "with" and told and kind in PLACING and draft.tokens[last.at - 1].has("place"):
            return told  # "in a room with candles on the table"
        if kind == "on" and {draft.things[n]["noun"] for n in told} <= word_set("things", "flames"):
            return told or subjects  # "blows out the candles on a cake"
        kinds = {one["kind"] for index in subjects for one in draft.things[index]["relations"]}
        if kind in (kinds if subjects else PLACING):
            return told
        if all(one.head and names_place(one.head, kind) for one in phrase.groups):
            return subjects
        led = [n for index in subjects for one in draft.things[index]["relations"]
               if one["kind"] in ("push", "pull") for n in one["to"]]  # fmt: skip
        if kind in ("on", "in") and {draft.things[n]["noun"] for n in led} & PERSON_NOUNS:
            return led  # "pushes a man in a wheelchair", which it is pushed with
        if kind in ("on", "in") and before in SPACED:
            like = (one for one in subjects if draft.walks(one) == draft.walks(told[0]))
            return [*dict.fromkeys((*like, *told))]
        is_passed = before in word_set("things", "passed") | {"into"}
        return told if kind in PLACING and is_passed else subjects

    def _find_object(self, clause: Clause, subjects: list[int], nearest: list[int]) -> list[int]:
        """Objects that a pronoun after a verb means: "overtakes them", "runs after it"."""
        word = self._draft.tokens[clause.verb.at + 1].text if clause.verb else ""
        about = self._earlier if self._subjects == subjects else self._subjects
        if word == "them":
            both = about if self._draft.is_many(about) else [*about, *nearest]
            return [one for one in dict.fromkeys(both) if one not in subjects]
        persons = {n for n, one in enumerate(self._draft.things) if one["noun"] in PERSON_NOUNS}
        others = [one for one in dict.fromkeys((*self._acted, *nearest, *about))
                  if one not in subjects
                  and (one in persons) == (word in ("him", "her"))]  # fmt: skip
        return sorted(others, key=self._draft.can_go, reverse=True)[:1]  # no tree is followed

    def _turn_passive(
        self, clause: Clause, subjects: list[int], objects: list[int]
    ) -> tuple[list[int], list[int], Sequence[Phrase | Token]]:
        """The actor, the object and the rest of a passive clause: "a ball kicked by a man"."""
        after = tuple(one for one in clause.after if isinstance(one, Phrase) or not is_grammar(one))
        first = clause.verb.at if clause.verb is not None else 0
        later = [
            one for one in after if (one.preposition if isinstance(one, Phrase) else one).at > first
        ]
        by = later[0] if later else None  # "is kicked by"
        is_passive = clause.verb is not None and clause.verb.verbs("ed") and not objects
        if not is_passive or not isinstance(by, Phrase) or by.preposition.text != "by":
            return subjects, objects, after
        agents = [index for group in by.groups for index in self._name(group)]
        self._draft.mark(by.preposition, "shown" if agents else "lost")
        rest = tuple(one for one in after if one is not by)
        return (agents, subjects, rest) if agents else (subjects, [], rest)

    def _find_subjects(self, clause: Clause) -> list[int]:
        """Objects that a clause is about; in company, those that go by themselves."""
        heads = [one.head for one in clause.subjects]
        if clause.about == "company":
            if clause.is_of_effect or not all(one and self._draft.shows(one) for one in heads):
                return []
            if listed := self._find_listed(clause.subjects):
                return listed
            if clause.verb is not None and clause.verb.text in word_set("things", "hung"):
                return self._nearest  # "a drone with a box hanging below it"
            both = self._nearest, self._subjects
            able = [[one for one in each if self._is_able(clause, one)] for each in both]
            going = [one for one in self._nearest if self._draft.can_go(one)]
            return next(filter(None, (*able, going)), self._subjects)
        if clause.subjects:
            known = len(self._draft.things)
            named = [self._pick(group, known) or self._name(group) for group in clause.subjects]
            lost = [
                not one
                for one, group in zip(named, clause.subjects, strict=True)
                if group.is_plural
            ]
            self._is_lost = any(lost) or (self._is_lost and not any(named))
            picked = [one for one, group in zip(named, clause.subjects, strict=True) if group.picks]
            leave_places(self._draft, [index for one in picked for index in one], clause.after[:1])
            return [index for one in (picked if any(picked) else named) for index in one]
        first = clause.after[0] if clause.after and clause.verb is None else None
        is_open = isinstance(first, Token) and (first.is_unknown or first.has("verb"))
        if is_open and not clause.about:
            return []  # "as wugs dax against it"
        return self._nearest if clause.about == "nearest" else self._find_meant(clause)

    def _is_joined(self, clause: Clause) -> bool:
        """Whether "and" joins a clause with a subject to the one before: "and a dog runs"."""
        head = clause.subjects[0].head if clause.subjects else None
        before = self._draft.tokens[: head.at] if head is not None else ()
        ends = (one for one in reversed(before) if one.is_sign or one.text == "and")
        return next(ends, NO_TOKEN).text == "and"

    def _find_listed(self, groups: Sequence[Group]) -> list[int]:
        """Objects of a list that all do what follows: "with cars and dogs running"."""
        if len(groups) < 2 or not all(one.is_plural and not one.article for one in groups):
            return []
        nouns = [one.noun.noun for one in groups if one.noun is not None]
        last = range(len(self._draft.things))[-len(groups) :]
        if [self._draft.things[index]["noun"] for index in last] != nouns:
            return []
        return [n for n in last if self._nouns[self._draft.things[n]["noun"]].habitat != "fixed"]

    def _find_meant(self, clause: Clause) -> list[int]:
        """Objects of the last clause that a pronoun before a verb means: "drops it, it breaks"."""
        verb = clause.verb
        word = self._draft.tokens[verb.at - 1].text if verb is not None and verb.at else ""
        if word not in ("it", "he", "she"):
            return self._subjects
        fits = [one for one in (*self._subjects, *self._acted, *self._nearest)
                if (self._draft.things[one]["noun"] in PERSON_NOUNS) == (word != "it")]  # fmt: skip
        return self._subjects if {*self._subjects} <= {*fits} else fits[:1]

    def _is_able(self, clause: Clause, index: int) -> bool:
        """Whether an object can do what not all can."""
        verbs = clause.verb.all("verb") if clause.verb is not None else ()
        acts = [one.value for one in verbs if one.value.who not in ("plain", "source", "camera")]
        is_lamp, has_object = self._draft.things[index]["noun"] in LAMPS, bool(clause.objects)
        fitting = (one for one in acts if self._draft.fits(one, [index], [], has_object))
        return any(is_lamp or one.who != "lamp" for one in fitting)

    # Prepositions

    def _relate(self, phrase: Phrase, subjects: Sequence[int], moved: Sequence[int]) -> list[int]:
        """Apply a preposition with its groups, and give what they name.

        `moved` are those that the verb moves; "behind them" is said of the nearest group.
        """
        draft, token = self._draft, phrase.preposition
        kind = find_relation(draft, phrase, subjects)
        if not phrase.groups or find_mutual(phrase.groups):
            self._relate_back(kind, phrase, subjects)
            return []
        if dress(draft, phrase, subjects) or names_formation(draft, phrase, subjects):
            return []
        targets = list[int]()
        owners = subjects if kind in ("with", "in", "on") else ()  # "a car in flames"
        for group in phrase.groups:
            targets += self._name(group, kind or token.text, owners)
        heads = [group.head for group in phrase.groups if group.head is not None]
        words = [one for group in phrase.groups for one in (*group.unknown, *group.modifiers)]
        if not targets:
            is_place = all(names_place(one, kind or token.text) for one in heads)
            if is_place and "name" in draft.parts["place"]:
                go_to_place(draft, token, heads, subjects or self._nearest, moved)
            elif kind in WAYS or (not owners and any(one.head and one.head.has("effect")
                                                      for one in phrase.groups)):  # fmt: skip
                draft.mark(token, "lost")  # "over a flame"
        elif (
            (kind == "from" or (kind in ("through", "out of") and self._is_spout(targets)))
            and not subjects
            and draft.effects
            and draft.may_come_from(token)
        ):
            is_all_over = draft.effects[-1]["kind"] in word_set("things", "all_over")
            draft.effects[-1]["source"] = None if is_all_over else targets[0]
            draft.show(token)
        elif kind and (subjects or kind != "with"):  # "an office with a desk"
            self._relate_all(token, kind, subjects, targets)
        is_lone = not targets or (kind == "with" and bool(subjects or moved or not self._acts))
        if is_lone and any(map(draft.shows, (*heads, *words))):
            draft.show(token)
        return targets

    def _is_spout(self, targets: Sequence[int]) -> bool:
        """Whether something comes out of a thing below: a nozzle, a funnel."""
        return trait_value("spout", self._draft.things[targets[0]]["noun"]) is not None

    def _relate_all(
        self, token: Token, kind: str, subjects: Sequence[int], targets: Sequence[int]
    ) -> None:
        """Apply a preposition to all that it is said of."""
        draft = self._draft
        if handled := hand_over(draft, token, kind, subjects, targets):
            draft.mark(token, handled)
            return
        able = () if kind == "route" else subjects
        placed = [relate_one(draft, kind, index, targets) for index in able]
        is_so = any(placed) or is_rained_on(draft, token, kind)
        draft.mark(token, "shown" if is_so else "lost")
        claim_relation(draft, token, kind, subjects, targets)

    def _relate_back(self, kind: str, phrase: Phrase, subjects: Sequence[int]) -> None:
        """Apply a preposition with a pronoun: "a dog passes a tree, a man behind it"."""
        draft, nearest, token = self._draft, self._nearest, phrase.preposition
        if phrase.groups:
            claim_mutual(draft, [token, *find_mutual(phrase.groups)], kind, subjects)
            return
        if (before := draft.tokens[token.at - 1]).has("place") and kind == "behind":
            far = {one.value for one in before.all("place")} & word_set("things", "backdrops")
            draft.mark(token, "shown" if far and draft.shows(before) else "lost")
            return  # "with mountains behind it"
        own = {*subjects, *draft.list_held(subjects)}  # "a man in a coat walks behind it"
        is_many = draft.tokens[token.at + 1].text == "them" and draft.is_many(self._earlier)
        is_own = bool(set(nearest) & own) or (is_many and not draft.is_many(nearest))
        others: Sequence[int] = subjects
        about: Sequence[int] = self._earlier if is_own else nearest
        is_fixed = self._where and not any(map(draft.can_go, self._where))
        if is_own and is_fixed and kind in word_set("things", "bearing"):
            about = self._where
        if not is_own and nearest is not self._before:  # "passes a tree, a dog behind it"
            others, about = nearest, subjects
        others = others if about and kind not in ("", "route") else []
        is_so = any([relate_one(self._draft, kind, one, about) for one in others])
        is_so |= is_rained_on(draft, token, kind)
        draft.mark(token, "shown" if is_so else "lost")
        claim_relation(draft, token, kind, others, about)

    # The camera

    def _apply_to_camera(self, clause: Clause, *, is_own: bool) -> None:
        draft, targets = self._draft, list[int]()
        move = find_move(draft, clause, is_ego=is_own)
        for group in clause.subjects if clause.about != "company" else ():
            self._name(group, "in")
        for group in clause.objects if not is_own else ():
            targets += self._name(group)
        self._lead_followed(move, targets)
        for one in clause.after:
            if not isinstance(one, Phrase):
                self._draft.set_scene(one)
            elif is_standpoint(draft, one, move or {}):
                continue
            elif targets:  # as "orbits a car in front of a house"
                self._relate(one, targets, targets)
            else:
                found, sense = self._relate(one, [], []), one.preposition.first("relation")
                kind = sense.value if sense else ""
                targets += found if kind in word_set("things", "aims") else []
                turns = move is not None and move["kind"] in ("pan", "tilt")
                is_swept = turns and one.preposition.text in word_set("things", "swept")
                targets += found if is_swept else []
                is_side = bool(found) and kind in word_set("things", "sides") and not is_swept
                if found and kind in ("through", "out of"):
                    is_side = move is None or not go_through(draft, move, one.preposition, found)
                is_over = look_over(draft, one.preposition, found)
                claim_way(draft, move, one.preposition, [] if is_over else found)
                heads = [group.head for group in one.groups if group.head is not None]
                words = heads or [each for group in one.groups for each in group.unknown]
                is_side |= bool(one.groups) and not any(map(draft.shows, words))
                is_side |= kind == "front" and any(each["kind"] == "travel" for each in draft.moves)
                is_side &= not is_over
                is_place = any(each.has("place") for each in heads)
                is_side |= is_place and not found and kind in ("out of", "into")  # it stays there
                goes = any(
                    each["kind"] == "travel" for each in (*draft.moves, move or {"kind": ""})
                )
                is_side |= goes and bool(found) and kind in ("up", "down")  # it keeps its height
                draft.mark(one.preposition, "lost" if is_side else "shown")  # nothing is put there
        if move is not None:
            self._draft.add_move(move)
            if targets:
                draft.parts["camera"].setdefault("target", targets[0])
            self._lead_followed(move, targets)

    def _lead_followed(self, move: Mapping[str, Any] | None, targets: Sequence[int]) -> None:
        """Let things go that a camera follows."""
        followed = targets if move is not None and move["kind"] == "follow" else []
        for index in filter(self._draft.can_go, followed):
            thing = self._draft.things[index]
            thing["motions"] = thing["motions"] or [{"kind": "move"}]
