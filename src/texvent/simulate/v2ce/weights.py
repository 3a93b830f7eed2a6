"""Reading a file of V2CE weights: every tensor's name and shape is checked before it is used."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from texvent._require import require
from texvent.errors import ConfigError, FileFormatError, InputError
from texvent.networks.weight_files import (
    Tensor,
    check_finite,
    describe_mismatch,
    named_tensors,
    read_mapping,
    shapes_of,
)
from texvent.simulate.v2ce.layout import (
    BATCH_COUNTER,
    HEAD,
    SPECTRAL,
    SPECTRAL_LEFT,
    tensor_shapes,
)

FILE_NAME = "v2ce_3d.pt"
WHERE_FROM = (
    f"the published file is {FILE_NAME}; its authors' project V2CE-Toolbox "
    "(github.com/ucsd-hdsi-dvs/V2CE-Toolbox) links to it"
)
FIRST_TENSOR = f"{HEAD}.weight"


def check_weights_path(path: Path | None) -> Path:
    """The path of a weights file that exists.

    Raises:
        ConfigError: no file was named.
        InputError: there is no such file.
    """
    if path is None:
        raise ConfigError(
            f"simulator v2ce needs its network's weights and downloads nothing; {WHERE_FROM}. "
            "Then pass weights=PATH"
        )
    if not path.is_file():
        raise InputError(f"there is no weights file {path}; {WHERE_FROM}")
    return path


def read_weights(path: Path, device: str) -> dict[str, Tensor]:
    """Tensors of a weights file, ready for inference.

    A plain state dict is read, one saved from several GPUs (`module.` before every name), and a
    training checkpoint that holds one beside other things. The network's width is taken from the
    file; the published one has 32 channels.

    Args:
        path: the file.
        device: "cpu" or "cuda".

    Returns:
        Name → tensor, float32, on `device`, spectral normalisation applied, without counters.

    Raises:
        FileFormatError: it is no such file, is damaged, or a tensor is missing, unknown or of
            another shape.
        MissingDependencyError: torch is not installed.
    """
    tensors = named_tensors(_strip_prefix(_read_state(path), path), extra="v2ce")
    expected = tensor_shapes(tensors[FIRST_TENSOR].shape[0])
    needed = [name for name in expected if not name.endswith(BATCH_COUNTER)]
    wanted = {name: expected[name] for name in expected if name in needed or name in tensors}
    problem = describe_mismatch(shapes_of(tensors), wanted)
    if problem is not None:
        raise FileFormatError(f"{path} {problem}; it is not the layout of {FILE_NAME}")
    used = {name: tensors[name].to(device) for name in needed}
    check_finite(used, path)
    return apply_spectral_norm(used)


def _read_state(path: Path) -> Mapping[str, Any]:
    content = read_mapping(path, WHERE_FROM, extra="v2ce")
    state = content.get("state_dict", content)
    if not isinstance(state, Mapping) or not all(isinstance(name, str) for name in state):
        raise FileFormatError(
            f"{path} holds {type(state).__name__}, not named tensors; {WHERE_FROM}"
        )
    return state


def _strip_prefix(state: Mapping[str, Any], path: Path) -> dict[str, Any]:
    """The network's tensors under their own names; what else a checkpoint holds is left out."""
    for name in state:
        if name.endswith(FIRST_TENSOR):
            prefix = name.removesuffix(FIRST_TENSOR)
            break
    else:
        raise FileFormatError(
            f"{path} has no tensor {FIRST_TENSOR}; it holds other weights than V2CE's. {WHERE_FROM}"
        )
    return {
        name.removeprefix(prefix): tensor
        for name, tensor in state.items()
        if name.startswith(prefix)
    }


def apply_spectral_norm(tensors: Mapping[str, Tensor]) -> dict[str, Tensor]:
    """Spectrally normalised weights as plain ones: divided by their largest singular value.

    The value is estimated as the original does before its first window, by one power iteration
    from the stored vector.

    Deviation: the original iterates again before every window, so that its weights drift a little
        with the number of windows it has seen; here they stay.
    """
    torch = require("torch", extra="v2ce")
    plain: dict[str, Tensor] = {}
    for name, tensor in tensors.items():
        layer = name.removesuffix(f".{SPECTRAL}")
        if layer != name:
            matrix = tensor.reshape(tensor.shape[0], -1)
            left = tensors[f"{layer}.{SPECTRAL_LEFT}"]
            right = torch.nn.functional.normalize(matrix.T @ left, dim=0)
            left = torch.nn.functional.normalize(matrix @ right, dim=0)
            plain[f"{layer}.weight"] = tensor / (left @ (matrix @ right))
        elif ".module." not in name:
            plain[name] = tensor
    return plain
