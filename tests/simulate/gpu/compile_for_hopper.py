"""Compile every GPU kernel for an H100 or H200, without one: prints JSON.

Run by `test_compiled`, in a process where Triton's interpreter is off.
"""

from __future__ import annotations

import json
import re
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any, NamedTuple

import triton
from triton.backends.compiler import GPUTarget
from triton.compiler import ASTSource

from texvent.simulate.gpu import (
    esim_rules,
    esim_triton,
    kernel_types,
    noise_triton,
    ordering_triton,
    texvent_rules,
    texvent_triton,
)
from texvent.simulate.gpu.device import LAUNCH
from texvent.simulate.gpu.esim_pixels import RAMP_WALK
from texvent.simulate.gpu.texvent_pixels import BRIGHTNESS_WALK, LEVELS_WALK

HOPPER = GPUTarget("cuda", 90, 32)
TOOL = Path(triton.__file__).parent / "backends" / "nvidia" / "bin" / "cuobjdump"
INTERVALS = kernel_types.Intervals(*["*i64"] * 6)
TEXVENT = texvent_rules.Rules("*fp64", "*i32", "*fp64", "i32", "i32")
ESIM = esim_rules.Rules("*fp64", "*fp64", None, None, None)
RESTING_ESIM = esim_rules.Rules("*fp64", "*fp64", "*fp64", "*fp64", "*i64")
NOISE = kernel_types.NoiseRules("*fp64", "*fp64", "i32")


class Case(NamedTuple):
    """One kernel with the types of its arguments."""

    name: str
    kernel: Any
    arguments: dict[str, Any]
    constants: dict[str, int]
    warps: int = 4


def frames_of(dtype: str) -> kernel_types.Frames:
    return kernel_types.Frames(f"*{dtype}", f"*{dtype}", "i32", "i32", "i32", "i32", "i32")


def records_of(reference: str) -> kernel_types.Records:
    order = "*i32" if reference == "fp64" else None
    return kernel_types.Records("*i32", order, f"*{reference}")


def walks(dtype: str) -> Iterator[Case]:
    """Both passes of the kernels that walk over pixels."""
    for is_first in (True, False):
        tally = kernel_types.Tally("*i32" if is_first else "*i64", "*u8", "*i32")
        common = {"frames": frames_of(dtype), "intervals": INTERVALS, "tally": tally}
        found = f"{dtype} {'count' if is_first else 'write'}"
        for name, kernel, reference, walk in (
            ("walk_levels", texvent_triton.walk_levels, dtype, LEVELS_WALK),
            ("walk_brightness", texvent_triton.walk_brightness, "fp64", BRIGHTNESS_WALK),
        ):
            yield Case(
                f"{name} {found}",
                kernel,
                common
                | {
                    "rules": TEXVENT,
                    "reference": f"*{reference}",
                    "records": None if is_first else records_of(reference),
                },
                {"ALIGN": 16, "BLOCK": walk.block},
                walk.warps,
            )
        for name, rules, fired_us in (("", ESIM, None), (" resting", RESTING_ESIM, "*i64")):
            yield Case(
                f"walk_ramp{name} {found}",
                esim_triton.walk_ramp,
                common
                | {
                    "rules": rules,
                    "state": esim_rules.State("*fp64", fired_us),
                    "tally": tally._replace(fired=None),
                    "records": None if is_first else records_of("fp64"),
                },
                {"ALIGN": 16, "BLOCK": RAMP_WALK.block},
                RAMP_WALK.warps,
            )


def event_kernels() -> Iterator[Case]:
    """The kernels that see events only."""
    seen = {"frames": frames_of("u8"), "intervals": INTERVALS}
    block = {"BLOCK": 512}
    for name, stamp in texvent_rules.STAMPS.items():
        ends = ("*i64", "*fp64" if name == "eq7" else None)
        arguments = seen | {"rules": TEXVENT, "records": records_of("u8"), "ends": ends}
        yield Case(
            f"stamp_events {name}",
            texvent_triton.stamp_events,
            arguments | {"words": "*i64"},
            block | {"STAMP": stamp},
        )
    extremes = {"frames": frames_of("u8"), "rules": TEXVENT, "records": records_of("u8")}
    yield Case(
        "find_extremes",
        texvent_triton.find_extremes,
        extremes | {"ends": "*i64", "extremes": "*fp64"},
        block,
    )
    crossings = seen | {"rules": ESIM, "records": records_of("fp64")}
    yield Case(
        "stamp_crossings",
        esim_triton.stamp_crossings,
        crossings | {"ends": "*i64", "words": "*i64"},
        block,
    )
    columns = ("*i32", "*i32", "*i64", "*i8", "*i8")
    yield Case(
        "unpack_events",
        ordering_triton.unpack_events,
        {"words": "*i64", "clips": ("*i64", "*i64"), "columns": columns}
        | {"area": "i32", "width": "i32"},
        block,
    )
    noise = seen | {"rules": NOISE, "fired": "*u8", "tally": "*i64", "words": "*i64"}
    yield Case("draw_noise", noise_triton.draw_noise, noise, {"LANES": 8, "DRAWS": 64})


def compile_case(case: Case) -> dict[str, int]:
    """Registers, stack bytes and local bytes of a kernel's machine code."""
    constants: dict[tuple[int, ...], Any] = {}
    aligned: dict[tuple[int, ...], Any] = {}
    signature = {}
    for index, parameter in enumerate(case.kernel.params):
        if parameter.name in case.constants:
            signature[parameter.name] = "constexpr"
            constants[(index,)] = case.constants[parameter.name]
        else:
            given = case.arguments[parameter.name]
            signature[parameter.name] = type_of(given, (index,), constants, aligned)
    source = ASTSource(fn=case.kernel, signature=signature, constexprs=constants, attrs=aligned)
    compiled = triton.compile(source, target=HOPPER, options={"num_warps": case.warps, **LAUNCH})
    with tempfile.NamedTemporaryFile(suffix=".cubin") as file:
        file.write(compiled.asm["cubin"])
        file.flush()
        usage = subprocess.run(
            [TOOL, "--dump-resource-usage", file.name], capture_output=True, text=True, check=True
        ).stdout
    found = dict(re.findall(r"\b(REG|STACK|LOCAL):(\d+)", usage))
    return {name: int(number) for name, number in found.items()}


def type_of(
    given: Any, path: tuple[int, ...], constants: dict[Any, Any], aligned: dict[Any, Any]
) -> Any:
    """A signature as Triton makes it: None becomes a constant, a group stays a group."""
    if given is None:
        constants[path] = None
        return "constexpr"
    if not isinstance(given, tuple):
        if given.startswith("*"):
            # What a launch finds in the address of any tensor that torch has just made.
            aligned[path] = [["tt.divisibility", 16]]
        return given
    parts = [type_of(part, (*path, index), constants, aligned) for index, part in enumerate(given)]
    return type(given)(*parts) if hasattr(given, "_fields") else tuple(parts)


if __name__ == "__main__":
    cases = [*walks("u8"), *walks("fp32"), *event_kernels()]
    json.dump({case.name: compile_case(case) for case in cases}, sys.stdout)
