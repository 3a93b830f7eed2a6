"""Completion of a draft: decisions that need all of its clauses."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from texvent_scenes.colours import rgb_of
from texvent_scenes.models.activities import ACTIVITIES, PERSON_NOUNS
from texvent_scenes.models.places import is_room
from texvent_scenes.models.tables import nouns_with, trait_value
from texvent_scenes.read.draft.abilities import balls_of
from texvent_scenes.read.draft.copies import part_off
from texvent_scenes.read.draft.own_parts import take_parts
from texvent_scenes.read.draft.scene_draft import SceneDraft
from texvent_scenes.read.draft.setting import leave_sky
from texvent_scenes.read.draft.sources import find_sources
from texvent_scenes.read.parsing.lexicon import deeds, word_set, word_table
from texvent_scenes.spec.scene import MAX_BODIES


def complete(draft: SceneDraft) -> None:
    """Decide what a draft leaves open; the order of the decisions is that of `_DECISIONS`."""
    for decide in _DECISIONS:
        decide(draft)


def _choose_gender(draft: SceneDraft) -> None:
    """Draw the only person as the one that a pronoun means: "a teacher chops her carrots".

    A noun that says a sex keeps it: after "a boy", "her" means another person.
    """
    persons = [one for one in draft.things if one["noun"] in PERSON_NOUNS]
    usual = persons[0]["noun"] if len(persons) == 1 and persons[0]["count"] == 1 else ""
    said = str(persons[0].get("word", "")).split()[-1:] if usual else []
    words = {word for one in draft.tokens for word in one.text.split()}  # "brushes her hair"
    for noun in word_table("sexes").get(usual, ()):
        is_meant = bool(words & {*word_table("people")[noun]})
        if is_meant and persons[0]["noun"] == usual and not {*said} & word_set("things", "male"):
            persons[0]["noun"] = noun
            draft.fates.update({at: noun for at, one in draft.fates.items() if one == usual})


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


def _swim(draft: SceneDraft) -> None:
    """Let animals swim that are in a water and do nothing else: "a hippo in a river"."""
    for one in draft.things:
        at = one.pop("waded_at", None)
        is_open = not (one["motions"] or one["relations"] or "is_lost" in one)
        if at is not None and is_open and one["noun"] not in PERSON_NOUNS:
            one["motions"] = [{"kind": "swim"}]
            draft.fates[at] = "shown"


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


_SEEN_SIZE = 3.0
"""Size of a small ball that is seen from where both players are, as a multiple of the usual one."""


def _find_opponents(draft: SceneDraft) -> None:
    """Give who plays a rally an opponent, a ball and what they play over."""
    for kind, needed in word_table("rallies").items():
        players = [n for n, one in enumerate(draft.things)
                   if kind in [each["kind"] for each in one["motions"]]
                   and not any(each["kind"] == "rally" for each in one["relations"])]  # fmt: skip
        if not players:
            continue
        if sum(draft.things[one]["count"] for one in players) == 1:
            players.append(draft.add("person", motions=[{"kind": kind}]))
        targets = []
        for noun in needed:
            known = [n for n, one in enumerate(draft.things) if noun.endswith(one["noun"])]
            for one in known[:1]:
                draft.things[one] |= {"noun": noun, "motions": []}
            targets.append(known[0] if known else draft.add(noun))
        draft.things[targets[0]].setdefault("size", _SEEN_SIZE)  # a speck between two people
        for one in players:
            draft.relate(one, "rally", targets)


_ABOUT = {"kind": "run", "direction": "to and fro", "pace": 0.6}
"""Motion of players who have not the ball."""


def _share_ball(draft: SceneDraft) -> None:
    """Give those who play a game together one ball, which the last has of whom it is said."""
    for kind in [one for one in ACTIVITIES if balls_of(one)]:
        players = [n for n in range(len(draft.things)) if kind in draft.does([n])]
        claims = [one for at in sorted(draft.claims) for one in draft.claims[at]]
        said = [one for one in claims if one.value == kind and one.subject in players]
        games = [one for one in said if one.word.startswith("play ")]
        if not games or sum(draft.things[n]["count"] for n in players) < 2:
            continue
        holder = int(said[-1].subject or 0)
        if draft.things[holder]["count"] > 1:
            part_off(draft, holder, draft.things[holder]["count"] - 1)
            players.append(len(draft.things) - 1)
        for thing in (draft.things[n] for n in players if n != holder):
            thing["motions"] = [{**_ABOUT} if one["kind"] == kind else one
                                for one in thing["motions"]]  # fmt: skip
        draft.claims = {at: [replace(one, subject=holder) if one in games else one for one in each]
                        for at, each in draft.claims.items()}  # fmt: skip


def _look_at_held(draft: SceneDraft) -> None:
    """Look closely at what is held where no holder is said: "pouring into a mug"."""
    camera = draft.parts["camera"]
    implied = [n for n, one in enumerate(draft.things) if one.pop("is_implied", False)]
    held = draft.targets(implied, ("hold",))
    if held and camera.get("framing") == "close":
        camera.setdefault("target", held[0])


def _hang_up(draft: SceneDraft) -> None:
    """Put on a wall of their own what hangs on one by its name: "a wall clock"."""
    hung, walls = nouns_with("hangs on a wall"), nouns_with("only a background")
    for token in draft.tokens:
        wall, _, rest = token.text.partition(" ")
        named = token.nouns & hung if rest else set()
        bare = [one for one in draft.find(named) if not draft.things[one]["relations"]]
        for index in bare[:1] if wall in walls else ():
            draft.relate(index, "on", [draft.add(wall)])


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


def _tell_stars(draft: SceneDraft) -> None:
    """Report stars that are named beside others at night, which are near and large."""
    for token in (one for one in draft.tokens if one.text == "stars" and one.nouns):
        if draft.parts["light"].get("kind") == "night" and draft.shows(token):
            draft.mark(token, "star shapes")


def _tell_above_ground(draft: SceneDraft) -> None:
    """Report what is named as below the ground and is drawn in the open: "a subway train"."""
    place = draft.parts["place"].get("name", "")
    below = word_set("things", "underground")
    is_open = not (place and is_room(place))
    for token in draft.tokens if is_open else ():
        names_it = token.has("noun") and not below.isdisjoint(token.text.split())
        if names_it and draft.shows(token):
            noun = draft.fates[token.at]
            noun = next(iter(token.nouns)) if noun == "shown" else noun
            draft.mark(token, f"{noun} in the open")


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


def _claim_levels(draft: SceneDraft) -> None:
    """Leave it to the staged scene whether the camera, or what hovers, is at eye level."""
    flying = [n for n, one in enumerate(draft.things) if draft.nouns[one["noun"]].habitat == "air"]
    for token in draft.tokens:
        if token.text not in word_set("things", "eye_levels"):
            continue
        before = [one for one in draft.tokens if one.at < token.at]
        ends = (n + 1 for n, one in enumerate(before) if one.is_sign)
        said = before[max(ends, default=0) :]
        is_flyer = any(one.has("verb") for one in said) and not any(
            one.has("camera", "shot") for one in said
        )
        own: list[int | None] = [*(flying[-1:] if is_flyer else ())] or [None]
        led = draft.beside(token, -1).text
        is_own = led.endswith(("'s", "’s")) or led in word_set("things", "owners")
        draft.claim(token, "eye level", "own" if is_own and own == [None] else "", own)


_GOING_BY = {"move", "slide"}
"""Motions of what a moving camera goes past, as a sentence says it."""


def _pass_fixed(draft: SceneDraft) -> None:
    """Have the camera go past what is fixed, which does not move: "trees slide by"."""
    for at, claims in [*draft.claims.items()]:
        verb = draft.tokens[at]
        is_by = any(one.value.relation == "past" for one in verb.all("verb"))
        is_by |= draft.beside(verb, 1).text in word_set("things", "by") and not verb.verbs("ed")
        about = {one.subject for one in claims if one.subject is not None and verb.has("verb")}
        fixed = [n for n in sorted(about) if draft.noun(n).habitat == "fixed"
                 and not (draft.is_light(n) and (draft.targets([n], ["on"]) or not draft.moves))
                 and not draft.targets([n], ["past"])
                 and {one["kind"] for one in draft.things[n]["motions"]} <= _GOING_BY
                 and not any("speed_m_s" in one for one in draft.things[n]["motions"])]  # fmt: skip
        if not (is_by and fixed and len(fixed) == len(about)):
            continue
        for index in fixed:
            draft.things[index]["motions"] = []
        draft.claims[at] = []
        draft.claim(verb, "camera", "past", [None], fixed)
        going = [n for n in range(len(draft.things)) if draft.can_go(n) and draft.goes(n)]
        if not any(one["kind"] in ("travel", "follow", "truck") for one in draft.moves):
            draft.add_move({"kind": "follow" if going else "truck"})


_TOWERING_M = 4.0
"""Height from which on what is fixed does not rise, but stands: "hills rise behind a lake"."""


def _stand_tall(draft: SceneDraft) -> None:
    """Have high things that are fixed stand where a sentence has them rise."""
    for index, thing in enumerate(draft.things):
        noun = draft.noun(index)
        is_open = noun.habitat == "fixed" and [one["kind"] for one in thing["motions"]] == ["rise"]
        if is_open and not noun.acts:
            model = noun.build(colour=None, scale=1.0, seed=0)
            if model.height >= _TOWERING_M:
                thing["motions"] = []


_DECISIONS: tuple[Callable[[SceneDraft], object], ...] = (
    take_parts, _choose_gender, _look_at_held, _lead_view, _ride_on, _swim, _do_deeds,
    _find_opponents, _share_ball,
    _hang_up, _stand_level, _tell_riders, _tell_stars, _tell_above_ground, find_sources, leave_sky,
    _turn_marks, _skate_on_ice, _bring_home, _limit_counts, _look_up, _bring_weather, _claim_levels,
    _pass_fixed, _stand_tall,
)  # fmt: skip
"""Decisions, in their order."""
