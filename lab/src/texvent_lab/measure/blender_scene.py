"""A scene for Blender: a camera flies past pillars while a textured ball shoots across.

Run it with the Python that has bpy, or inside Blender:

    python lab/src/texvent_lab/measure/blender_scene.py scene.blend
    blender --background --python lab/src/texvent_lab/measure/blender_scene.py -- scene.blend

62 frames at 24 per second, 240x180. Every surface is textured and lit by one sun without a disc, so
that nothing but the edges depends on the number of samples: shadows are there, noise is not.
"""

from __future__ import annotations

import importlib
import math
import sys
from typing import Any

FRAMES, FPS, WIDTH, HEIGHT = 62, 24, 240, 180
KEY_EVERY = 3
"""Frames between keys; Blender's curves are smooth between them."""


def main(path: str) -> None:
    """Build the scene and store it at `path`."""
    bpy: Any = importlib.import_module("bpy")
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.preferences.addon_enable(module="cycles")
    scene = bpy.context.scene
    _set_up_render(scene)
    _light(bpy, scene)
    _still_things(bpy)
    _ball(bpy)
    _camera(bpy, scene)
    bpy.ops.wm.save_as_mainfile(filepath=path)


def _set_up_render(scene: Any) -> None:
    render = scene.render
    render.engine = "CYCLES"
    render.resolution_x, render.resolution_y, render.resolution_percentage = WIDTH, HEIGHT, 100
    render.fps = FPS
    scene.frame_start, scene.frame_end = 1, FRAMES
    scene.cycles.samples = 36
    scene.cycles.use_adaptive_sampling = scene.cycles.use_denoising = False
    scene.cycles.max_bounces = 0  # direct light only: no noise
    scene.cycles.seed, scene.cycles.use_animated_seed = 0, False


def _light(bpy: Any, scene: Any) -> None:
    sun = bpy.data.lights.new("sun", "SUN")
    sun.angle, sun.energy = 0.0, 3.0
    lamp = bpy.data.objects.new("sun", sun)
    lamp.rotation_euler = (math.radians(50), math.radians(12), math.radians(30))
    scene.collection.objects.link(lamp)
    world = bpy.data.worlds.new("world")
    world.use_nodes = True
    world.node_tree.nodes["Background"].inputs[0].default_value = (0.25, 0.33, 0.45, 1.0)
    scene.world = world


def _texture(
    bpy: Any, name: str, scale: float, dark: tuple[float, ...], bright: tuple[float, ...]
) -> Any:
    """A material: noise between two colours, lit, and a little light of its own in the shadows."""
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    nodes, links = material.node_tree.nodes, material.node_tree.links
    nodes.clear()
    place = nodes.new("ShaderNodeTexCoord")
    noise = nodes.new("ShaderNodeTexNoise")
    noise.inputs["Scale"].default_value, noise.inputs["Detail"].default_value = scale, 3.0
    ramp = nodes.new("ShaderNodeValToRGB")
    ramp.color_ramp.elements[0].position, ramp.color_ramp.elements[0].color = 0.35, (*dark, 1.0)
    ramp.color_ramp.elements[1].position, ramp.color_ramp.elements[1].color = 0.65, (*bright, 1.0)
    diffuse, glow = nodes.new("ShaderNodeBsdfDiffuse"), nodes.new("ShaderNodeEmission")
    glow.inputs["Strength"].default_value = 0.35
    both, output = nodes.new("ShaderNodeAddShader"), nodes.new("ShaderNodeOutputMaterial")
    links.new(place.outputs["Object"], noise.inputs["Vector"])
    links.new(noise.outputs["Fac"] if "Fac" in noise.outputs else noise.outputs[0], ramp.inputs[0])
    for shader in (diffuse, glow):
        links.new(ramp.outputs["Color"], shader.inputs["Color"])
    links.new(diffuse.outputs[0], both.inputs[0])
    links.new(glow.outputs[0], both.inputs[1])
    links.new(both.outputs[0], output.inputs["Surface"])
    return material


def _still_things(bpy: Any) -> None:
    floor = _texture(bpy, "floor", 1.1, (0.10, 0.09, 0.07), (0.55, 0.50, 0.40))
    wall = _texture(bpy, "wall", 0.7, (0.10, 0.13, 0.18), (0.50, 0.60, 0.70))
    pillar = _texture(bpy, "pillar", 2.0, (0.20, 0.06, 0.04), (0.80, 0.55, 0.40))
    bpy.ops.mesh.primitive_plane_add(size=60, location=(0, 0, 0))
    bpy.context.object.data.materials.append(floor)
    bpy.ops.mesh.primitive_plane_add(size=60, location=(0, 14, 0), rotation=(math.pi / 2, 0, 0))
    bpy.context.object.data.materials.append(wall)
    for x, y, height in ((-5.0, 6.0, 4.0), (-1.5, 3.5, 2.6), (2.4, 5.2, 3.4), (5.6, 2.6, 2.2)):
        bpy.ops.mesh.primitive_cube_add(size=1, location=(x, y, height / 2))
        thing = bpy.context.object
        thing.scale, thing.rotation_euler = (0.7, 0.7, height), (0, 0, 0.5 * x)
        thing.data.materials.append(pillar)


def _ball(bpy: Any) -> None:
    """Three bounces from left to right and back, turning as it flies."""
    bpy.ops.mesh.primitive_uv_sphere_add(segments=48, ring_count=24, radius=0.75)
    ball = bpy.context.object
    bpy.ops.object.shade_smooth()
    ball.data.materials.append(_texture(bpy, "ball", 2.6, (0.02, 0.05, 0.25), (0.95, 0.85, 0.15)))
    for frame in range(1 - KEY_EVERY, FRAMES + 2 * KEY_EVERY, KEY_EVERY):
        t = (frame - 1) / FPS
        ball.location = (
            5.5 * math.sin(3.4 * t - 1.2),
            1.4,
            0.9 + 1.5 * abs(math.sin(3.3 * t)) ** 1.5,
        )
        ball.rotation_euler = (0.6 * t, 2.0 * t, 0.0)
        ball.keyframe_insert("location", frame=frame)
        ball.keyframe_insert("rotation_euler", frame=frame)


def _camera(bpy: Any, scene: Any) -> None:
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    camera.data.lens, camera.data.sensor_width = 32.0, 36.0
    scene.collection.objects.link(camera)
    scene.camera = camera
    for frame in range(1 - KEY_EVERY, FRAMES + 2 * KEY_EVERY, KEY_EVERY):
        t = (frame - 1) / FPS
        camera.location = (-2.2 + 1.8 * t, -6.5 + 0.8 * t, 2.1 + 0.15 * math.sin(2.0 * t))
        camera.rotation_euler = (
            math.radians(84),
            0.02 * math.sin(3.0 * t),
            math.radians(-8 + 6 * t),
        )
        camera.keyframe_insert("location", frame=frame)
        camera.keyframe_insert("rotation_euler", frame=frame)


if __name__ == "__main__":
    words = sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else sys.argv[1:]
    main(words[0])
