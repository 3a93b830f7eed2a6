"""Parts of things: the leg of a chair is shown with the chair."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace

from texvent.scenes.language.grammar.syntax import Clause, NounGroup
from texvent.scenes.language.meaning.capabilities import is_living, is_person
from texvent.scenes.language.meaning.referents.heads import find_head
from texvent.scenes.language.vocabulary.scene import FLICKERS
from texvent.scenes.language.vocabulary.verbs import Verb
from texvent.scenes.language.words.english import Pos
from texvent.scenes.language.words.lexicon import Meaning, Role
from texvent.scenes.language.words.word import Word, mark_used
from texvent.scenes.models.lamps import LAMPS
from texvent.scenes.models.protocol import Noun
from texvent.scenes.models.wrapped.opening import OPENING


def _words(text: str) -> frozenset[str]:
    return frozenset(text.split())


_OF_PEOPLE = _words("hair beard skin ponytail braid moustache")
"""Parts that are shown with people; of arms and legs there are activities."""
_LIMBS = _words("hand finger fist arm foot leg head")
"""Parts with which people do what they do: "a woman's hands knead dough"."""
_OF_ANIMALS = _words(
    "fur feather head leg tail paw hoof fin mane beak ear eye nose claw jaw blade rotor tongue"
    " whisker horn antler snout trunk"
)
"""Parts of animals, and of what flies like one."""
_OF_THINGS = _words(
    """handle lid rim edge side corner surface tip blade spoke rotor propeller string pedal cap head
    leg spout nozzle piston wing tail fin tire tyre wheel window roof windshield windscreen mirror
    hood bonnet bumper mast sail hull cabin fuselage screen display button knob dial switch cable
    wire cord gripper joint stem base bottom drawer flap shaft barrel lens antenna seat backrest
    armrest tread"""
)
_OWN_PARTS: Mapping[str, frozenset[str]] = {
    "hand": _words("clock watch wristwatch"),
    "door": _words("car van bus truck taxi train tram refrigerator fridge oven microwave washer"
                   " dryer dishwasher wardrobe cupboard safe machine elevator"),
    "needle": _words("machine compass gauge speedometer"),
    "turbine": _words("engine"),
    "drum": _words("machine washer dryer"),
    "hook": _words("crane"),
    "beam": _words("lighthouse"),
    "bucket": _words("excavator loader digger"),
    "arm": _words("excavator crane digger"),
    "key": _words("piano keyboard laptop"),
    "chain": _words("bicycle bike motorcycle"),
    **dict.fromkeys(("headlight", "taillight"), _words(
        "car van bus truck lorry taxi train tram motorcycle motorbike suv jeep tractor vehicle")),
    "wing": _words("bird butterfly bee eagle owl gull seagull airplane plane aircraft jet drone bat"
                   " insect dragonfly moth pigeon hummingbird swan goose"),
}  # fmt: skip
"""Part that is a thing by itself, or food → last words of the things of which it is a part."""
_DISCS = _words("disc disk")
_DOTTED = "dotted disc"
_MARKS = _words("dot spot mark")
"""What things have on them, which is not drawn."""
_ALONE = _words("wheel propeller barrel mirror lens gripper")
"""Parts that are shown alone, unless the whole does what is said of them."""
_TURNING = _words("spin rotate turn revolve whirl move run")
_SCREENS = _words("screen display light lamp bulb")
"""Parts that glow."""
_OPENING = _words("open close shut")
_OF_FRONTS, _COMING = _words("headlight taillight"), _words("approach come pass drive move go")
"""Parts that come with the whole, and what they do then."""


def take_wholes(clause: Clause, nouns: Mapping[str, Noun], before: Clause | None) -> None:
    """As in "bumps into a chair leg": into a chair; the clause changes.

    The whole does what its part does if that is how it works: it opens by its door, and a fan turns
    by its blades. Else the verb is lost: a helicopter does not spin with its rotor.

    Args:
        clause: any clause.
        nouns: the objects that can be shown, by name.
        before: the clause before it.
    """
    verb = clause.verb.lemma if clause.verb is not None else ""
    _drop_marks(clause)
    for group in _list_others(clause):
        whole = _find_whole(group, nouns)
        if whole is not None and _name(group.head_word) not in _ALONE:
            _show_whole(group, whole)
    for at, group in _list_doers(clause):
        owner = _find_owner(group, nouns) or _find_host(clause, group, before, nouns)
        whole = _find_whole(group, nouns) if owner is None else _find_noun(owner.head, nouns)
        if whole is None:
            _leave_owner(group)
            continue
        part = group.head_word
        is_by_part = _works_by_part(_name(part), verb, whole)
        if _name(part) in _ALONE and not is_by_part:
            continue
        if owner is None:
            _show_whole(group, whole)
        else:
            part.shown_as, clause.subjects[at] = whole.name, owner
        if _is_rotor(_name(part), whole) and verb in _TURNING:
            _let_stand(clause)
        elif not is_by_part:
            _lose_verb(clause)


def _list_doers(clause: Clause) -> Iterator[tuple[int, NounGroup]]:
    """Subjects, their heads found; but no limbs that are not shown so: "her arms crossed"."""
    for at, group in enumerate(clause.subjects):
        head = find_head(group) if group.head is not None else None
        if head is None or not clause.is_passive or _name(head) not in _LIMBS:
            yield at, group


def _leave_owner(group: NounGroup) -> None:
    """As in "a car's wheel spins": a wheel does, and no car is there."""
    if group.head is None or _name(group.head) not in _ALONE:
        return
    group.owner = None
    group.phrases = [one for one in group.phrases if one.preposition.text != "of"]


def _is_rotor(part: str, whole: Noun) -> bool:
    """Rotors of what flies turn at rest, too."""
    return part in ("rotor", "blade", "propeller") and whole.name in ("helicopter", "drone")


def _let_stand(clause: Clause) -> None:
    if clause.verb is not None:
        form = clause.verb.meaning.form
        clause.verb.meaning = Meaning(Role.VERB, Pos.VERB, Verb("stand", "stand"), form)


def _drop_marks(clause: Clause) -> None:
    """As in "a cup with a white dot": no disc beside it; a disc with a dot is one that is drawn."""
    for group in (None, *clause.subjects, *clause.objects):
        phrases = clause.phrases if group is None else group.phrases
        for phrase in list(phrases):
            heads = [_name(one.head) for one in phrase.groups if one.head is not None]
            if phrase.preposition.text != "with" or not _MARKS.issuperset(heads):
                continue
            phrases.remove(phrase)
            marked = group or (clause.subjects[0] if len(clause.subjects) == 1 else None)
            if marked is not None and marked.head is not None and _name(marked.head) in _DISCS:
                disc = replace(marked.head.meaning, role=Role.NOUN, value=_DOTTED)
                marked.head.mean(disc)
                mark_used(
                    [phrase.preposition, *(word for one in phrase.groups for word in one.words)]
                )


def _list_others(clause: Clause) -> Iterator[NounGroup]:
    yield from clause.objects
    for phrase in clause.phrases:
        yield from phrase.groups


def _find_whole(group: NounGroup, nouns: Mapping[str, Noun]) -> Noun | None:
    """The thing of which the head of a group is a part, as the noun before it says."""
    before = group.modifiers[-1] if group.modifiers else None
    noun = _find_noun(before, nouns)
    if group.head is None or before is None or noun is None:
        return None
    return noun if _is_part(_name(group.head), _name(before), noun) else None


def _is_part(part: str, whole: str, noun: Noun) -> bool:
    owners = _OWN_PARTS.get(part)
    if owners is not None and not (is_person(noun) and part in _LIMBS):
        return whole in owners
    if is_person(noun):
        return part in _OF_PEOPLE or part in _LIMBS
    return part in (_OF_ANIMALS if is_living(noun) else _OF_THINGS)


def _find_owner(group: NounGroup, nouns: Mapping[str, Noun]) -> NounGroup | None:
    """As in "a cat's tail", "the tail of a cat": the cat, for a part that is no thing by itself."""
    inner = [one for one in group.phrases if one.preposition.text == "of" and len(one.groups) == 1]
    owner = group.owner or (inner[0].groups[0] if inner else None)
    noun = _find_noun(owner.head, nouns) if owner is not None else None
    if owner is None or owner.head is None or group.head is None or noun is None:
        return None
    part = _name(group.head)
    is_thing = group.head.read_as(Role.NOUN) is not None and not is_living(noun)
    is_alone = part not in _OWN_PARTS and is_thing
    return owner if not is_alone and _is_part(part, _name(owner.head), noun) else None


def _find_host(
    clause: Clause, group: NounGroup, before: Clause | None, nouns: Mapping[str, Noun]
) -> NounGroup | None:
    """As in "a fan with four blades spinning": the fan, where it does that by its blades."""
    if group.head is None or clause.verb is None or before is None:
        return None
    part = _name(group.head)
    for host in before.subjects:
        noun = _find_noun(host.head, nouns)
        if noun is not None and noun.name == _DOTTED and part in _MARKS:
            return host
        has_it = any(one.preposition.text == "with" and group in one.groups for one in host.phrases)
        if noun is None or host.head is None or not has_it:
            continue
        if _is_part(part, _name(host.head), noun) and _works_by_part(part, clause.verb.lemma, noun):
            return host
    return None


def _find_noun(word: Word | None, nouns: Mapping[str, Noun]) -> Noun | None:
    meaning = word.read_as(Role.NOUN) if word is not None else None
    return nouns.get(str(meaning.value)) if meaning is not None else None


def _lose_verb(clause: Clause) -> None:
    """The clause only names things then."""
    if clause.verb is not None:
        clause.verb.is_lost, clause.verb = True, None
        clause.subjects, clause.objects = [*clause.subjects, *clause.objects], []


def _show_whole(group: NounGroup, whole: Noun) -> None:
    group.head_word.shown_as = whole.name
    group.head = group.modifiers.pop()


def _works_by_part(part: str, verb: str, whole: Noun) -> bool:
    """Whether the whole does what its part does."""
    if verb in _OPENING:
        return whole.name in OPENING and part in ("door", "lid", "drawer", "flap")
    if part in _OF_FRONTS:
        return verb in _COMING
    if is_person(whole) and part in _LIMBS:
        return True
    if verb in FLICKERS:
        return whole.name in LAMPS and part in _SCREENS
    return whole.is_working and verb in _TURNING


def _name(word: Word) -> str:
    return word.lemma.split()[-1]
