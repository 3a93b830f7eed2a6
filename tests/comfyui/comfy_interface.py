"""ComfyUI's published V1 interface: how it loads a folder and runs a graph.

Not ComfyUI: no server, no cache. It follows `nodes.py` and `execution.py` of ComfyUI.
"""

import importlib.util
import sys
from pathlib import Path
from types import ModuleType

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


def _is_link(value) -> bool:
    return isinstance(value, list)
