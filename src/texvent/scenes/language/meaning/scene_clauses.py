"""Clauses about light, weather, places and effects: "rain falls", "the road bends"."""

from __future__ import annotations

from collections.abc import Sequence, Set

from texvent.scenes.language.grammar.syntax import Clause
from texvent.scenes.language.meaning.circumstances.reader import CircumstanceReader
from texvent.scenes.language.meaning.clause_rewrites import BURSTS, POPS
from texvent.scenes.language.meaning.referents.referent import Referent
from texvent.scenes.language.meaning.referents.resolver import Referents
from texvent.scenes.language.meaning.scope import Scope
from texvent.scenes.language.meaning.surroundings_reader import SurroundingsReader
from texvent.scenes.language.vocabulary.acts import EFFECT_BY_VERB
from texvent.scenes.language.vocabulary.motion import FLOWING, WINDS
from texvent.scenes.language.vocabulary.verbs import Verb
from texvent.scenes.language.words.lexicon import Role
from texvent.scenes.language.words.word import Word, mark_used

_SUN = {"set": "dusk", "rise": "dawn"}
_OF_WATER = ("drip", "pour", "spray", "splash", "fountain")
_SWITCHES = ("switch", "turn", "go", "flick", "click", "toggle")
_FLOWS = frozenset({"run", "flow", "gush", "trickle", "stream", "come", "shoot"})
_COVERS = frozenset({"cover", "blanket", "fill", "shroud", "envelop", "hide", "surround"})
_SPILLS = frozenset({"pour", "drip", "leak", "spill", "splash"})
_OUT_OF = ("from", "out of")
_IN_THE_WIND = frozenset({"leaves", "petals", "confetti", "feathers", "smoke", "sand", "dust"})
_BENDS = ("curve", "wind", "bend", "twist")
_SNOWS = ("fall", "blow", "swirl", "drift", "whirl")
_FALLING = frozenset(
    {"fall", "blow", "drift", "hang", "fly", "float", "pour", "come", "move", "drop", "descend",
     "swirl", "shower", "stream"}
)  # fmt: skip
_PLAIN_VERBS: dict[str, frozenset[str]] = {
    "weather": _FALLING | {"roll"},
    "snow": _FALLING,
    "clouds": frozenset({"drift", "float", "hang", "move"}),
    "dust": _FALLING | {"rise", "kick", "kick up", "fly up", "billow"},
    "effect": _FALLING | {"rise", "spray", "fly up", "billow", "glow"},
    "light": frozenset({"shine", "rise", "set", "come"}),
}
"""Kind of what a clause is about → verbs that say nothing new of it: "rain falls"."""


_FLASHING = frozenset({"lightning", "beacon", "lasers", "stage lights", "blinking lights",
                       "fireworks", "hazard lights", "turn signal"})  # fmt: skip
"""Effects that flash by themselves."""
_OF_EFFECTS = _PLAIN_VERBS["effect"] | _FLOWS | BURSTS | POPS | _SPILLS


def _turn_into(clause: Clause, subjects: Sequence[Referent], sources: list[int]) -> list[int]:
    """As in "water pours into a glass": from above, not out of it; drops come from nothing."""
    found = {phrase.preposition.text for phrase in clause.phrases}
    if not found & {"into", "onto", "over", "in", "on"} or found & {"from", "out of"}:
        return sources
    for one in subjects:
        one.value = "pour into" if one.value == "pour" else one.value
    return [] if any(one.value == "drip" for one in subjects) else sources


_FROM_THE_SKY = frozenset({"day", "sunny", "overcast", "dawn", "dusk", "moonlight"})
"""Lights that do not flicker: where sunlight does, leaves move before it."""


def _is_steady(word: Word, one: Referent) -> bool:
    """Whether the verb says that it flickers or is switched, and it cannot: "day turns to dusk"."""
    if word.role is not Role.FLICKER and word.lemma not in _SWITCHES:
        return False
    head = one.group.head
    # Of several lights that blink, each does so by itself: not the light of the scene.
    are_lamps = one.kind == "glow" and head is not None and head.text == "lights"
    is_of_sky = one.kind == "light" and one.value in _FROM_THE_SKY
    return is_of_sky or (are_lamps and word.lemma != "flicker")


_AIMED_AT = frozenset({"lasers", "lightning"})
"""Effects that are shown all around, not on what they are said to hit."""


class SceneClauses:
    """Reads clauses whose subject is no object."""

    def __init__(
        self, referents: Referents, surroundings: SurroundingsReader, around: CircumstanceReader
    ) -> None:
        self._referents = referents
        self._surroundings = surroundings
        self._around = around

    def read(self, clause: Clause, subjects: Sequence[Referent]) -> None:
        """Rain falls, the light flickers, the road curves, the room is dark."""
        word = clause.verb
        if word is not None and self._read_water(clause, word, subjects):
            return
        if word is not None and word.role is Role.FLICKER:
            subjects = [one for one in subjects if not self._around.flash_own(one, word)]
            word.is_used = word.is_used or not subjects
        for one in subjects:
            self._surroundings.read_referent(one, is_negated=clause.negation is not None)
            self._around.read_group_phrases(one, Scope([], [], has_verb=False))
        if word is not None:
            able = [one for one in subjects if not _is_steady(word, one)]
            shown = self._read_scene_verb(word, {one.kind for one in able})
            shown |= word.lemma in _FLOWS and all(one.value in FLOWING for one in able)
            shown |= self._covers_place(clause, word, able)
            word.is_used = word.is_used or shown
        for group in clause.complements:
            self._read_scene_complement(self._referents.resolve(group))
        if word is not None and word.is_used:
            for adverb in clause.adverbs:
                adverb.is_used = adverb.is_used or adverb.role is Role.DIRECTION
        scope = Scope([], [])
        self._around.read_adverbs(clause.adverbs, scope)
        self._around.read_phrases(clause.phrases, scope)
        for group in clause.objects:
            self._around.read_extra(self._referents.resolve(group))

    def _read_water(self, clause: Clause, word: Word, subjects: Sequence[Referent]) -> bool:
        """As in "water drips from a tap": an effect, not a place."""
        kind = EFFECT_BY_VERB.get(word.lemma)
        if word.lemma in _FLOWS and any(one.preposition.text in _OUT_OF for one in clause.phrases):
            kind = "pour"
        heads = [one.group.head for one in subjects if one.group.head is not None]
        if kind not in _OF_WATER or any(head.text != "water" for head in heads):
            return False
        mark_used([word, *heads])
        effects = [Referent("effect", one.group, value=kind) for one in subjects]
        self.read_effects(clause, effects)
        return True

    def _covers_place(self, clause: Clause, word: Word, subjects: Sequence[Referent]) -> bool:
        """As in "fog covers a harbour": the place is in it; "snow covers a car" is not shown."""
        objects = [self._referents.resolve(group) for group in clause.objects]
        is_place = bool(objects) and all(one.kind == "place" for one in objects)
        is_it = all(one.kind in ("weather", "snow") for one in subjects)
        return word.lemma in _COVERS and is_place and is_it and bool(subjects)

    def _read_scene_verb(self, word: Word, kinds: Set[str]) -> bool:
        """What light, weather or a place does; whether it is shown."""
        if word.role is Role.FLICKER and kinds & {"light", "glow"}:
            self._surroundings.flicker()
            return True
        if word.lemma in _SWITCHES and kinds & {"light", "glow"}:
            self._surroundings.flicker("switch")
            return True
        if word.lemma in _BENDS and "place" in kinds:
            return self._surroundings.curve_road()
        if word.lemma in _SUN and "light" in kinds:
            return self._surroundings.read_light(_SUN[word.lemma], is_sure=True)
        if word.lemma in _SNOWS and "snow" in kinds:
            return self._surroundings.read_weather("snow")
        return any(word.lemma in _PLAIN_VERBS.get(kind, ()) for kind in kinds)

    def _read_scene_complement(self, one: Referent) -> None:
        """As in "the room is dark"."""
        self._surroundings.read_adjectives(one.attributes, "place")
        for said in one.attributes.words:
            if said.text == "dark":
                self._surroundings.darken()
                said.is_used = True

    def read_effects(self, clause: Clause, subjects: Sequence[Referent]) -> None:
        """Smoke rises from a chimney."""
        sources: list[int] = []
        for phrase in (*clause.phrases, *(p for one in subjects for p in one.group.phrases)):
            for group in phrase.groups:
                found = self._referents.resolve(group, phrase.preposition.text)
                if found.is_things:
                    sources.extend(found.things)
                    is_aimed = {str(one.value) for one in subjects} <= _AIMED_AT
                    phrase.preposition.is_used = not is_aimed
                    phrase.preposition.is_lost = is_aimed
                    self._around.place_among(phrase.preposition, found.things)
                else:
                    sources.extend(self._around.parts.find_whose(found))
                    self._around.read_phrase(phrase, Scope([], []))
                self._around.read_group_phrases(found, Scope(found.things, []))
        sources = _turn_into(clause, subjects, sources)
        added = [self._around.add_effect(one, Scope(sources[:1], [])) for one in subjects]
        kinds = {str(one.value) for one in subjects}
        for phrase in clause.phrases if kinds & _IN_THE_WIND else ():
            for group in phrase.groups:
                if group.head is not None and group.head.text in WINDS:
                    mark_used([phrase.preposition, group.head])
        word = clause.verb
        flashes = word is not None and word.role is Role.FLICKER and bool(kinds & _FLASHING)
        is_theirs = word is not None and (word.lemma in _OF_EFFECTS or flashes
                                          or isinstance(word.meaning.value, Verb))  # fmt: skip
        if word is not None and any(added) and is_theirs:
            word.is_used = True
            for adverb in clause.adverbs:
                adverb.is_used = adverb.is_used or adverb.text in ("up", "out", "down")
        self._around.read_adverbs(clause.adverbs, Scope(sources, []))
        for group in clause.objects:
            self._around.read_extra(self._referents.resolve(group))
