"""What each clause means: whom it is about (camera, light, weather, objects), what it adds."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from texvent.scenes.description import SceneDescription
from texvent.scenes.language.grammar.syntax import Clause, NounGroup
from texvent.scenes.language.meaning.acts.activities import find_activity
from texvent.scenes.language.meaning.acts.devices import take_handled
from texvent.scenes.language.meaning.acts.doers import play_own, settle_doings, tell_by_doings
from texvent.scenes.language.meaning.acts.first_person import show_speaker
from texvent.scenes.language.meaning.acts.fitting import is_plain_past
from texvent.scenes.language.meaning.acts.hand_work import give_bodies
from texvent.scenes.language.meaning.acts.hosts import lift_places
from texvent.scenes.language.meaning.acts.named_acts import read_named_act
from texvent.scenes.language.meaning.acts.partners import take_fellows, take_receivers
from texvent.scenes.language.meaning.acts.reader import ActReader
from texvent.scenes.language.meaning.acts.told_acts import tell_acts
from texvent.scenes.language.meaning.camera_clauses import FILMED, CameraClauses
from texvent.scenes.language.meaning.camera_reader import CameraReader
from texvent.scenes.language.meaning.capabilities import is_hand, is_living, is_person
from texvent.scenes.language.meaning.circumstances.effects import (
    GIVES_OFF,
    comes_from_doer,
    is_done_to_effect,
)
from texvent.scenes.language.meaning.circumstances.reader import CircumstanceReader
from texvent.scenes.language.meaning.clause_rewrites import (
    is_likeness,
    list_brought,
    list_other_phrases,
    rewrite_objects,
    rewrite_phrases,
    turn_active,
    turn_effects,
    turn_views,
)
from texvent.scenes.language.meaning.draft import Draft, PartialObject
from texvent.scenes.language.meaning.negations import deny
from texvent.scenes.language.meaning.referents.crowds import hold_up_traffic
from texvent.scenes.language.meaning.referents.owners import lose_owners
from texvent.scenes.language.meaning.referents.referent import Referent
from texvent.scenes.language.meaning.referents.resolver import PERSON, Referents
from texvent.scenes.language.meaning.scene_clauses import SceneClauses
from texvent.scenes.language.meaning.scope import OF_SCENE, Scope
from texvent.scenes.language.meaning.surroundings_reader import SurroundingsReader
from texvent.scenes.language.meaning.wholes import take_wholes
from texvent.scenes.language.vocabulary.film import TRAVEL_MEANS
from texvent.scenes.language.vocabulary.scene import WEATHER_VERBS
from texvent.scenes.language.vocabulary.verbs import Verb
from texvent.scenes.language.words.english import VerbForm
from texvent.scenes.language.words.lexicon import Role
from texvent.scenes.language.words.word import Word, link, mark_used
from texvent.scenes.models.people.work.verbs import HANDWORK
from texvent.scenes.models.protocol import Noun

POSTER = "poster"
"""What shows a picture for which no surface is named."""


class ClauseMeaning:
    """Reads clauses in order and collects the scene."""

    def __init__(
        self, nouns: Mapping[str, Noun], *, is_carried: bool = False, means: str | None = None
    ) -> None:
        self._draft = Draft(nouns)
        self._referents = Referents(self._draft)
        self._before: Clause | None = None
        self._camera = CameraReader(self._draft, is_carried=is_carried, means=means)
        self._surroundings = SurroundingsReader()
        self._acts = ActReader(self._draft)
        self._around = CircumstanceReader(self._draft, self._referents, self._surroundings)
        self._sentence = -1
        """The sentence that said last what "it" means."""
        self._shots = CameraClauses(self._camera, self._referents, self._around)
        self._scenes = SceneClauses(self._referents, self._surroundings, self._around)

    @property
    def is_anything_shown(self) -> bool:
        """Whether the prompt says anything that the scene shows."""
        surroundings, light = self._surroundings.build()
        says_place = any(
            (surroundings.place, surroundings.weather, surroundings.sky, surroundings.backdrops,
             surroundings.has_dust, surroundings.has_snow, surroundings.clouds is not None,
             light.kind, light.flicker_hz)
        )  # fmt: skip
        return bool(
            self._draft.objects or self._draft.effects or says_place or self._camera.has_moves
            or self._draft.absent
        )  # fmt: skip

    def build(self, prompt: str, words: Sequence[Word]) -> SceneDescription:
        """The description, before defaults are filled in; `words`: those of the prompt."""
        draft = self._draft
        settle_doings(draft)
        hold_up_traffic(draft)
        lose_owners(draft, self._referents.named)
        self._surroundings.read_weather_of_things(words if draft.objects else ())
        surroundings, light = self._surroundings.build()
        if surroundings.place == "sky" and any(map(self._is_grounded, draft.objects)):
            surroundings = replace(surroundings, place=None)
        return SceneDescription(
            prompt=prompt,
            objects=tuple(item.build(draft.tempo) for item in draft.objects),
            relations=tuple(draft.relations),
            effects=tuple(draft.effects),
            shot=self._camera.build(),
            light=light,
            surroundings=surroundings,
            absent=tuple(draft.absent),
            notes=tuple(draft.notes),
        )

    def _is_grounded(self, item: PartialObject) -> bool:
        """Whether it stands on the ground, whatever else is "in the air"."""
        is_fixed = self._draft.nouns[item.noun].habitat == "fixed"
        return is_fixed and all(one.kind in ("stand", "work", "turn") for one in item.motions)

    def read(self, clause: Clause) -> None:
        """Add what a clause says."""
        lift_places(clause, self._draft.nouns)
        take_wholes(clause, self._draft.nouns, self._before)
        self._before = clause
        turn_views(clause)
        turn_effects(clause)
        turn_active(clause)
        self._camera.read_phrases(clause.adverbs)
        if clause.opener is not None:
            clause.opener.is_used = True
        if clause.verb is not None and clause.verb.text in WEATHER_VERBS:
            self._read_weather_verb(clause, clause.verb)
            return
        if not clause.objects and read_named_act(self._draft, self._around, clause):
            return
        show_speaker(clause, is_first_person=self._camera.is_first_person)
        for group in clause.subjects if is_likeness(clause) else ():
            self._referents.forget(group)
        self._referents.verb = clause.verb.lemma if clause.verb is not None else ""
        subjects = [self._referents.resolve(group) for group in clause.subjects]
        self._referents.verb = ""
        self._referents.note_subjects(subjects)
        if self._leaves_behind(clause, subjects):
            subjects = [Referent("things", _NOBODY, list(self._draft.subjects))]
        if self._shots.is_about(clause, subjects):
            self._read_camera(clause, subjects)
        elif subjects and all(one.kind in OF_SCENE for one in subjects):
            self._scenes.read(clause, subjects)
        elif subjects and all(one.kind == "effect" for one in subjects):
            self._scenes.read_effects(clause, subjects)
        elif not subjects and clause.verb is not None:
            self._read_subjectless(clause)
        else:
            self._read_objects(clause, subjects)

    def _leaves_behind(self, clause: Clause, subjects: Sequence[Referent]) -> bool:
        """As in "a truck drives on a road, leaving dust": the truck leaves it, not the road."""
        is_place = bool(subjects) and all(one.kind == "place" for one in subjects)
        is_it = clause.verb is not None and clause.verb.lemma in GIVES_OFF
        return is_place and is_it and clause.is_participle and bool(self._draft.subjects)

    def _read_subjectless(self, clause: Clause) -> None:
        """As in "Driving through a tunnel", "juggling three oranges"."""
        word = clause.verb_word
        if word.text in FILMED:
            self._read_camera(clause, [])
            return
        is_gerund = word.meaning.form is VerbForm.ING
        is_viewer = self._camera.is_first_person or not clause.objects
        if is_gerund and word.lemma in TRAVEL_MEANS and is_viewer:
            for group in clause.objects:
                mark_used(group.words)
            clause.objects = []
            self._read_camera(clause, [])
            self._draft.note("the camera itself moves, as no one else is said to")
            return
        does = find_activity(clause, is_hand=False) is not None or (
            isinstance(word.meaning.value, Verb) and bool(clause.objects)
        )
        if not does or word.role is Role.FUNCTION or word.meaning.form is VerbForm.PAST:
            self._read_objects(clause, [])
            return
        index = self._around.person()
        if index is None:
            index = self._draft.add(PartialObject(PERSON))
            self._draft.note(f"a person does it ({word.text}): no one is named")
        person = Referent("things", clause.objects[0] if clause.objects else _NOBODY, [])
        person.things = [] if index is None else [index]
        self._read_objects(clause, [person])

    def _read_weather_verb(self, clause: Clause, word: Word) -> None:
        """As in "It rains on a bus"."""
        self._surroundings.read_weather(WEATHER_VERBS[word.text])
        word.is_used = True
        for phrase in clause.phrases:
            for group in phrase.groups:
                one = self._referents.resolve(group, phrase.preposition.text)
                phrase.preposition.is_used = one.is_things
                self._around.read_extra(one)

    def _read_objects(self, clause: Clause, subjects: Sequence[Referent]) -> None:
        """A clause about objects, or about something that is not shown."""
        subjects = self._split_scene(subjects)
        things = [index for one in subjects if one.is_things for index in one.things]
        is_lost = bool(subjects) and not things
        give_bodies(self._draft, clause, subjects)
        tell_acts(self._draft, clause, things)
        rewrite_objects(clause)
        take_handled(self._draft, clause, things)
        self._referents.has_body = any(is_living(self._draft.noun(index)) for index in things)
        self._referents.doers = things
        rewrite_phrases(clause)
        take_fellows(clause)
        take_receivers(clause)
        deny(clause)
        by_hand = bool(things) and all(is_hand(self._draft.noun(index)) for index in things)
        has_own = self._referents.has_body or by_hand
        brought = list_brought(clause, is_hand=by_hand) if has_own else []
        groups = [one for one in clause.objects if not any(one is group for group in brought)]
        objects = [self._referents.resolve(group) for group in groups]
        if clause.verb is not None:
            self._referents.note_objects(objects)
        agents = self._find_agents(clause)
        self._read_subject_phrases(clause, subjects, things)
        movers: list[int] = []
        is_picture = self._show_pictures(clause, things, objects)
        before = len(self._draft.relations)
        is_at_effect = is_done_to_effect(self._draft, clause, things, objects)
        if clause.verb is not None and things and not (is_picture or is_at_effect):
            if clause.is_passive and not (clause.is_participle and is_plain_past(clause.verb)):
                movers = self._acts.undergo(clause, things, agents)
            else:
                movers = self._acts.read(clause, things, self._find_wholes(clause, objects))
            self._draft.link_motion([clause.verb], movers or things)
            clause.verb.relations = tuple(self._draft.relations[before:])
            tell_by_doings(self._draft, subjects)
        if clause.verb is None and not clause.complements:
            for word in clause.auxiliaries:
                word.is_lost = word.text.split()[0].rstrip("s") in _ASPECTS
                word.is_used = not word.is_lost
        has_verb = clause.verb is not None
        is_shown = clause.verb is not None and clause.verb.is_used
        is_shown = is_shown or play_own(self._draft, clause, subjects)
        has_object = bool(clause.objects) and not is_picture
        acted_on = tuple(i for one in objects if one.is_things for i in one.things)
        acted_on = () if self._acts.is_activity else acted_on
        verb = clause.verb_word.lemma if has_verb else ""
        scope = Scope(things, movers, is_lost, has_verb, is_shown, has_object, acted_on, verb)
        if has_verb and not is_shown:
            self._lose_verb([*things, *acted_on])
        for one in objects:
            self._read_object(one, clause, scope)
        self._read_complements(clause, scope)
        self._around.read_adverbs(clause.adverbs, scope)
        self._around.read_phrases(list_other_phrases(clause, brought), scope)
        self._referents.has_body, self._referents.doers = False, []
        is_aside = clause.is_participle or clause.is_relative
        if not (is_aside and self._sentence == clause.sentence):
            self._draft.subjects = list(things) or self._draft.subjects
            self._sentence = clause.sentence

    def _find_wholes(self, clause: Clause, objects: Sequence[Referent]) -> Sequence[Referent]:
        """As in "brushes the mane of a pony": hands are at it; not at the hair of a person."""
        if clause.verb is None or clause.verb.lemma not in HANDWORK:
            return objects
        if any(one.is_things for one in objects):
            return objects
        inner = [
            self._referents.resolve(group, phrase.preposition.text)
            for one in objects
            for phrase in one.group.phrases
            if phrase.preposition.text == "of"
            for group in phrase.groups
        ]
        owners = [one.group.owner for one in objects if one.group.owner is not None]
        inner += [self._referents.resolve(owner) for owner in owners]
        return [*objects, *(one for one in inner if one.is_things and not self._has_people(one))]

    def _has_people(self, one: Referent) -> bool:
        return any(is_person(self._draft.noun(index)) for index in one.things)

    def _read_subject_phrases(
        self, clause: Clause, subjects: Sequence[Referent], things: Sequence[int]
    ) -> None:
        for one in subjects:
            is_list = one is subjects[-1] and clause.verb is None and clause.is_listed
            own = things if is_list else one.things
            scope = Scope(one.things, [], not one.things, has_verb=False)
            self._around.read_group_phrases(one, scope, own)

    def _hang(self, one: Referent) -> Referent:
        """As in "the digit 7": shown on a poster."""
        index = self._draft.add(PartialObject(POSTER))
        if index is None or not self._around.show_on(one, [index]):
            return one
        self._draft.note(f"'{one.group.text}' is shown on a {POSTER}")
        return Referent("things", one.group, [index], attributes=one.attributes)

    def _show_pictures(
        self, clause: Clause, things: Sequence[int], objects: Sequence[Referent]
    ) -> bool:
        """As in "a screen plays clip.mp4"."""
        found = [self._around.show_on(one, things) for one in objects if one.kind == "picture"]
        if any(found) and clause.verb is not None:
            clause.verb.is_used = True
        return any(found)

    def _lose_verb(self, things: Sequence[int]) -> None:
        """What does something that is not shown stands still."""
        for index in things:
            self._draft.objects[index].is_verb_lost = True

    def _read_object(self, one: Referent, clause: Clause, scope: Scope) -> None:
        is_done = is_done_to_effect(self._draft, clause, scope.subjects, [one])
        if one.kind == "unit":
            self._around.quantities.read(one, scope)
        elif one.kind in OF_SCENE and not one.is_water:
            self._surroundings.read_referent(one, is_negated=False)
            if not is_done:
                self._cross(one, clause, scope)
        elif one.kind == "effect":
            is_own = comes_from_doer(self._draft, clause, scope.subjects)
            is_added = self._around.add_effect(one, scope if is_own else Scope([], []))
            if (
                is_added
                and not is_done
                and clause.verb is not None
                and clause.verb.lemma in GIVES_OFF
            ):
                clause.verb.is_used = True
        elif one.kind == "part" and scope.is_verb_shown:
            self._around.parts.read_own(one, scope.subjects)
        self._around.read_group_phrases(one, Scope(one.things, [], not one.things, has_verb=False))

    def _cross(self, one: Referent, clause: Clause, scope: Scope) -> None:
        """As in "Crosses the street": the place is where it goes."""
        del one
        if clause.verb is None or clause.verb.is_used or not scope.subjects:
            return
        scope.movers.extend(self._acts.read(clause, scope.subjects, []))

    def _read_camera(self, clause: Clause, subjects: Sequence[Referent]) -> None:
        others = [one for one in subjects if one.kind not in ("camera", "function")]
        cameras = [one for one in subjects if one not in others]
        objects, named = self._shots.read(clause, cameras)
        of_scene = [word for word in clause.adverbs if word.role in _OF_SURROUNDINGS]
        self._around.read_adverbs(of_scene, Scope([], [], has_verb=False))
        for one in (*objects, *self._split_scene(others)):
            self._around.read_extra(one)
        things = [index for one in named if one.is_things for index in one.things]
        self._draft.subjects = things[:1] or self._draft.subjects

    def _split_scene(self, subjects: Sequence[Referent]) -> list[Referent]:
        """Read the places and lights in a list of subjects; return the rest."""
        rest = []
        for one in subjects:
            if one.kind in OF_SCENE:
                self._around.read_extra(one)
            elif one.kind == "effect":
                self._around.add_effect(one, Scope([], []))
            elif one.kind == "picture":
                rest.append(self._hang(one))
            elif one.kind == "absent":  # As in "no cars on the road": the road is there.
                self._around.read_extra(one)
            else:
                rest.append(one)
        return rest

    def _find_agents(self, clause: Clause) -> list[int]:
        """As in "Held by a boy"."""
        agents: list[int] = []
        for phrase in list(clause.phrases):
            if phrase.preposition.text != "by" or not clause.is_passive:
                continue
            for group in phrase.groups:
                found = self._referents.resolve(group, "by")
                if any(self._draft.noun(index).motion != "stand" for index in found.things):
                    agents.extend(found.things)
                    phrase.preposition.is_used = True
                    self._around.read_group_phrases(found, Scope(found.things, []))
            if agents:
                clause.phrases.remove(phrase)
        return agents

    def _read_complements(self, clause: Clause, scope: Scope) -> None:
        """As in "The car is red"; "painted orange"."""
        for group in clause.complements:
            one = self._referents.resolve(group)
            link(group.modifiers, scope.subjects)
            for index in scope.subjects:
                one.attributes.apply(self._draft.objects[index], self._draft.noun(index))


_OF_SURROUNDINGS = (Role.LIGHT, Role.WEATHER, Role.CLOUDS, Role.PLACE)
_NOBODY = NounGroup()
_ASPECTS = ("start", "begin", "keep")
"""Auxiliaries that say something even where no verb follows: "a car starts"."""
