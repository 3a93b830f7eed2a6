"""The package template: what colcon, ros2 launch and ros2 run will look for is there."""

import runpy
import sys
from pathlib import Path
from types import ModuleType
from xml.etree import ElementTree

import pytest

ROOT = Path(__file__).parents[2] / "ros" / "texvent_ros"


@pytest.fixture
def setup_arguments(monkeypatch) -> dict:
    """What setup.py gives to setuptools."""
    given = {}
    setuptools = ModuleType("setuptools")
    setuptools.setup = lambda **arguments: given.update(arguments)
    monkeypatch.setitem(sys.modules, "setuptools", setuptools)
    monkeypatch.chdir(ROOT)
    runpy.run_path("setup.py")
    return given


def test_package_xml_and_setup_py_agree(setup_arguments):
    package = ElementTree.parse(ROOT / "package.xml").getroot()
    assert package.get("format") == "3"
    assert package.findtext("name") == setup_arguments["name"] == ROOT.name
    assert package.findtext("version") == setup_arguments["version"]
    assert package.findtext("license") == setup_arguments["license"]
    assert package.findtext("export/build_type") == "ament_python"
    wanted = {one.text for one in package.findall("exec_depend")}
    assert wanted >= {"rclpy", "sensor_msgs", "event_camera_msgs"}


def test_the_index_of_ament_finds_the_package(setup_arguments):
    files = dict(setup_arguments["data_files"])
    assert files["share/ament_index/resource_index/packages"] == ["resource/texvent_ros"]
    assert files["share/texvent_ros"] == ["package.xml"]
    assert files["share/texvent_ros/launch"] == ["launch/event_camera.launch.py"]
    assert all((ROOT / name).is_file() for names in files.values() for name in names)
    assert "$base/lib/texvent_ros" in (ROOT / "setup.cfg").read_text()


def test_the_entry_point_is_the_node(setup_arguments):
    (script,) = setup_arguments["entry_points"]["console_scripts"]
    assert script == "event_camera = texvent_ros.node:main"
