"""ComfyUI's published V1 interface: how it loads a folder, checks a graph and runs it.

Not ComfyUI: no server, no cache. What is loaded, refused and called follows `nodes.py` and
`execution.py` of ComfyUI.
"""

from __future__ import annotations

import importlib.util
import inspect
import sys
from pathlib import Path
from types import ModuleType

WIDGETS = ("INT", "FLOAT", "STRING", "BOOLEAN")
CONVERT = {"INT": int, "FLOAT": float, "STRING": str, "BOOLEAN": bool}
FOLDER = Path(__file__).parents[2] / "comfyui" / "texvent_nodes"


def load(folder: Path = FOLDER) -> tuple[dict, dict]:
    """The tables of a folder in custom_nodes."""
    name = str(folder).replace(".", "_x_")
    spec = importlib.util.spec_from_file_location(name, folder / "__init__.py")
    module = importlib.util.module_from_spec(spec)
    sys.modules[name] = module
    spec.loader.exec_module(module)
    return module.NODE_CLASS_MAPPINGS, module.NODE_DISPLAY_NAME_MAPPINGS


def part(name: str) -> ModuleType:
    """A module of the loaded folder."""
    return sys.modules[f"{str(FOLDER).replace('.', '_x_')}.{name}"]


def folder_paths(output: Path) -> ModuleType:
    """The module that knows where files go."""

    def get_save_image_path(filename_prefix, output_dir, image_width=0, image_height=0):
        subfolder, name = Path(filename_prefix).parent, Path(filename_prefix).name
        folder = Path(output_dir) / subfolder
        if not folder.resolve().is_relative_to(Path(output_dir)):
            raise Exception("**** ERROR: Saving image outside the output folder is not allowed.")
        folder.mkdir(parents=True, exist_ok=True)
        found = [one.name[len(name) + 1 :].split("_")[0] for one in folder.glob(f"{name}_*")]
        counter = max((int(one) for one in found if one.isdigit()), default=0) + 1
        return str(folder), name, counter, str(subfolder), filename_prefix

    module = ModuleType("folder_paths")
    module.get_output_directory = lambda: str(output)
    module.get_save_image_path = get_save_image_path
    return module


def check(graph: dict, classes: dict) -> list[str]:
    """What ComfyUI would refuse: node, input and reason."""
    errors = []
    for name, node in graph.items():
        cls, given = classes[node["class_type"]], dict(node["inputs"])
        inputs = cls.INPUT_TYPES()
        known = {**inputs["required"], **inputs.get("optional", {})}
        custom = inspect.getfullargspec(cls.VALIDATE_INPUTS).args[1:] if _validates(cls) else []
        for key, info in known.items():
            if key not in given:
                if key in inputs["required"]:
                    errors.append(f"{name}.{key}: required input is missing")
                continue
            error = _check_value(graph, classes, given, key, info, key in custom)
            if error is not None:
                errors.append(f"{name}.{key}: {error}")
        # Of the custom check, every input that it names is given, and gets its message.
        values = {key: given[key] for key in custom if key in given}
        answer = cls.VALIDATE_INPUTS(**values) if custom else True
        errors += [f"{name}.{key}: {answer}" for key in values if answer is not True]
    return errors


def _check_value(graph, classes, given, key, info, skips) -> str | None:
    kind, facts, value = info[0], info[1] if len(info) > 1 else {}, given[key]
    if _is_link(value):
        returned = classes[graph[value[0]]["class_type"]].RETURN_TYPES[value[1]]
        wanted = "COMBO" if isinstance(kind, list) else kind
        return None if returned == wanted else f"got {returned}, expected {wanted}"
    if isinstance(kind, list):
        return None if skips or value in kind else f"{value!r} is not in the list"
    if kind not in WIDGETS:
        return "must be linked"
    given[key] = value = CONVERT[kind](value)
    if not skips and "min" in facts and value < facts["min"]:
        return f"{value} is below {facts['min']}"
    if not skips and "max" in facts and value > facts["max"]:
        return f"{value} is above {facts['max']}"
    return None


def run(graph: dict, classes: dict) -> dict[str, dict]:
    """The outputs of every node: `result` and, of output nodes, `ui`. Nodes come in order."""
    done: dict[str, dict] = {}
    for name, node in graph.items():
        cls = classes[node["class_type"]]
        values = {
            key: done[one[0]]["result"][one[1]] if _is_link(one) else one
            for key, one in node["inputs"].items()
        }
        answer = getattr(cls(), cls.FUNCTION)(**values)
        done[name] = answer if isinstance(answer, dict) else {"result": answer}
        assert len(done[name]["result"]) == len(cls.RETURN_TYPES)
    return done


def defaults(cls, **inputs) -> dict:
    """A node of a graph: the defaults of its widgets, and these inputs."""
    widgets = {
        key: info[1]["default"]
        for key, info in cls.INPUT_TYPES()["required"].items()
        if len(info) > 1 and "default" in info[1]
    }
    return {"class_type": cls.__name__, "inputs": {**widgets, **inputs}}


def _validates(cls) -> bool:
    return hasattr(cls, "VALIDATE_INPUTS")


def _is_link(value) -> bool:
    return isinstance(value, list)
