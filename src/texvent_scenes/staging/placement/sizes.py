"""Sizes of objects, by what they are on, in or go through."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from texvent_scenes.description import SceneDescription, label_of
from texvent_scenes.models.activities import PERSON_NOUNS
from texvent_scenes.models.protocol import Model, Noun
from texvent_scenes.models.tables import nouns_with, trait_value
from texvent_scenes.staging.placement.containers import reach_of
from texvent_scenes.staging.placement.object_groups import dressed

Hollow = tuple[float, float, float, float, float]
"""Inner length and width as shares of a box, floor as a share of its height, least and greatest
scale."""
_ROOM, _LEAST_INSIDE = 1.1, 0.25
"""Room over the size of what is in a container; least scale of a thing in it."""
_OPENING, _UPRIGHT, _LEAST_TUNNEL = 0.4, 0.65, 0.4
"""Scale of a tunnel per metre of who goes through it, of whom the height counts less; the least."""
_ROOMY, _LEAST_SHARE, _LEAST_HELD = 0.85, 0.3, 0.1
"""Share of a top that is taken by what is on it; least share of its size at which a thing is drawn,
and of what is in a container: a whale in a teacup."""
_RUN = 45.0
"""Length of a slope, in sizes of what rolls down on it, at most its usual one."""
_MARK = 0.2
"""Size of a shape on another one."""
_NOTED = 0.1
"""Change of a size that the report names."""


class Sizes:
    """Sizes with which the objects of a scene fit each other.

    Args:
        description: the scene.
        nouns: those of its objects, by name.
        is_trip: whether the camera passes the objects on a trip: containers then keep their sizes.
    """

    def __init__(
        self, description: SceneDescription, nouns: Mapping[str, Noun], *, is_trip: bool
    ) -> None:
        self._description = description
        self._nouns = nouns
        self._is_trip = is_trip

    def share(self, index: int) -> tuple[float, list[str]]:
        """Share of the size that is said at which an object fits, and notes for the report."""
        if self._is_mark(index):
            return _MARK, []
        on, notes = self._fit_on(index)
        inside, more = self._fit_in(index)
        fitted = self._fit_through(index) * self._fit_down(index)
        return on * inside * fitted, [*notes, *more]

    def _is_mark(self, index: int) -> bool:
        """Whether it is a shape on another one of its kind: a dot on a disc."""
        objects = self._description.objects
        return any(
            {objects[n].noun for n in (index, one.targets[0])} <= nouns_with("flat pattern")
            for one in self._description.relations
            if one.subject == index != one.targets[0] and one.kind in ("on", "in")
        )

    def _fit_on(self, index: int) -> tuple[float, list[str]]:
        """Share at which several things, or a solid of any size, find room on what is below."""
        said, objects = self._description.objects[index], self._description.objects
        noun = dressed(self._description, index, self._nouns)
        targets = [one.targets[0] for one in self._description.relations
                   if one.subject == index and one.kind == "on"]  # fmt: skip
        below = [self._nouns[objects[n].noun] for n in targets if n != index]
        is_lone = said.count < 2 and noun.name not in nouns_with("of any size")
        if is_lone or noun.habitat != "fixed" or not below or below[0].habitat != "fixed":
            return 1.0, []
        own = self._build(index)
        top = below[0].build(colour=None, scale=objects[targets[0]].size, seed=0)
        room_m = _ROOMY * max(top.length, top.width) * objects[targets[0]].count
        share = max(room_m / (said.count * max(own.length, own.width)), _LEAST_SHARE)
        if share >= 1.0:
            return 1.0, []
        return share, [f"the {label_of(self._description, index)} is drawn at {share:.0%} of its "
                       f"size, for which the {below[0].name} has room"]  # fmt: skip

    def _fit_in(self, index: int) -> tuple[float, list[str]]:
        """Scale of a container that holds what is in it, or of what it has no room for."""
        objects = self._description.objects
        for one in self._description.relations if not self._is_trip else ():
            hollow = trait_value("container", objects[one.targets[0]].noun)
            if one.kind != "in" or hollow is None or index not in (one.subject, *one.targets):
                continue
            inside = [r.subject for r in self._description.relations
                      if r.kind == "in" and r.targets[0] == one.targets[0]]  # fmt: skip
            models = [(self._build(n), objects[n].count) for n in inside]
            target = self._build(one.targets[0])
            whole, share = fit_in(target, hollow, models)
            lying = [self._build(n).height for n in inside if self._is_swimmer(n)]
            if lying and objects[one.targets[0]].noun in nouns_with("see-through"):
                side_m = min(hollow[0] * target.length, hollow[1] * target.width)
                whole, share = max(whole, _ROOM * max(lying) / side_m), 1.0
            own = whole if index == one.targets[0] else share
            if abs(own - 1.0) <= _NOTED:
                return own, []
            return own, [f"the {label_of(self._description, index)} is drawn at {own:.0%} of its "
                         "usual size, as one is in the other"]  # fmt: skip
        return 1.0, []

    def _is_swimmer(self, index: int) -> bool:
        """Whether it is a person who swims, for whom a tank is as large as it must be."""
        said = self._description.objects[index]
        return said.noun in PERSON_NOUNS and any(one.kind == "swim" for one in said.motions)

    def _fit_through(self, index: int) -> float:
        """Scale of a passage: a foot tunnel for those who are small."""
        goers = [self._build(one.subject) for one in self._description.relations
                 if one.kind == "through" and index in one.targets]  # fmt: skip
        is_fitted = self._description.objects[index].noun in nouns_with("fits who goes through")
        return fit_passage(goers) if is_fitted and goers else 1.0

    def _fit_down(self, index: int) -> float:
        """Scale of a slope: a short one for marbles."""
        goers = [self._build(one.subject) for one in self._description.relations
                 if one.kind == "on" and index in one.targets]  # fmt: skip
        if trait_value("slope", self._description.objects[index].noun) is None or not goers:
            return 1.0
        largest = max(max(one.length, one.width, one.height) for one in goers)
        return min(_RUN * largest / self._build(index).length, 1.0)

    def _build(self, index: int) -> Model:
        """A copy of an object at the size that is said."""
        noun = dressed(self._description, index, self._nouns)
        return noun.build(colour=None, scale=self._description.objects[index].size, seed=0)


def fit_in(
    container: Model, hollow: Hollow, inside: Sequence[tuple[Model, int]]
) -> tuple[float, float]:
    """Scale of a container, and of what is in it, with which that fits.

    Args:
        container: at the size that is said.
        hollow: its trait.
        inside: models at the size that is said, and how many of each.
    """
    across_m, along_m = hollow[0] * container.length, hollow[1] * container.width
    if container.length >= container.width:  # the side along which they are lined up
        across_m, along_m = along_m, across_m
    count = sum(number for _, number in inside)
    longest = max(max(one.length, one.width) for one, _ in inside)
    row_m = sum(reach_of(one, count) * number for one, number in inside)
    share = _ROOM * max(row_m / along_m, longest / across_m)
    scale = min(max(share, hollow[3]), hollow[4])
    return scale, max(min(scale / share, 1.0), _LEAST_HELD)


def fit_passage(goers: Sequence[Model]) -> float:
    """Scale of a tunnel for those who go through it."""
    widest = max(max(one.width, _UPRIGHT * one.height) for one in goers)
    return min(max(_OPENING * widest, _LEAST_TUNNEL), 1.0)
