"""Account of a draft: its scene, and the lists of its words."""

from __future__ import annotations

import itertools
from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any

from texvent.prompt_report import Substitution
from texvent_scenes.colours import rgb_of
from texvent_scenes.description import Claim, Dependence
from texvent_scenes.models.activities import PERSON_NOUNS, SAT
from texvent_scenes.models.protocol import Noun
from texvent_scenes.models.tables import nouns_with, trait_value, trait_values
from texvent_scenes.read.draft.copies import OPPOSITE, halve, take_turns
from texvent_scenes.read.draft.scene_draft import SceneDraft
from texvent_scenes.read.draft.setting import leave_sky
from texvent_scenes.read.draft.sources import find_sources
from texvent_scenes.read.parsing.lexicon import deeds, word_set, word_table
from texvent_scenes.read.parsing.tokens import NO_TOKEN, Token
from texvent_scenes.spec.data import scene_from_data
from texvent_scenes.spec.scene import MAX_BODIES, Scene, number_nouns


@dataclass(frozen=True, kw_only=True)
class Reading:
    """The scene that a sentence describes, and what became of its words."""

    scene: Scene
    shown: tuple[str, ...]
    """Words that the scene shows."""
    substituted: tuple[Substitution, ...]
    """Words that are shown as something else."""
    not_understood: tuple[str, ...]
    """Words without effect on the scene."""
    claims: tuple[Claim, ...] = ()
    """Words, of both lists, of which only the staged scene tells whether it shows them."""
    dependences: tuple[Dependence, ...] = ()
    """Words that are uncertain where others are not understood."""


def _reach_speed(motion: dict[str, Any], noun: Noun) -> None:
    """Say by paces at which speed a motion ends: "accelerates from 10 km/h to 50 km/h"."""
    end_m_s, start_m_s = motion.pop("end_m_s"), motion.get("speed_m_s")
    pace, end_pace = motion.get("pace", 1.0), motion["end_pace"]
    if start_m_s is None and end_pace > pace:
        motion["speed_m_s"] = end_m_s * pace / end_pace
        return
    start_m_s = pace * (noun.speed_m_s or 1.0) if start_m_s is None else start_m_s
    start_m_s = max(start_m_s, 0.001 * end_m_s)  # paces are multiples of a speed, which is not 0
    most_m_s = max(start_m_s, end_m_s) or 1.0
    paces = (round(one / most_m_s, 6) for one in (start_m_s, end_m_s))
    motion |= {"speed_m_s": start_m_s, **dict(zip(("pace", "end_pace"), paces, strict=True))}


def finish(draft: SceneDraft, prompt: str) -> Reading:
    """The scene, and its words; one that is lost at one place of the prompt is not shown."""
    _choose_gender(draft)
    _lead_view(draft)
    _ride_on(draft)
    _do_deeds(draft)
    _find_opponents(draft)
    _hang_up(draft)
    _stand_level(draft)
    _tell_riders(draft)
    for token in (one for one in draft.tokens if one.text == "stars" and one.nouns):
        if draft.parts["light"].get("kind") == "night" and draft.shows(token):
            draft.mark(token, "star shapes")  # which are near and large
    find_sources(draft)
    leave_sky(draft)
    _turn_marks(draft)
    _skate_on_ice(draft)
    _bring_home(draft)
    _limit_counts(draft)
    _look_up(draft)
    _bring_weather(draft)
    fates: dict[str, str] = {}
    for token, after in zip(draft.tokens, (*draft.tokens[1:], NO_TOKEN), strict=False):
        is_open = token.is_sign or token.is_grammar
        is_open |= token.text == "to" and bool(after.verbs("base"))  # "starts to spin"
        is_begun = token.text in word_set("things", "aspects")
        is_open &= not is_begun or after.text == "to" or bool(after.verbs("ing"))
        if token.has("small") and after.has("adverb", "negations") and draft.shows(after):
            draft.show(token)  # "at 50 km/h", "with no cars"
        if token.has("style") and " " in token.text:
            draft.show(token)  # "in front of the camera"
        fate = draft.fates.get(token.at, "" if is_open else "lost")
        text = draft.compounds.get(token.at, token.text)
        if fate == "lost" or (fate and fates.get(text, "shown") == "shown"):
            fates[text] = fate
    others = [one for one in fates.items() if one[1] not in ("shown", "lost")]
    lost = tuple(word for word, fate in fates.items() if fate == "lost")
    return Reading(
        scene=_build(draft, prompt),
        shown=tuple(word for word, fate in fates.items() if fate == "shown"),
        substituted=tuple(Substitution(*one) for one in others),
        not_understood=lost,
        claims=tuple(_list_claims(draft)),
        dependences=tuple(_list_dependences(draft, lost)),
    )


def _look_up(draft: SceneDraft) -> None:
    """Show those whom one sees against the sky in the open sky, or from below."""
    if not draft.before_sky:
        return
    is_free = all(draft.noun(n).habitat == "air" for n in range(len(draft.things)))
    if is_free and "name" not in draft.parts["place"]:
        draft.parts["place"]["name"] = "sky"
    elif not draft.moves:
        draft.parts["camera"].setdefault("view", "low")


def _bring_weather(draft: SceneDraft) -> None:
    """Add the weather that a word brings: rain of a thunderstorm that is not dry."""
    for weather, storms in word_table("storms").items():
        for token in draft.tokens:
            is_dry = draft.beside(token, -1).text == "dry"
            if token.text in storms and draft.shows(token) and not is_dry:
                draft.parts["place"].setdefault("weather", weather)


_TIES = ("verb", "pose", "adverb", "relation", "shot", "other")
"""Kinds of words that say how things go together."""


def _list_dependences(draft: SceneDraft, lost: Collection[str]) -> Iterator[Dependence]:
    """Words that depend on how others are read.

    In a clause these are words that say how things go together, such as verbs. Things, lights and
    places, with their colours and numbers, depend on what leads to them: "beneath", "steep".
    A prompt of which most clauses have a lost word is one clause.
    """
    words = [(draft.compounds.get(one.at, one.text), one) for one in draft.tokens]
    clauses = [*_split_clauses(words, lost)]
    broken = [clause for clause in clauses if any(text in lost for text, _ in clause)]
    for clause in [words] if 2 * len(broken) > len(clauses) else clauses:
        others = (pair for pair in clause if not pair[1].has("noun", "place", "field"))
        ties = [text for text, one in others if one.says("scene", "camera") or one.has(*_TIES)]
        whole = tuple(text for text, one in clause if not one.has("field"))
        yield Dependence(tuple(ties), whole)  # a colour that is lost changes nothing else
        before, fields = "", list[str]()
        for text, one in clause:
            if one.has("noun", "place", "scene"):
                yield Dependence((*fields, text), (before,))
            is_lost = text in lost
            is_of_next = one.has("articles", "field", "partitive") or (is_lost and one.is_unknown)
            before = text if is_lost or not is_of_next else before
            fields = [*fields, text] if is_of_next else []


def _split_clauses(
    words: Sequence[tuple[str, Token]], lost: Collection[str]
) -> Iterator[list[tuple[str, Token]]]:
    """Clauses between signs and conjunctions; one that begins with a verb goes on with the last."""
    clause: list[tuple[str, Token]] = []
    for is_end, found in itertools.groupby(
        words, lambda one: one[1].is_sign or (one[1].has("conjunctions") and one[0] not in lost)
    ):
        group = [*found]
        goes_on = is_end or group[0][1].has("verb", "pose")
        if clause and (not goes_on or group[-1][0] in (".", "!", "?", ";")):
            yield clause
            clause = []
        clause += [] if is_end else group
    if clause:
        yield clause


_SEEN_SIZE = 3.0
"""Size of a small ball that is seen from where both players are, as a multiple of the usual one."""


def _find_opponents(draft: SceneDraft) -> None:
    """Give who plays a rally an opponent, a ball and what they play over."""
    table = word_table("rallies")
    for index, thing in enumerate(tuple(draft.things)):
        kind = next((one["kind"] for one in thing["motions"] if one["kind"] in table), "")
        if not kind or any(one["kind"] == "rally" for one in thing["relations"]):
            continue
        players, targets = [index], []
        if thing["count"] == 1:
            players.append(draft.add("person", motions=[{"kind": kind}]))
        ball, _ = table[kind]
        for noun in table[kind]:
            known = [n for n, one in enumerate(draft.things) if noun.endswith(one["noun"])]
            for one in known[:1]:
                draft.things[one] |= {"noun": noun, "motions": []}
            targets.append(known[0] if known else draft.add(noun))
            if noun == ball:  # else it is a speck between two people
                draft.things[targets[-1]].setdefault("size", _SEEN_SIZE)
        for one in players:
            draft.relate(one, "rally", targets)


def _list_claims(draft: SceneDraft) -> Iterator[Claim]:
    """Claims of words that are not lost at another place, where nothing is claimed of them."""
    lost = [one for one in draft.tokens if not draft.shows(one) and not one.is_grammar]
    claimed = {at for at, claims in draft.claims.items() if any(one.is_open for one in claims)}
    closed = {one.text for one in lost if one.at not in claimed}
    for at, claims in draft.claims.items():
        fate = draft.fates.get(at, "lost")
        claims = [one for one in claims if one.kind != "sit at" or not _has_seat(draft, one)]
        yield from (one for one in claims if one.word not in closed
                    and (fate == "shown" or (fate == "lost" and one.is_open)))  # fmt: skip


def _has_seat(draft: SceneDraft, claim: Claim) -> bool:
    """Whether the act of who sits somewhere comes with the seat, and with what it is done at."""
    return claim.subject is not None and bool(draft.does([claim.subject]) & SAT)


def _choose_gender(draft: SceneDraft) -> None:
    """Draw the only person as the one that a pronoun means: "a teacher chops her carrots"."""
    persons = [one for one in draft.things if one["noun"] in PERSON_NOUNS]
    words = {one.text for one in draft.tokens if [each["noun"] for each in persons] == ["person"]}
    for noun, pronouns in word_table("people").items():
        if words & {*pronouns} and persons[0]["noun"] == "person":
            persons[0]["noun"] = noun
            draft.fates.update({at: noun for at, one in draft.fates.items() if one == "person"})


_LARGE_M = 0.4
"""Length of an animal from which on no round rock bears it."""


def _stand_level(draft: SceneDraft) -> None:
    """Have large animals on flat rocks: on a round one, feet would hang in the air."""
    flat = word_table("stood_on")
    for index, one in enumerate(draft.things):
        noun = draft.noun(index)
        for target in draft.targets([index], ["on"]) if noun.motion == "walk" else ():
            thing = draft.things[target]
            if thing["noun"] in flat and one["noun"] not in PERSON_NOUNS:
                length_m = noun.build(colour=None, scale=1.0, seed=0).length
                thing["noun"] = flat[thing["noun"]] if length_m > _LARGE_M else thing["noun"]


def _tell_riders(draft: SceneDraft) -> None:
    """Report persons of whom a vehicle brings its own: no girl is drawn on a bicycle."""
    for index, one in enumerate(draft.things):
        ridden = draft.names(draft.targets([index], ["ride"]))
        if one["noun"] not in PERSON_NOUNS - word_set("things", "brought"):
            continue
        if any(trait_value("ridden", noun) == "built-in" for noun in ridden):
            for token in (each for each in draft.tokens if one["noun"] in each.nouns):
                draft.mark(token, "person")


def _hang_up(draft: SceneDraft) -> None:
    """Put on a wall of their own what hangs on one by its name: "a wall clock"."""
    hung, walls = nouns_with("hangs on a wall"), nouns_with("only a background")
    for token in draft.tokens:
        wall, _, rest = token.text.partition(" ")
        named = token.nouns & hung if rest else set()
        bare = [one for one in draft.find(named) if not draft.things[one]["relations"]]
        for index in bare[:1] if wall in walls else ():
            draft.relate(index, "on", [draft.add(wall)])


def _lead_view(draft: SceneDraft) -> None:
    """Have vehicles go before a camera that drives where their word says so: "the car ahead"."""
    ahead, near = word_set("things", "ahead"), word_set("things", "ahead_of_us")
    for one in draft.things:
        word = str(one.get("word", ""))
        if any(word.endswith(f" {each}") for each in near) and not draft.moves:
            draft.add_move({"kind": "travel", "direction": "forward", "means": "drive"})
        is_led = any(word.endswith(f" {each}") for each in (*ahead, *near))
        if is_led and any(each.get("means") == "drive" for each in draft.moves):
            goes = not one["motions"] and "is_lost" not in one
            one["motions"] += [{"kind": "drive"}] if goes else []
            for motion in one["motions"]:
                if motion["kind"] in ("drive", "move") and "direction" not in motion:
                    motion["direction"] = "away"


def _ride_on(draft: SceneDraft) -> None:
    """Let riders go of whom nothing is said: "a scooter rider on a road"."""
    for one in draft.things:
        mount = one.pop("rides", None)
        if mount is not None and not (one["motions"] or draft.things[mount]["motions"]):
            one["motions"] = [{"kind": "sit"}]
            draft.things[mount]["motions"] = [{"kind": "move"}]


def _do_deeds(draft: SceneDraft) -> None:
    """Let those do it who are named by what they do and do nothing else: "a violinist"."""
    for index, one in enumerate(draft.things):
        deed = one.pop("deed", None)
        one.pop("word", None)
        acts = draft.acts([index]) & word_set("things", "doing")
        if deed and not (one["motions"] or acts or "is_lost" in one):
            one["motions"].append({"kind": deed})
        for token in draft.tokens if deed in draft.does([index]) else ():
            if deeds().get(token.text) == deed:
                draft.fates[token.at] = "shown"
                draft.claim(token, "activity", deed, [index])


def _bring_home(draft: SceneDraft) -> None:
    """Set the place that a compound names where no other is said: "a street musician"."""
    for before, head, noun in draft.homes:
        name = before.all("place")[0].value
        is_species = name in word_set("things", "species_of") and noun not in PERSON_NOUNS
        is_species &= draft.nouns[noun].motion in ("walk", "fly", "swim")
        if draft.parts["place"].setdefault("name", name) == name and not is_species:
            draft.show(before)
        else:
            draft.merge_compound(before, head, noun)


def _skate_on_ice(draft: SceneDraft) -> None:
    """Have those skate on blades who are on ice, or named so."""
    is_ice = draft.parts["place"].get("name") in ("ice rink", "snow")
    for index, thing in enumerate(draft.things):
        skating = [one for one in thing["motions"] if one["kind"] == "skate"]
        for one in skating if is_ice or thing["noun"] in nouns_with("skates on ice") else ():
            one["kind"] = "skate on blades"
            draft.claims = {
                at: [replace(each, value="skate on blades")
                     if (each.subject, each.value) == (index, "skate") else each for each in claims]
                for at, claims in draft.claims.items()
            }  # fmt: skip


_LIGHT = 0.3
"""Greatest channel of a colour, linear, from which on a mark on it is black."""


def _turn_marks(draft: SceneDraft) -> None:
    """Have a disc turn with a mark on it: "a dot rotates on a disc"."""
    discs = word_table("turned_with_marks")
    for mark in (one for one in draft.things if one["noun"] in discs):
        on = [each["to"][0] for each in mark["relations"] if each["kind"] == "on"]
        for index in (n for n in on if draft.things[n]["noun"] in discs):
            disc = draft.things[index]
            draft.parts["camera"].setdefault("target", index)
            if "colour" not in mark:
                light = rgb_of(disc.get("colour")) or (0.0,)
                mark["colour"] = "black" if max(light) > _LIGHT else "white"
            turns = [each for each in mark["motions"] if each["kind"] in ("spin", "orbit")]
            is_turning = draft.nouns[disc["noun"]].is_working
            disc["noun"] = discs[disc["noun"]]  # no spokes beside the mark
            disc["motions"] = [{**each, "kind": "spin"} for each in turns or disc["motions"]]
            disc["motions"] = disc["motions"] or [{"kind": "spin"}] * is_turning
            mark["motions"] = [each for each in mark["motions"] if each not in turns]


def _limit_counts(draft: SceneDraft) -> None:
    """Leave out copies of objects that have most until a scene holds all, and say how many."""
    said = [int(one["count"]) for one in draft.things]
    while sum(one["count"] for one in draft.things) > MAX_BODIES:
        max(draft.things, key=lambda one: int(one["count"]))["count"] -= 1
    fewer = {n: one["count"] for n, one in zip(said, draft.things, strict=True) if one["count"] < n}
    for token in filter(draft.shows, draft.tokens):
        number = token.text.replace(",", "")
        for each in (one.value for one in token.all("field") if one.value[0] == "count"):
            count = fewer.get(each[1], each[1])
            if each[1] in fewer or (number.isdecimal() and int(number) > count):
                draft.fates[token.at] = str(count)  # "30" balls are 24


def _run_belts(draft: SceneDraft) -> None:
    """Let belts run as what is on them moves, which does not go by itself."""
    for index, one in enumerate(draft.things):
        for relation in one["relations"]:
            belt = draft.things[relation["to"][0]]
            is_carried = relation["kind"] == "on" and belt["noun"] in trait_values("belt speed")
            is_carried &= not draft.can_go(index) and len(one["motions"]) == 1
            if is_carried and one["motions"][0]["kind"] in ("move", "slide", "drive"):
                said = one["motions"].pop()
                direction = {"direction": "clockwise"} if said.get("direction") == "left" else {}
                kept = {key: said[key] for key in ("speed_m_s", "pace") if key in said}
                belt["motions"] = belt["motions"] or [{"kind": "work"}]
                belt["motions"][-1] |= {**kept, **direction}


def _give_each(draft: SceneDraft) -> None:
    """One of what has no singular, such as "glasses", for each who wears it.

    So do two who hold umbrellas or ride bicycles have one each, of which no number is said.
    """
    each, things = word_set("things", "each_has"), draft.things
    had = [(things[n]["count"], draft.targets([n], each)) for n in draft.find(PERSON_NOUNS)]
    for index, one in enumerate(things):
        people = sum(count for count, targets in had if index in targets)
        if one.pop("is_open", False) and people > 1:
            one["count"] = people


def _build(draft: SceneDraft, prompt: str) -> Scene:
    """The scene."""
    for index, one in enumerate([*draft.things]):
        for motion in (each for each in one["motions"] if "end_m_s" in each):
            _reach_speed(motion, draft.nouns[one["noun"]])
        if any([each.pop("in_turn", False) for each in one["motions"]]) and one["count"] > 1:
            take_turns(draft, index)
        if any(each.get("direction") == OPPOSITE for each in one["motions"]):
            halve(draft, index)
    _run_belts(draft)
    _give_each(draft)
    ids = number_nouns([one["noun"] for one in draft.things])
    for one in draft.things:
        done = {each["kind"] for each in one["relations"]} & word_set("things", "doing")
        if one.pop("is_lost", False) and not done and not one["motions"]:
            one["motions"].append({"kind": "stand"})
        for relation in one["relations"]:
            relation["to"] = [ids[target] for target in relation["to"]]
    for each in (draft.parts["camera"], *draft.effects):
        named = {name: each.get(name) for name in ("target", "source")}
        each.update({name: ids[one] for name, one in named.items() if one is not None})
    camera = {"moves": draft.moves, **draft.parts["camera"]}
    return scene_from_data(
        {"prompt": prompt, "objects": draft.things, "effects": draft.effects, "camera": camera,
         "light": draft.parts["light"], "place": draft.parts["place"], "absent": draft.absent}
    )  # fmt: skip
