"""Verbs, words of speed and of movement are shown only where the picture moves as they say."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from texvent.generate.seen_words.motion.image_motion import ImageMotion, measure_motion
from texvent.generate.seen_words.motion.verb_changes import judge_change
from texvent.generate.seen_words.motion.verb_senses import judge_sense
from texvent.generate.seen_words.people import are_hands_hidden
from texvent.generate.seen_words.picture import Picture
from texvent.scenes.description import Claim, ObjectMotion, SceneDescription
from texvent.scenes.language.vocabulary.motion import DIRECTIONS, FLOWING, PACE_ADJECTIVES, PACES
from texvent.scenes.language.vocabulary.verbs import GETTING, VERBS
from texvent.scenes.language.words.english import list_verb_forms
from texvent.scenes.models.people.activities import PERSON_NOUNS
from texvent.scenes.models.people.work.verbs import HANDWORK, MOVED
from texvent.scenes.models.wrapped.opening import OPENS
from texvent.scenes.staging.actors import Actor
from texvent.scenes.staging.acts.attached import HeldAt
from texvent.scenes.staging.acts.hand_work.working import WorkingAt
from texvent.scenes.staging.claims.bodies import part_boxes
from texvent.scenes.staging.claims.contact import is_in, is_on
from texvent.scenes.staging.trajectories.phases import PATH_KINDS
from texvent.scenes.staging.trajectories.schedule import Phase, schedule

LEAST_WAY = 0.25
"""Share of its size that what goes somewhere goes at least, or grows or shrinks by."""
LEAST_CHANGE = 0.05
"""Share of its size that a part moves at least of what acts in its place."""
LEAST_SWAY = 0.04
"""The same for what sways or works."""
LEAST_LIFT = 0.10
"""Share of its size that what stands up or lies down rises or falls at least."""
LEAST_IN_PICTURE, LEAST_ACT = 0.03, 0.03
"""The same as shares of the picture's width: of what goes, and of a part of what acts."""
FAST, FAST_FOR_SIZE, FAST_AT_LEAST = 0.35, 1.5, 0.25
"""Fast is from so many picture widths per second on, or sizes per second and widths per second."""
SLOW = 3.0
"""Sizes per second up to which something is slow."""
ACTING_FAST = 0.2
"""Share of its size that a part moves at least of what acts fast in its place."""
OFF_GROUND = 0.35
"""Share of its height that what takes off or lands may be above the ground at that end."""
HARDLY = "hardly moves"
_STILL = frozenset(
    {"stand", "sit", "lie", "hover", "kneel", "crouch", "lean", "hold", "point", "look", "read",
     "phone", "watch", "rest", "pose", "ride", "carry", "float", "thumbs up", "thumbs down",
     "victory", "ok", "fist", "one", "three", "four", "five", "horns", "shaka", "sleep", "hang",
     "plank", "handstand", "stand on skis", "text"}
)  # fmt: skip
"""What is shown without a motion."""
_GOING = PATH_KINDS | {
    "enter",
    "leave",
    "reverse",
    "zigzag",
    "orbit",
    "appear",
    "park",
    "change lane",
}
_BY_GRAVITY = frozenset({"bounce", "fall", "throw", "jump", "flip", "topple", "fall over"})
"""What gravity alone gives its speed."""
_REACTING = frozenset({"push", "pull", "kick", "hit", "throw", "give"})
"""Relations whose target must move."""
_SWAYING = frozenset({"sway", "work", "talk", "laugh", "sing", "eat", "chew", "graze", "drink",
                      "jackhammer"})  # fmt: skip
_GETTING = re.compile(
    r"(stand|stood|get|got|sit|sat|lie|lying|lay|kneel|knelt|crouch|squat|climb)\w* (up|down)"
)
_TAKING_OFF = re.compile(r"(t[ao]k|lift|blast)\w* ?off|launch\w*")
_FLOWS = re.compile(r"(flow|run|stream|gush|trickle)\w*")
_LANDING = re.compile(r"land(s|ed|ing)?|touch\w* down|settle\w*")
_ENDS = re.compile(r"onto|into|off|out of")
_TO_A_SIDE = frozenset(word for way in ("left", "right", "towards", "away", "across")
                       for word in DIRECTIONS[way])  # fmt: skip
_HASTE = 1.4
_MOVING = MOVED | {"lift", "rock"}
"""Patterns of hand work in which the thing moves."""
_PACE = {word: pace for table in (PACES, PACE_ADJECTIVES) for pace, words in table.items()
         for word in words if pace != 1.0}  # fmt: skip
_HASTY = {
    form: verb.pace
    for verb in VERBS
    if verb.pace >= _HASTE
    and verb.kind in ("move", "run")
    and verb.end_pace is None
    and verb.relation in (None, "past")
    for form, _ in list_verb_forms(verb.base)
}
"""Forms of verbs that say how fast it goes → pace."""
_PACE |= {"racing": 1.7, "rushing": 1.7, "slow motion": 0.3}
NOTHING_MOVES = "nothing moves"


def judge_verbs(picture: Picture, description: SceneDescription) -> dict[str, str]:
    """What words say of motion that the picture does not show.

    Args:
        picture: of the staged scene.
        description: what it was staged from.

    Returns:
        Word → why it is not seen.
    """
    judge = _Judge(picture, description)
    faults: dict[str, str] = {}
    for claim in description.claims:
        fault = judge.judge(claim)
        if fault is not None:
            faults.setdefault(claim.word, fault)
    return faults


class _Judge:
    """Words of one description, against one picture."""

    def __init__(self, picture: Picture, description: SceneDescription) -> None:
        self.picture, self.description = picture, description
        self.duration_s = max(view.time_s for view in picture.views)
        self._known: dict[tuple[float, float], dict[int, ImageMotion]] = {}

    def judge(self, claim: Claim) -> str | None:
        """Why what a word says of motion is not seen, or None."""
        if any(one.kind in ("on", "in") for one in claim.relations):
            ends = self._judge_ends(claim)
            if ends is not None:
                return ends
        pace = _PACE.get(claim.word)
        if pace is not None and claim.aspect in ("motion", "quality"):
            return None if claim.move is not None else self._judge_pace(claim, pace)
        if claim.aspect != "motion" or claim.move is not None:
            return None
        if not claim.things:
            index = self._find_doer(claim)
            if index is not None and not self._moves(index):
                return f"{self.description.objects[index].noun} {HARDLY}"
            is_flow = self.description.surroundings.place in FLOWING and (
                _FLOWS.fullmatch(claim.word) is not None
            )
            is_seen = self._is_camera_moving() or self.picture.scene.particles.kinds
            return None if is_seen or is_flow else NOTHING_MOVES
        sense = judge_sense(claim, self.description)
        if sense is not None:
            return sense
        if self._is_moved_by_hand(claim):
            return None
        idle = self._judge_targets(claim) or self._judge_handled(claim)
        if idle is not None:
            return idle
        found = [
            self._judge_motion(claim, index)
            or judge_change(self.picture, claim, self._actors(index))
            or self._judge_haste(claim, index)
            for index in claim.things
        ]
        return None if None in found else found[0]

    def _judge_motion(self, claim: Claim, index: int) -> str | None:
        """Why an object is not seen to do what a verb says, or None."""
        noun = self.description.objects[index].noun
        is_part = index not in self.picture.scene.object_of.values()
        for phase in self._phases(index, claim.motion):
            if is_part and phase.motion.kind in _GOING:
                return f"{noun} {HARDLY}"
            if phase.motion.kind == "work" and claim.word in _TO_A_SIDE:
                # A belt that runs that way does so where it stands.
                is_belt = phase.motion.direction in ("left", "right")
                return None if is_belt else f"{noun} stays where it is"
            if phase.motion.kind == "point" and claim.word in DIRECTIONS["towards"]:
                return f"{noun} points to a side"
            moves = self._measure(index, phase)
            if not moves:
                continue
            if _GETTING.fullmatch(claim.word) and _is_settled(phase, moves):
                return f"{noun} does so all the time"
            fault = self._judge_air(claim, index, phase)
            if fault is not None:
                return fault
            if not any(_is_seen_moving(phase, one) for one in moves):
                return f"{noun} {HARDLY}"
        return None

    def _judge_targets(self, claim: Claim) -> str | None:
        """What is pushed, kicked or thrown must move itself."""
        whole = Phase(ObjectMotion("move"), 0.0, self.duration_s)
        for relation in claim.relations if set(claim.things) else ():
            if relation.kind not in _REACTING:
                continue
            for target in relation.targets:
                moves = self._measure(target, whole)
                if moves and max(max(one.shift, one.change) for one in moves) < LEAST_WAY:
                    return f"{self.description.objects[target].noun} {HARDLY}"
        return None

    def _is_moved_by_hand(self, claim: Claim) -> bool:
        """Whether hands put a thing down, pick it up or drop it, and it is seen to move."""
        whole = Phase(ObjectMotion("move"), 0.0, self.duration_s)
        for relation in claim.relations:
            for actor in self._actors(relation.subject):
                path = actor.trajectory
                if not isinstance(path, WorkingAt):
                    continue
                moves = [it for n in relation.targets for it in self._measure(n, whole)]
                said = [self.description.objects[n].motion for n in relation.targets]
                if any(one is not None and one.kind in OPENS for one in said):
                    return any(one.change >= LEAST_WAY for one in moves)
                if path.work.pattern in MOVED:
                    return any(one.shift >= LEAST_WAY for one in moves)
        return False

    def _judge_handled(self, claim: Claim) -> str | None:
        """Hands at work must be in view, and what they put down, lift or shake must move."""
        for index in claim.things:
            for phase in self._phases(index, claim.motion):
                work = HANDWORK.get(phase.motion.kind)
                if work is None or self.description.objects[index].noun not in PERSON_NOUNS:
                    continue
                workers = self._actors(index)
                if workers and all(are_hands_hidden(self.picture, one) for one in workers):
                    return "the hands are hidden"
                if work.pattern not in _MOVING:
                    continue
                targets = [n for one in self.description.relations for n in one.targets
                           if one.kind == "work on" and one.subject == index]  # fmt: skip
                targets = targets or self._list_held(index)
                moves = [one for n in targets for one in self._measure(n, phase)]
                least = LEAST_WAY if work.pattern in MOVED else LEAST_CHANGE
                if not any(max(one.shift, one.change) >= least for one in moves):
                    noun = self.description.objects[targets[0]].noun if targets else "what is held"
                    return f"{noun} stays where it is"
        return None

    def _list_held(self, index: int) -> list[int]:
        """As in "lifts a barbell": what is in the hands of who does it."""
        return [
            one.object_index
            for one in self.picture.scene.actors
            if isinstance(one.trajectory, HeldAt) and one.trajectory.holder.object_index == index
        ]

    def _judge_haste(self, claim: Claim, index: int) -> str | None:
        """Verbs such as "races" and "dashes" need something fast."""
        pace = _HASTY.get(claim.word)
        return None if pace is None else self._judge_pace(replace(claim, things=(index,)), pace)

    def _find_doer(self, claim: Claim) -> int | None:
        """The object whose name stands right before a verb that was read for the scene."""
        prompt = self.description.prompt.casefold()
        for other in self.description.claims:
            if other.aspect == "name" and other.things and f"{other.word} {claim.word}" in prompt:
                return other.things[0]
        return None

    def _moves(self, index: int) -> bool:
        """Whether an object does what it is to do, and is seen to."""
        if any(one.motion is not None and one.motion[0] == index
               for one in self.picture.scene.unmet):  # fmt: skip
            return False
        phases = [one for one in self._phases(index, None) if one.motion.kind not in _STILL]
        return any(_is_seen_moving(one, it) for one in phases for it in self._measure(index, one))

    def _judge_air(self, claim: Claim, index: int, phase: Phase) -> str | None:
        """What takes off begins on the ground, or on something; what lands ends there."""
        is_start = _TAKING_OFF.fullmatch(claim.word) is not None
        is_end = _LANDING.fullmatch(claim.word) is not None
        actor = next((one for one in self._actors(index)), None)
        if actor is None or not (is_start or is_end):
            return None
        if self.picture.ground_share() == 0.0 and len(self.picture.scene.actors) == 1:
            return "no ground in view"
        time_s = phase.start_s if is_start else phase.end_s
        low, high = part_boxes(actor, time_s).hull
        others = (one for one in self.picture.scene.actors if one.object_index != index)
        if low[2] <= OFF_GROUND * (high[2] - low[2]) or any(
            is_on(actor, one, time_s) for one in others
        ):
            return None
        name = actor.noun.name
        return f"{name} is in the air from the start" if is_start else f"{name} stays in the air"

    def _judge_ends(self, claim: Claim) -> str | None:
        """Words such as "onto" and "out of" need another state before than after."""
        if not _ENDS.fullmatch(claim.word):
            return None
        is_leaving = claim.word in ("off", "out of")
        for relation in claim.relations:
            holds = is_on if relation.kind == "on" else is_in
            targets = [one for n in relation.targets for one in self._actors(n)]
            for actor in self._actors(relation.subject)[:1] if targets else ():
                before, after = (
                    any(holds(actor, one, t) for one in targets) for t in (0.0, self.duration_s)
                )
                if before and not is_leaving:
                    return f"{actor.noun.name} is there from the start"
                if is_leaving and (after or not before):
                    return f"{actor.noun.name} does not leave it"
        return None

    def _judge_pace(self, claim: Claim, pace: float) -> str | None:
        """Words of speed need something that moves, and as fast."""
        indices = claim.things or tuple(range(len(self.description.objects)))
        is_any = False
        for index in indices:
            if claim.things and not self._moves(index):
                continue
            for phase in self._phases(index, claim.motion):
                moves = self._measure(index, phase)
                moving = [one for one in moves if _is_seen_moving(phase, one)]
                is_any = is_any or bool(moving)
                if phase.motion.kind in _STILL or not moving:
                    continue
                if any(_fits(pace, phase.motion, one) for one in moving):
                    return None
        degree = "fast" if pace > 1.0 else "slow"
        if not claim.things:
            if self.picture.scene.particles.kinds or self._is_camera_moving():
                return None
            return f"nothing is {degree} in the picture" if is_any else NOTHING_MOVES
        noun = self.description.objects[indices[0]].noun
        if not is_any:
            return f"{noun} {HARDLY}"
        return f"{noun} is not {degree} in the picture"

    def _phases(self, index: int, number: int | None) -> Sequence[Phase]:
        """When an object makes a motion; without a number, all that it makes."""
        said = self.description.objects[index]
        if said.motion is None:
            return ()
        motions = (said.motion, *said.then)
        wanted = motions if number is None else motions[number : number + 1]
        times = schedule(motions, self.duration_s)
        return [one for one in times if any(one.motion is motion for motion in wanted)]

    def _measure(self, index: int, phase: Phase) -> list[ImageMotion]:
        """What the copies of an object do in a phase, those that are seen."""
        key = (phase.start_s, phase.end_s)
        if key not in self._known:
            every = sorted(self.picture.scene.object_of)
            self._known[key] = measure_motion(self.picture, every, *key)
        known = self._known[key]
        copies = [one for one, of in self.picture.scene.object_of.items() if of == index]
        return [known[one] for one in copies if one in known]

    def _actors(self, index: int) -> list[Actor]:
        return [one for one in self.picture.scene.actors if one.object_index == index]

    def _is_camera_moving(self) -> bool:
        first, last = self.picture.views[0].camera, self.picture.views[-1].camera
        return not (
            np.allclose(first.position, last.position, atol=1e-2)
            and np.allclose(first.rotation, last.rotation, atol=1e-2)
        )


def _is_settled(phase: Phase, found: Sequence[ImageMotion]) -> bool:
    """Whether who is said to get up or down neither does so nor changes posture."""
    if phase.motion.kind == "climb":
        return False
    changes = max(one.change for one in found) if phase.motion.kind in GETTING else 0.0
    return max(abs(one.lift) for one in found) < LEAST_LIFT and changes < LEAST_WAY


def _is_seen_moving(phase: Phase, found: ImageMotion) -> bool:
    """Whether a motion is to be seen."""
    kind = phase.motion.kind
    if kind in _STILL or phase.motion.is_stuck:
        return True
    if kind in _GOING:
        share = min(1.0, phase.duration_s)
        way = max(found.shift, found.growth)
        return way >= LEAST_WAY * share and way * found.size >= LEAST_IN_PICTURE * share
    if kind == "throw":
        return found.change >= LEAST_WAY
    least, of_picture = (LEAST_SWAY, 0.0) if kind in _SWAYING else (LEAST_CHANGE, LEAST_ACT)
    return found.change >= least and found.change * found.size >= of_picture


def _fits(pace: float, motion: ObjectMotion, found: ImageMotion) -> bool:
    """Whether what is seen to move is fast, or slow."""
    if motion.kind not in _GOING:
        is_slow = motion.pace < 1.0 and motion.kind not in _BY_GRAVITY
        return is_slow if pace < 1.0 else found.change >= ACTING_FAST
    speed = found.speed + found.growth
    if pace < 1.0:
        return speed <= SLOW
    in_picture = speed * found.size
    return in_picture >= FAST or (speed >= FAST_FOR_SIZE and in_picture >= FAST_AT_LEAST)
