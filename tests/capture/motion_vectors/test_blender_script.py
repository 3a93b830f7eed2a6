"""The script for Blender, run by Blender: BLENDER_PYTHON names a Python that has bpy.

A plane at the distance of the focal length (36 mm sensor, 10 m across, 120 px: 12 px per metre)
moves to the right faster and faster and rises evenly.
"""

import os
import subprocess
from pathlib import Path

import numpy as np
import pytest

from texvent.capture.motion_vectors.conventions import CONVENTIONS, to_pixels
from texvent.capture.motion_vectors.fields import open_fields

PYTHON = os.environ.get("BLENDER_PYTHON")
SCRIPT = Path(__file__).parents[3] / "configs" / "blender" / "render_passes.py"
SCENE = """
import bpy, sys
bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.preferences.addon_enable(module="cycles")
scene = bpy.context.scene
scene.render.engine, scene.cycles.samples = "CYCLES", 4
scene.render.resolution_x, scene.render.resolution_y = 120, 80
scene.frame_start, scene.frame_end, scene.render.fps = 2, 4, 24
camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
camera.data.sensor_width = camera.data.lens = 36
camera.location = (0, 0, 10)
scene.collection.objects.link(camera)
scene.camera = camera
bpy.ops.mesh.primitive_plane_add(size=4)
plane = bpy.context.object
for frame in range(0, 8):
    plane.location = (0.1 * frame**2, 0.05 * frame, 0)
    plane.keyframe_insert("location", frame=frame)
bpy.ops.mesh.primitive_plane_add(size=60, location=(0, 0, -5))
bpy.ops.wm.save_as_mainfile(filepath=sys.argv[1])
"""


@pytest.mark.skipif(PYTHON is None, reason="BLENDER_PYTHON names no Python with bpy")
def test_vectors_depth_and_ids_are_those_of_the_scene(tmp_path):
    blend = tmp_path / "scene.blend"
    run = {"check": True, "capture_output": True}
    subprocess.run([PYTHON, "-c", SCENE, str(blend)], **run)
    subprocess.run([PYTHON, str(SCRIPT), str(blend), str(tmp_path / "out")], **run)
    lines = (tmp_path / "out" / "timestamps.txt").read_text().splitlines()
    times = [line.split()[0] for line in lines]
    assert times == ["0.000000000", "0.041666667", "0.083333333"]
    stack = open_fields(tmp_path / "out" / "motion", "motion")
    fields, blender = stack.read(1), CONVENTIONS["blender"]
    assert (stack.count, stack.convention) == (3, "blender")
    at = (40 - 2, 60 + 11)  # on the plane, whose centre is at (0.9, 0.15) m in frame 3
    for direction, way in (("forward", 12 * 0.7), ("backward", -12 * 0.5)):
        vectors = to_pixels(fields[direction], blender, direction, (120, 80))
        rise = -12 * 0.05 if direction == "forward" else 12 * 0.05
        assert vectors[at] == pytest.approx([way, rise], abs=0.01)
        assert vectors[5, 5] == pytest.approx([0, 0], abs=0.01)
    assert fields["depth"][at] == pytest.approx(10.0)
    assert fields["depth"][5, 5] == pytest.approx(15.0)
    ids = fields["instances"]
    assert ids[at] != ids[5, 5]
    assert set(np.unique(ids)) == {ids[at], ids[5, 5]}
    assert 0 not in ids
