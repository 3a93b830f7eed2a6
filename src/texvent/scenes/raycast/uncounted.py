"""Arrays that kernels pass on without counting references.

Numba counts references to an array atomically at every call. The ray caster passes its arrays
through several small functions per ray, and the counting would take most of the time.
"""

from __future__ import annotations

from typing import Any

from numba.core import cgutils
from numba.core.imputils import impl_ret_untracked
from numba.extending import intrinsic
from numba.np.arrayobj import make_array

from texvent.runtime.jit import jit
from texvent.scenes.raycast.records import World

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


@jit(error_model="numpy")
def uncounted_world(world: World) -> World:
    """The same scene in arrays without an owner."""
    return World(
        uncounted(world.instant),
        uncounted(world.shapes),
        uncounted(world.lists),
        uncounted(world.lamps),
        uncounted(world.tiles),
        uncounted(world.surfaces),
        uncounted(world.puffs),
        uncounted(world.glows),
    )
