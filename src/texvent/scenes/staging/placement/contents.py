"""Things in a vessel: stems stand in its mouth, others lie in layers and look out of it."""

from __future__ import annotations

import math

from texvent.scenes.description import SceneDescription
from texvent.scenes.models.objects.receptacles import SERVED_IN
from texvent.scenes.models.protocol import Model
from texvent.scenes.models.wrapped.hollow import HOLLOW, HollowModel
from texvent.scenes.models.wrapped.opened import OPENED, OpenedModel
from texvent.scenes.models.wrapped.served import OWN_DISH, ServedModel
from texvent.scenes.staging.placement.object_groups import ObjectGroup

SLIM = 1.5
"""How much taller than wide a stem is."""
_THIN = 4.0
_INSIDE = 0.75
"""Width of the inside of a vessel, as a share of the outside."""
_GOLDEN = math.pi * (3.0 - math.sqrt(5.0))
_SUNK = 0.12
"""Height of the ends of stems above the foot of a vessel, as a share of its height."""
_LAYER = 0.75
"""Height of a layer, as a share of the height of what lies in it."""
_SEEN = 0.6
"""Share of the height of the first layer that looks out."""
_ROUND = 0.62
"""From one thing to the next in a layer, as a share of its width: what lies in a pile overlaps."""

_HOLDING = frozenset({"in", "on", "through", "from"})


def with_contents(
    models: list[Model], noun: str, description: SceneDescription, index: int
) -> list[Model]:
    """The models as what they hold, or what holds them, asks for.

    A window without its pane, an open box, noodles without their bowl on a plate.
    """
    relations = description.relations
    kinds = {one.kind for one in relations if one.targets[0] == index}
    if noun in OPENED and kinds & _HOLDING:
        return [OpenedModel(one, noun) for one in models]
    if noun in HOLLOW and "in" in kinds:
        return [HollowModel(one) for one in models]
    if is_served(noun, description, index):
        return [ServedModel(one, noun) for one in models]
    return models


def is_served(noun: str, description: SceneDescription, index: int) -> bool:
    """Whether it is food that has a dish of its own, on or in another one."""
    return noun in OWN_DISH and any(
        one.subject == index
        and one.kind in ("in", "on")
        and description.objects[one.targets[0]].noun in SERVED_IN
        for one in description.relations
    )


def is_stem(model: Model) -> bool:
    """Whether it stands upright in a vessel: a flower, a spoon, a brush."""
    return model.height > SLIM * max(model.length, model.width)


def is_rod(model: Model) -> bool:
    """Whether it lies along its x and is thin: a pencil, a brush, a spoon."""
    return model.length > _THIN * max(model.width, model.height)


def pack(group: ObjectGroup, target: ObjectGroup, rim_m: float, before: int, count: int) -> float:
    """Arrange the copies of a group in a vessel.

    Args:
        group: what is in it; its offsets and headings change.
        target: the vessel.
        rim_m: height of the vessel's rim over its foot, m.
        before: how many other things in it have a place already.
        count: how many there are in all.

    Returns:
        Height of the first copy's foot over that of the vessel, m.
    """
    model, vessel = group.models[0], target.models[0]
    room = _INSIDE * min(vessel.length, vessel.width)
    own = len(group.offsets)
    group.yaws = [_GOLDEN * (before + number) for number in range(own)]
    group.is_stood_up = is_rod(model) and model.length > room
    if is_stem(model) or group.is_stood_up:
        reach = 0.3 * room if count > 1 else 0.0
        group.offsets = [_on_disc(reach, before + number, count) for number in range(own)]
        return _SUNK * vessel.height + (0.5 * model.length if group.is_stood_up else 0.0)
    wide = max(model.length, model.width)
    most = max(1, int(0.9 * (room / wide) ** 2))
    offsets = []
    for number in range(before, before + own):
        layer, place = divmod(number, most)
        full = min(most, count - layer * most)
        reach = min(
            _ROUND * wide * math.sqrt(max(full - 1, 0)), max(0.5 * (room - 0.6 * wide), 0.0)
        )
        x, y, _ = _on_disc(reach, place, full)
        offsets.append((x, y, layer * _LAYER * model.height))
    group.offsets = offsets
    return max(rim_m - (1.0 - _SEEN) * model.height, 0.08 * vessel.height)


def _on_disc(reach: float, number: int, count: int) -> tuple[float, float, float]:
    """Place of one of several that are spread evenly over a disc, m."""
    if count <= 1:
        return (0.0, 0.0, 0.0)
    far = reach if count <= 4 else reach * math.sqrt((number + 0.5) / count)
    angle = 2.0 * math.pi * number / count if count <= 4 else _GOLDEN * number
    # The first one is nearest to the viewer.
    return (far * math.sin(angle), -far * math.cos(angle), 0.0)
