"""Arrays that kernels pass on without counting references.

Numba counts references to an array atomically at every call. The ray caster passes its arrays
through several small functions per ray, and the counting would take most of the time.
"""

from __future__ import annotations

from typing import Any, cast

import numba
import numpy as np
from numba import types
from numba.core import cgutils
from numba.core.imputils import impl_ret_untracked
from numba.extending import intrinsic, overload
from numba.np.arrayobj import make_array

from texvent.scenes.raycast.records import (
    GLOW_RECORD,
    IMAGE_RECORD,
    NODE_RECORD,
    PUFF_RECORD,
    TRIANGLE_RECORD,
    MeshView,
    OwnedWorld,
    SceneView,
    World,
)

_null_of: Any = cgutils.get_null_value
_array_view: Any = make_array
_untracked: Any = impl_ret_untracked


def _build_view(typing_context: Any, array: Any) -> Any:
    """The same array without an owner; use it only while its owner lives (inside one kernel)."""

    def build(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        view = _array_view(array)(context, builder, arguments[0])
        view.meminfo = _null_of(view.meminfo.type)
        view.parent = _null_of(view.parent.type)
        return _untracked(context, builder, array, view._getvalue())

    return array(array), build


uncounted: Any = intrinsic(_build_view)
"""`uncounted(array)`, in a kernel: the same array without an owner, valid while its owner lives."""


def uncounted_world(owner: World | OwnedWorld) -> World:
    """In a kernel: the same scene in few arrays without an owner, the others by address."""
    kind: Any = SceneView if isinstance(owner, World) else MeshView
    return cast(World, kind(*owner[: len(SceneView._fields)]))


@overload(uncounted_world, strict=False)
def _overload_uncounted_world(owner: Any) -> Any:
    kind = SceneView if owner.instance_class is World else MeshView

    def build(owner: Any) -> Any:
        return kind(
            uncounted(owner.instant),
            uncounted(owner.shapes),
            uncounted(owner.lists),
            uncounted(owner.lamps),
        )

    return build


def has_meshes(world: World) -> bool:
    """In a kernel: whether the scene has meshes or images; known when it is compiled."""
    return not isinstance(world, (World, SceneView))


@overload(has_meshes, strict=False)
def _overload_has_meshes(world: Any) -> Any:
    if world.instance_class in (World, SceneView):
        return lambda world: False
    return lambda world: True


def _record_reader(dtype: np.dtype[Any]) -> Any:
    """`read(address, index)`, in a kernel: one record of an array at an address."""
    kind: Any = numba.from_dtype(dtype)
    size = dtype.itemsize

    def build_reader(typing_context: Any, address: Any, index: Any) -> Any:
        def build(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
            offset = builder.mul(arguments[1], arguments[1].type(size))
            place = builder.add(arguments[0], offset)
            return builder.inttoptr(place, context.get_value_type(kind))

        return kind(types.int64, types.int64), build

    return intrinsic(build_reader)


node_at: Any = _record_reader(NODE_RECORD)
triangle_at: Any = _record_reader(TRIANGLE_RECORD)
image_at: Any = _record_reader(IMAGE_RECORD)
puff_at: Any = _record_reader(PUFF_RECORD)
glow_at: Any = _record_reader(GLOW_RECORD)


def _build_texel(typing_context: Any, address: Any, index: Any) -> Any:
    def build(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        value = context.get_value_type(types.float32)
        place = builder.inttoptr(arguments[0], value.as_pointer())
        texel = builder.load(builder.gep(place, [arguments[1]]))
        return builder.fpext(texel, context.get_value_type(types.float64))

    return types.float64(types.int64, types.int64), build


texel_at: Any = intrinsic(_build_texel)
"""`texel_at(address, index)`, in a kernel: one number of the texels."""
