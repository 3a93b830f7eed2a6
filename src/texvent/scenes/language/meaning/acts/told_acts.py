"""What people do, told otherwise than by a verb and its object: put right before it is read.

As in "is archery", "is pottery making", "giving or receiving an award", "does a trick on a
skateboard", "makes a bed", "rides on the back of an elephant", "leans against a wall".
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from texvent.scenes.description import ObjectMotion
from texvent.scenes.language.grammar.syntax import Clause, NounGroup, PrepPhrase
from texvent.scenes.language.meaning.acts.activities import find_activity, name_activity
from texvent.scenes.language.meaning.acts.partners import add_partner
from texvent.scenes.language.meaning.acts.sequence import add_motion
from texvent.scenes.language.meaning.capabilities import is_living, is_person
from texvent.scenes.language.meaning.draft import Draft
from texvent.scenes.language.vocabulary.acts import BOARDS
from texvent.scenes.language.words.english import Pos, VerbForm
from texvent.scenes.language.words.lexicon import Meaning, Role
from texvent.scenes.language.words.word import Word, mark_used
from texvent.scenes.models.objects.receptacles import CUPS


def tell_acts(draft: Draft, clause: Clause, things: Sequence[int]) -> None:
    """Put right what a clause about people says that they do."""
    if not things or not all(is_person(draft.noun(index)) for index in things):
        return
    if clause.verb is None:
        if not _do_named(draft, clause, things):
            _do_trick(draft, clause, things)
        return
    _take_complement(clause)
    _take_alternative(clause)
    _take_alone(clause)
    _take_making(clause)
    _taste_drinks(clause)
    _take_back(clause)
    _take_mount(draft, clause)
    _walk_with(draft, clause)
    _take_leash(clause)
    _take_mirror(clause)
    _take_station(clause)
    _drop_vessel(clause)
    _swing_at_tennis(draft, clause, things)
    if not _do_trick(draft, clause, things):
        _lean_on(draft, clause, things)


def _does(
    draft: Draft, clause: Clause, things: Sequence[int], kind: str, words: Sequence[Word]
) -> None:
    """They do it, and these words say so; the clause has no verb of its own any more."""
    for index in things:
        add_motion(draft, index, ObjectMotion(kind), clause)
    mark_used(words)
    draft.link_motion(list(words), list(things))
    if clause.verb is not None:
        mark_used([clause.verb])
        draft.link_motion([clause.verb], list(things))
        clause.verb = None


def _do_named(draft: Draft, clause: Clause, things: Sequence[int]) -> bool:
    """As in "a person is archery", "is push up": a noun names what is done."""
    groups = clause.complements
    words = [word for group in groups for word in group.words if word.pos is not Pos.DETERMINER]
    found = name_activity(words) if words and clause.auxiliaries else None
    if found is None or found[0] != "person":
        return False
    clause.complements = []
    _does(draft, clause, things, found[1], words)
    add_partner(draft, found[1], things)
    for word in words:
        word.shown_as = found[1] if found[2] else None
    mark_used(clause.auxiliaries)
    return True


def _take_complement(clause: Clause) -> None:
    """As in "is pottery making": what stands before the gerund is its object."""
    verb = clause.verb_word
    if not clause.complements or clause.objects or verb.meaning.form is not VerbForm.ING:
        return
    groups = clause.complements
    clause.objects, clause.complements = groups, []
    if find_activity(clause, is_hand=False) is None:
        clause.objects, clause.complements = [], groups


def _take_alternative(clause: Clause) -> None:
    """As in "giving or receiving an award": one of the two is done."""
    group = clause.objects[0] if clause.objects else None
    other = group.words[0] if group is not None else None
    is_verb = other is not None and other.pos is Pos.VERB
    if group is None or other is None or not is_verb or other is group.head:
        return
    if other.meaning.form is not clause.verb_word.meaning.form:
        return
    group.modifiers = [word for word in group.modifiers if word is not other]
    first = clause.verb_word
    clause.verb = other
    if find_activity(clause, is_hand=False) is None:
        clause.verb = first
    else:
        other = first
    other.meaning = Meaning(Role.FUNCTION, Pos.AUXILIARY)


_OF_ONESELF = {"bandage": "bandage arm"}
"""Hand work that is done to the own body where nothing is named."""


def _take_alone(clause: Clause) -> None:
    """As in "is bandaging": the own arm."""
    verb = clause.verb_word
    if verb.lemma in _OF_ONESELF and not clause.objects and not clause.is_passive:
        verb.lemma, verb.has_other_sense = _OF_ONESELF[verb.lemma], True


_MADE = {
    "snowman": "mould", "snow man": "mould", "sandcastle": "mould", "sand castle": "mould",
    "dough": "knead", "bread": "knead", "cake": "frost", "cupcake": "frost",
    "pizza": "dab", "sandwich": "dab", "hamburger": "dab", "sushi": "dab", "salad": "stir",
    "soup": "stir", "tea": "pour", "coffee": "pour", "necklace": "tie", "jewelry": "tie",
    "cabinet": "hammer", "table": "hammer", "chair": "hammer", "shed": "hammer",
    "house": "hammer", "fence": "hammer", "boat": "hammer",
}  # fmt: skip
"""What is made → hand work that is seen at it."""
_MAKING = frozenset({"make", "build", "prepare", "assemble"})


def _take_making(clause: Clause) -> None:
    """As in "makes a sandwich", "builds a snowman": hands at it, which is there already."""
    heads = [group.head for group in clause.objects[:1]]
    verb = clause.verb_word
    if verb.lemma not in _MAKING or not heads or heads[0] is None or clause.is_passive:
        return
    work = _MADE.get(heads[0].lemma)
    if work is not None and find_activity(clause, is_hand=False) is None:
        verb.lemma, verb.has_other_sense = work, True
        verb.shown_as = work


def _taste_drinks(clause: Clause) -> None:
    """As in "tastes beer": what is liquid is drunk."""
    heads = [group.head for group in clause.objects[:1] if group.head is not None]
    noun = heads[0].read_as(Role.NOUN) if heads else None
    if clause.verb_word.lemma in ("taste", "try", "sample") and noun and noun.value in CUPS:
        clause.verb_word.lemma, clause.verb_word.has_other_sense = "drink", True
        clause.verb_word.shown_as = "drink"


_LEASHES = frozenset({"leash", "lead", "lease", "dog leash", "rope"})


def _take_leash(clause: Clause) -> None:
    """As in "walks a dog on a leash": who walks a dog has it on one."""
    if clause.verb_word.lemma != "walk" or not clause.objects:
        return
    holders: list[list[PrepPhrase]] = [clause.phrases, *(one.phrases for one in clause.objects)]
    for phrases in holders:
        for phrase in list(phrases):
            heads = [group.head.lemma for group in phrase.groups if group.head is not None]
            if phrase.preposition.text in ("on", "with", "by") and heads and heads[0] in _LEASHES:
                mark_used(word for group in phrase.groups for word in group.words)
                mark_used([phrase.preposition])
                phrases.remove(phrase)


def _walk_with(draft: Draft, clause: Clause) -> None:
    """As in "walks with his dog": it is led along."""
    if clause.verb_word.lemma != "walk" or clause.objects:
        return
    for phrase in list(clause.phrases):
        heads = [group.head for group in phrase.groups if group.head is not None]
        noun = heads[0].read_as(Role.NOUN) if heads else None
        known = draft.nouns.get(noun.value) if noun is not None else None
        is_animal = known is not None and is_living(known) and not is_person(known)
        if phrase.preposition.text in ("with", "alongside") and is_animal:
            mark_used([phrase.preposition])
            clause.objects = phrase.groups
            clause.phrases.remove(phrase)
            return


def _take_mirror(clause: Clause) -> None:
    """As in "takes a picture in the mirror": before it, not in it."""
    for phrase in clause.phrases:
        heads = [group.head.lemma for group in phrase.groups if group.head is not None]
        if phrase.preposition.text in ("in", "into", "at") and heads == ["mirror"]:
            preposition = phrase.preposition
            preposition.meaning = replace(preposition.meaning, role=Role.RELATION, value="front")


_SINKS = frozenset({"sink", "kitchen sink", "bathroom sink", "basin", "washbasin", "tap", "faucet"})
_STOVES = frozenset({"stove", "oven", "stovetop", "cooker", "pan", "frying pan", "pot", "skillet",
                     "wok"})  # fmt: skip
_GRILLS = frozenset({"grill", "barbecue", "bbq", "campfire", "fire"})
_GRILLED = frozenset({"sausage", "burger", "hamburger", "meat", "steak", "hot dog", "food"})


def _take_station(clause: Clause) -> None:
    """As in "washes dishes in a sink", "cooks eggs on a stove": who does so is at one."""
    found = find_activity(clause, is_hand=False)
    kind = found[0] if found is not None else ""
    stations = _SINKS if kind in ("wash dishes", "wash hands") else frozenset()
    stations = _STOVES | _GRILLS if kind.startswith("cook") else stations
    for phrase in list(clause.phrases):
        heads = {group.head.lemma for group in phrase.groups if group.head is not None}
        if phrase.preposition.text not in ("in", "at", "over", "under", "on") or not heads:
            continue
        if not heads <= stations:
            continue
        mark_used(word for group in phrase.groups for word in group.words)
        mark_used([phrase.preposition])
        clause.phrases.remove(phrase)
        if heads <= _GRILLS:
            clause.verb_word.lemma, clause.verb_word.has_other_sense = "barbecue", True
            for group in [one for one in clause.objects if one.head_word.lemma in _GRILLED]:
                mark_used(group.words)
                clause.objects.remove(group)


_VESSELS = frozenset({"glass", "cup", "mug", "bottle", "can", "wine glass", "goblet"})


def _drop_vessel(clause: Clause) -> None:
    """As in "drinks wine from a glass": the wine is in that glass, and there is no other one."""
    if clause.verb_word.lemma not in ("drink", "sip") or not clause.objects:
        return
    for phrase in list(clause.phrases):
        heads = [group.head.lemma for group in phrase.groups if group.head is not None]
        if phrase.preposition.text in ("from", "out of", "in") and heads and heads[0] in _VESSELS:
            mark_used(word for group in phrase.groups for word in group.words)
            mark_used([phrase.preposition])
            clause.phrases.remove(phrase)


def _swing_at_tennis(draft: Draft, clause: Clause, things: Sequence[int]) -> None:
    """As in "a tennis player swings at the ball": with a racket, not with a bat."""
    players = {draft.noun(index).name for index in things}
    is_swing = clause.verb_word.lemma in ("swing", "hit") and not clause.objects
    if players == {"tennis player"} and is_swing:
        clause.verb_word.lemma, clause.verb_word.has_other_sense = "swing racket", True


_ON_BACK = frozenset({"ride", "sit", "stand"})


def _take_back(clause: Clause) -> None:
    """As in "rides on the back of an elephant": on the elephant."""
    if clause.verb_word.lemma not in _ON_BACK:
        return
    for phrase in list(clause.phrases):
        inner = [_whole(group) for group in phrase.groups]
        if phrase.preposition.text in ("on", "atop") and all(inner):
            mark_used(word for group in phrase.groups for word in group.words)
            phrase.groups = [group for group in inner if group is not None]
            if clause.verb_word.lemma == "ride" and not clause.objects:
                mark_used([phrase.preposition])
                clause.objects = phrase.groups
                clause.phrases.remove(phrase)


def _take_mount(draft: Draft, clause: Clause) -> None:
    """As in "rides on a motorcycle", "rides on horseback": what is ridden is the object."""
    if clause.verb_word.lemma != "ride" or clause.objects or clause.is_passive:
        return
    for phrase in list(clause.phrases):
        heads = [group.head for group in phrase.groups if group.head is not None]
        if phrase.preposition.text not in ("on", "atop", "on top of", "upon") or not heads:
            continue
        if heads[0].text == "horseback":
            heads[0].mean(Meaning(Role.NOUN, Pos.NOUN, "horse"))
        noun = heads[0].read_as(Role.NOUN)
        known = draft.nouns.get(noun.value) if noun is not None else None
        if known is None or not (known.motion in _GOING or known.name in BOARDS):
            continue
        mark_used([phrase.preposition])
        clause.objects = phrase.groups
        clause.phrases.remove(phrase)
        return


_GOING = frozenset({"drive", "sail", "walk", "run"})
"""Usual motions of what is ridden."""


def _whole(group: NounGroup) -> NounGroup | None:
    """The elephant of "the back of an elephant"."""
    if group.head is None or group.head.text not in ("back", "backs") or len(group.phrases) != 1:
        return None
    of = group.phrases[0]
    if of.preposition.text != "of" or len(of.groups) != 1:
        return None
    mark_used([of.preposition])
    return of.groups[0]


_TRICKS = frozenset({"trick", "stunt", "jump", "flip", "ollie", "kickflip", "grind"})
_OF_TRICKS = frozenset({"do", "perform", "try", "attempt", "land", "execute", "practice",
                        "practise", "pull", "pull off", "make", "show"})  # fmt: skip
_LEAPS = frozenset({"jump", "leap", "hop", "ollie"})
_AIR = frozenset({"in the air", "through the air", "into the air", "in mid air", "in midair",
                  "mid air", "midair", "up in the air", "in air"})  # fmt: skip
_BOARDS = {"skateboard": "skateboard trick", "longboard": "skateboard trick",
           "snowboard": "snowboard trick", "ski": "ski trick", "skis": "ski trick",
           "skateboarder": "skateboard trick", "snowboarder": "snowboard trick",
           "skier": "ski trick"}  # fmt: skip
_USING = frozenset({"on", "with", "off", "using"})


def _do_trick(draft: Draft, clause: Clause, things: Sequence[int]) -> bool:
    """As in "does a trick on a skateboard", "jumps his snowboard", "in the air on skis"."""
    verb = clause.verb
    heads = {group.head.lemma: group for group in clause.objects if group.head is not None}
    aloft = [word for word in clause.adverbs if word.text in _AIR]
    named = [heads[name] for name in heads.keys() & _TRICKS]
    is_trick = verb is not None and bool(named) and verb.lemma in _OF_TRICKS
    is_trick = is_trick or bool(aloft) or (verb is not None and verb.lemma in _LEAPS)
    if not is_trick or clause.negation is not None or clause.is_passive:
        return False
    kind, group = _find_board(draft, clause, things)
    if kind is None:
        return False
    words = [*aloft, *(word for one in named for word in one.words)]
    if group is not None:
        words += group.words
        clause.phrases.extend(group.phrases)
        for phrases in (clause.phrases, *(one.phrases for one in clause.subjects)):
            for phrase in list(phrases):
                if any(one is group for one in phrase.groups):
                    words.append(phrase.preposition)
                    phrases.remove(phrase)
    clause.adverbs = [word for word in clause.adverbs if word.text not in _AIR]
    clause.objects = [one for one in clause.objects if one is not group and one not in named]
    _does(draft, clause, things, kind, words)
    return True


def _find_board(
    draft: Draft, clause: Clause, things: Sequence[int]
) -> tuple[str | None, NounGroup | None]:
    """The trick of the board that is named, and its words; the rider's own has none."""
    groups = list(clause.objects)
    phrases = [*clause.phrases, *(one for group in clause.subjects for one in group.phrases)]
    for phrase in phrases:
        groups += phrase.groups if phrase.preposition.text in _USING else []
    for group in groups:
        noun = group.head.read_as(Role.NOUN) if group.head is not None else None
        if noun is not None and noun.value in _BOARDS:
            return _BOARDS[noun.value], group
    own = {_BOARDS.get(draft.noun(index).name) for index in things}
    return (own.pop(), None) if len(own) == 1 else (None, None)


_UPRIGHT = frozenset({"wall", "fence", "tree", "door", "car", "truck", "van", "bus", "pole",
                      "column", "railing", "motorcycle", "bookshelf", "refrigerator", "counter",
                      "brick wall", "stone wall", "garage door"})  # fmt: skip
"""What one leans one's back against."""


def _lean_on(draft: Draft, clause: Clause, things: Sequence[int]) -> None:
    """As in "leans against a wall": the back at it, right before it."""
    verb = clause.verb_word
    if verb.lemma not in ("lean", "slouch") or clause.objects:
        return
    for phrase in clause.phrases:
        heads = [group.head for group in phrase.groups]
        nouns = [head.read_as(Role.NOUN) for head in heads if head is not None]
        is_upright = bool(nouns) and all(one is not None and one.value in _UPRIGHT for one in nouns)
        if phrase.preposition.text in ("against", "on") and is_upright:
            for index in things:
                add_motion(draft, index, ObjectMotion("lean"), clause)
            mark_used([verb])
            draft.link_motion([verb], list(things))
            clause.verb = None
            preposition = phrase.preposition
            preposition.meaning = replace(preposition.meaning, role=Role.RELATION, value="front")
            return
