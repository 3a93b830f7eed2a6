"""Rules of the sources: zero is a value, files are kept, docstrings begin with a noun; layers.

Nowhere is a number that may be None taken for "not given" because it is 0.
"""

import ast
import re
import tomllib
from collections import defaultdict
from collections.abc import Iterable, Iterator
from itertools import chain
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
NUMBERS = {"int", "float", "Fraction", "Number", "Seconds", "Hertz", "Metres"}
WITHOUT_ZERO = {
    "flicker.py": "ratio", "linear_light.py": "white_level full_scale",
    "video_file.py": "constant_rate",
    "plan.py": "trial", "calibrate.py": "flicker_ratio", "simulated_samples.py": "slice_us",
    "pipeline_loading.py": "offload_gb gpu_gb", "config.py": "figure offload_gb gpu_gb",
    "download_sizes.py": "_rounded size", "dialect.py": "width", "memory.py": "machine_bytes",
    "engines.py": "of", "engine.py": "clips", "model_options.py": "on_off_ratio",
    "plots.py": "bin_us", "video_writer.py": "fps", "words.py": "blink_hz",
    "defaults.py": "blink_hz", "procedural.py": "flicker_hz", "actors.py": "act_s",
    "striking.py": "tumble_rad_s", "along_surface.py": "said_m_s", "track.py": "restitution",
    "recordings.py": "events_per_image", "reconstruction_factors.py": "clips",
}  # fmt: skip
"""File → names of numbers in it whose zero is refused at the door, or does mean none."""
OPENING = re.compile(r"\s*(What|Who|Whose|How|Where|Which|Of)\b")
"""An interrogative or a genitive, with which no docstring begins."""
FUNCTIONS = ast.FunctionDef | ast.AsyncFunctionDef


def is_number_or_none(annotation: ast.expr | None) -> bool:
    """Whether an annotation allows a number, None and nothing else."""
    if not isinstance(annotation, ast.BinOp | ast.Constant):  # such as a name alone
        return False
    text = ast.unparse(annotation).strip("'\"")
    parts = {one.strip() for one in text.split("|")}
    return "None" in parts and len(parts) > 1 and parts <= NUMBERS | {"None"}


def asked(nodes: Iterable[ast.AST]) -> Iterator[ast.expr]:
    """Expressions whose truth decides."""
    for one in nodes:
        if isinstance(one, ast.If | ast.While | ast.IfExp | ast.Assert):
            yield from one.test.values if isinstance(one.test, ast.BoolOp) else [one.test]
        elif isinstance(one, ast.BoolOp) and getattr(one.values[-1], "value", 1) != 0:
            yield from one.values[:-1]
        elif isinstance(one, ast.UnaryOp) and isinstance(one.op, ast.Not):
            yield one.operand
        elif isinstance(one, ast.comprehension):
            yield from one.ifs
        elif isinstance(one, ast.Call) and getattr(one.func, "id", "") in ("bool", "any", "all"):
            yield from one.args


def nodes_of(text: str) -> list[ast.AST]:
    return [*ast.walk(ast.parse(text))]


@pytest.fixture(scope="module")
def sources() -> dict[Path, list[ast.AST]]:
    """Nodes of every file."""
    places = ROOT / "src", ROOT / "lab" / "src"
    files = [one for place in places for one in sorted(place.rglob("*.py"))]
    return {one: nodes_of(one.read_text(encoding="utf-8")) for one in files}


def numbers_by_name(of: dict[Path, list[ast.AST]]) -> set[str]:
    """Names of fields and functions that are, or give, such a number wherever they are."""
    kinds = defaultdict(set)
    for one in chain.from_iterable(of.values()):
        if isinstance(one, FUNCTIONS):
            kinds[one.name].add(is_number_or_none(one.returns))
        for field in one.body if isinstance(one, ast.ClassDef) else ():
            if isinstance(field, ast.AnnAssign) and isinstance(field.target, ast.Name):
                kinds[field.target.id].add(is_number_or_none(field.annotation))
    return {name for name, found in kinds.items() if found == {True}}


def name_of(value: ast.expr) -> str:
    """Last name of a field, of a function that is called, or of what a name is given."""
    value = value.value if isinstance(value, ast.NamedExpr) else value
    value = value.func if isinstance(value, ast.Call) else value
    return getattr(value, "attr", getattr(value, "id", ""))


def zeros_taken_for_none(nodes: list[ast.AST], fields: set[str]) -> Iterator[tuple[str, int]]:
    """Names of such numbers whose truth is asked, and lines."""
    kept = [one for one in nodes if isinstance(one, ast.Assign)]
    kept = [one for one in kept if name_of(one.value) in fields - {"get"}]
    for one in asked(nodes):
        is_named = not isinstance(one, ast.Name) or isinstance(one, ast.NamedExpr)
        if is_named and name_of(one) in fields:
            yield name_of(one), one.lineno
    for function in (one for one in nodes if isinstance(one, FUNCTIONS)):
        given = (*function.args.posonlyargs, *function.args.args, *function.args.kwonlyargs)
        names = {one.arg for one in given if is_number_or_none(one.annotation)}
        for one in kept:
            if function.lineno <= one.lineno <= (function.end_lineno or 0):
                names |= {target.id for target in one.targets if isinstance(target, ast.Name)}
        for one in asked(ast.walk(function)) if names else ():
            if isinstance(one, ast.Name) and one.id in names:
                yield one.id, one.lineno


def test_no_number_that_may_be_none_is_asked_for_its_truth(sources):
    fields = numbers_by_name(sources)
    assert len(fields) > 50
    found = [
        f"{path.relative_to(ROOT)}:{line} {name}"
        for path, nodes in sources.items()
        for name, line in zeros_taken_for_none(nodes, fields)
        if name not in WITHOUT_ZERO.get(path.name, "").split()
    ]
    assert not found, "compare with None:\n" + "\n".join(found)


def test_zeros_are_found_where_they_decide():
    text = "class A:\n    seed: int | None\n\ndef f(a: A, n: float | None, k: int):\n"
    for line, is_found in {
        "if a.seed: pass": True, "n = n or 3.0": True, "if not n: pass": True,
        "b = 1 if n else 2": True, "b = n or 0.0": False,
        "m = a.seed; b = m or 1": True, "m = k; b = m or 1": False,
        "if n is None and k: pass": False, "if n is not None or a.seed == 0: pass": False,
    }.items():  # fmt: skip
        nodes = nodes_of(f"{text}    {line}\n")
        assert bool([*zeros_taken_for_none(nodes, {"seed"})]) is is_found, line


def test_nothing_replaces_files_unasked(sources):
    found = []
    of = {path: each for path, each in sources.items() if "overwrite" in path.read_text("utf-8")}
    for path, node in ((path, one) for path, nodes in of.items() for one in nodes):
        pairs = list[tuple[str, ast.expr | None]]()
        if isinstance(node, ast.arguments):
            names = [one.arg for one in (*node.posonlyargs, *node.args)]
            pairs += zip((one.arg for one in node.kwonlyargs), node.kw_defaults, strict=True)
            pairs += zip(names[::-1], node.defaults[::-1], strict=False)
        if isinstance(node, ast.AnnAssign) and isinstance(node.target, ast.Name):
            pairs.append((node.target.id, node.value))
        values = [value for name, value in pairs if name == "overwrite"]
        found += [(path.name, each) for each in values if isinstance(each, ast.Constant)]
    assert len(found) > 15
    assert [name for name, each in found if each.value is not False] == []


def test_docstrings_begin_with_a_noun(sources):
    found = [
        f"{path.relative_to(ROOT)}:{node.lineno}: {text.strip()[:50]}"
        for path, nodes in sources.items()
        for node in nodes
        if isinstance(node, ast.Expr) and isinstance(text := getattr(node.value, "value", 0), str)
        if OPENING.match(text)
    ]
    assert found == []


def checked_layers():
    contracts = tomllib.loads((ROOT / "pyproject.toml").read_text())["tool"]["importlinter"]
    layers = next(one["layers"] for one in contracts["contracts"] if one["type"] == "layers")
    return [layer.replace("texvent.", "") for layer in layers]


def documented_layers():
    text = (ROOT / "ARCHITECTURE.md").read_text().partition("## What may import what")[2]
    block = text.partition("```text\n")[2].partition("```")[0]
    return [re.split(r"\s{2,}", line)[0] for line in block.splitlines()]


def test_the_documented_layers_are_those_that_are_checked():
    assert documented_layers() == checked_layers()


def test_every_module_has_a_layer():
    top = {
        path.stem
        for path in (ROOT / "src" / "texvent").iterdir()
        if path.suffix == ".py" or (path / "__init__.py").exists()
    }
    layered = {name for layer in checked_layers() for name in layer.split(" | ")}
    assert top - layered == {"__init__", "__main__", "_version"}
    assert layered - top == {"texvent_lab", "texvent_scenes"}
