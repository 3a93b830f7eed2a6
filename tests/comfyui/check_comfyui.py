"""Load, check and run the nodes by ComfyUI's own nodes.py and execution.py, by hand.

    python -m tests.comfyui.check_comfyui PATH

PATH is a checkout of ComfyUI, in whose environment this runs. Packages that ComfyUI imports, but
no node of texvent uses, may be missing: empty ones stand in.
"""

import asyncio
import importlib.abc
import importlib.machinery
import importlib.util
import sys
import tempfile
import types
from fractions import Fraction
from pathlib import Path
from unittest.mock import MagicMock

from tests.comfyui.comfy_interface import FOLDER, defaults

UNUSED = ("torchvision", "torchaudio", "kornia", "spandrel", "comfyui_frontend_package")


class Empty(types.ModuleType):
    """A package that has any name, and does nothing."""

    __path__: list[str] = []  # noqa: RUF012

    def __getattr__(self, name: str) -> object:
        if name.startswith("__"):
            raise AttributeError(name)
        return MagicMock()


class EmptyPackages(importlib.abc.MetaPathFinder, importlib.abc.Loader):
    """Finds empty packages for those that are missing."""

    def find_spec(self, name, path, target=None):
        if name.split(".")[0] in UNUSED:
            return importlib.machinery.ModuleSpec(name, self, is_package=True)
        return None

    def create_module(self, spec):
        return Empty(spec.name)

    def exec_module(self, module):
        module.__path__ = []


class Server:
    """What the executor tells its page."""

    client_id = last_node_id = last_prompt_id = None

    def __init__(self) -> None:
        self.sent = []
        self.sockets_metadata = {}

    def send_sync(self, event, data, sid=None):
        self.sent.append((event, data))


def main() -> int:
    """Run the checks; returns the exit code."""
    root = Path(sys.argv[1]).resolve()
    sys.argv = ["main.py", "--cpu"]
    sys.path.insert(0, str(root))
    sys.meta_path.append(EmptyPackages())
    import comfy.options

    comfy.options.enable_args_parsing()
    import comfyui_version
    import execution
    import folder_paths
    import nodes

    assert asyncio.run(nodes.load_custom_node(str(FOLDER)))
    kinds = nodes.NODE_CLASS_MAPPINGS

    def run(graph):
        is_valid, _, outputs, errors = asyncio.run(execution.validate_prompt("id", graph, None))
        if not is_valid or errors:
            return [(node, error["details"]) for node in errors for error in errors[node]["errors"]]
        server = Server()
        executor = execution.PromptExecutor(server)
        executor.execute(graph, "id", {"client_id": "check"}, outputs)
        if executor.success:
            return executor.history_result["outputs"]
        return [data["exception_message"] for name, data in server.sent if "error" in name]

    black = {"width": 16, "height": 12, "batch_size": 1, "color": 0}
    scene = defaults(
        kinds["TexventPromptToEvents"], prompt="a red ball bounces", duration=0.1, sensor="64x48"
    )
    good = {
        "1": scene,
        "2": defaults(kinds["TexventPreviewEvents"], events=["1", 0]),
        "3": defaults(kinds["TexventModelEsim"], contrast_threshold_on=0.3),
        "4": defaults(kinds["TexventImagesToEvents"], images=["2", 0], model=["3", 0], fps=30.0),
        "5": defaults(kinds["TexventSaveEvents"], events=["4", 0], filename_prefix="run/events"),
        "6": {"class_type": "PreviewImage", "inputs": {"images": ["2", 0]}},
    }
    bad_model = {**good, "3": defaults(kinds["TexventModelV2e"], cutoff_hz=-1.0)}
    one_image = {
        "1": {"class_type": "EmptyImage", "inputs": black},
        "2": defaults(kinds["TexventImagesToEvents"], images=["1", 0]),
        "3": defaults(kinds["TexventSaveEvents"], events=["2", 0]),
    }
    outside = {
        "1": scene,
        "2": defaults(kinds["TexventSaveEvents"], events=["1", 0], filename_prefix="../x"),
    }
    with tempfile.TemporaryDirectory() as folder:
        folder_paths.set_output_directory(folder)
        shown = run(good)
        assert shown["5"]["text"][0].startswith("events_00001_.h5: ")
        assert len(shown["6"]["images"]) > 1
        assert [one.name for one in (Path(folder) / "run").iterdir()] == ["events_00001_.h5"]
        assert run(bad_model) == [("3", "cutoff_hz")]
        (message,) = run(one_image)
        assert message.startswith("there is 1 image")
        (message,) = run(outside)
        assert message.startswith("filename_prefix is '../x'")
    assert len(_video_events(kinds["TexventVideoToEvents"]))
    print(f"ComfyUI {comfyui_version.__version__}: all as expected")  # noqa: T201
    return 0


def _video_events(cls) -> object:
    """Events of a VIDEO as ComfyUI's own class holds it."""
    import torch
    from comfy_api.latest import InputImpl, Types

    images = torch.rand((3, 12, 16, 3), generator=torch.Generator().manual_seed(1))
    parts = Types.VideoComponents(images=images, audio=None, frame_rate=Fraction(30000, 1001))
    (events,) = cls().simulate(InputImpl.VideoFromComponents(parts))
    return events


if __name__ == "__main__":
    sys.exit(main())
