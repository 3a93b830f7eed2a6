"""The public names, pinned; and what importing them costs."""

import subprocess
import sys
from pathlib import Path

import texvent

PUBLIC = {
    "SENSORS",
    "ConfigError",
    "EventCamera",
    "EventPackets",
    "EventStream",
    "FileFormatError",
    "Frame",
    "FrameStream",
    "InputError",
    "MissingDependencyError",
    "OutputError",
    "Sensor",
    "SensorSize",
    "TexventError",
    "TexventWarning",
    "TruthFolder",
    "Video",
    "__version__",
    "check_simulator",
    "compare",
    "dataset",
    "formats",
    "generate",
    "generators",
    "interpolators",
    "load",
    "load_truth",
    "open",
    "pixel_models",
    "presets",
    "read",
    "representations",
    "rig",
    "save_truth",
    "sensors",
    "simulate",
    "simulators",
    "training",
    "video",
}
HEAVY = ("torch", "numba", "cv2", "av", "h5py", "tyro", "rich")


def loaded_by(statement: str) -> set[str]:
    code = f"{statement}\nimport sys; print(' '.join(sys.modules))"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    return set(done.stdout.split())


def test_the_public_names_are_these_and_all_exist():
    assert set(texvent.__all__) == PUBLIC
    assert len(PUBLIC) <= 40
    assert all(hasattr(texvent, name) for name in PUBLIC)
    assert set(dir(texvent)) == PUBLIC


def test_the_api_and_the_value_types_load_no_heavy_package():
    names = ("generate", "simulate", "video", "open", "compare", "EventStream", "EventPackets")
    loaded = loaded_by(f"import texvent; {'; '.join(f'texvent.{name}' for name in names)}")
    assert not set(HEAVY) & loaded


def test_no_module_has_the_name_of_a_function():
    modules = {path.stem for path in Path(texvent.__path__[0]).iterdir()}
    assert {name for name in PUBLIC & modules if callable(getattr(texvent, name))} == set()
