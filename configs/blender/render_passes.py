"""Render a .blend with the passes that texvent needs; run by Blender, never imported by texvent.

    blender --background scene.blend --python render_passes.py -- OUT
    python render_passes.py scene.blend OUT            (a Python with bpy)

    OUT/frames/000001.exr     Combined: linear light, float32
    OUT/motion/000001.exr     Vector, Depth and Object Index at the centre of every pixel
    OUT/timestamps.txt        time in s and name of every frame

`texvent simulate OUT` takes this folder. The passes are rendered once more with one sample at the
pixel's centre: those of an ordinary render are averages over the pixel (Vector) or of a random
place in it (Depth, Object Index). Objects without an index get one, counted from 1.

Options after `--` (or after the names): --start, --end (frames), --fps (of the film that is made:
the scene moves as fast as before, in more or fewer frames), --samples, --width, --height.

This file needs nothing but Blender (2.93 or newer) and its Python.
"""

from __future__ import annotations

import argparse
import importlib
import os
import sys
from typing import Any

DATA_PASSES = ("use_pass_vector", "use_pass_z", "use_pass_object_index")


def main(words: list[str]) -> None:
    """Render; `words` are the arguments."""
    bpy: Any = importlib.import_module("bpy")
    is_inside = "--" in words  # `blender --background scene.blend --python this -- OUT`
    options = _read(words[words.index("--") + 1 :] if is_inside else words, is_inside)
    if not is_inside:
        bpy.ops.wm.open_mainfile(filepath=os.path.abspath(options.blend))
    scene = bpy.context.scene
    _check(scene)
    _set_up(scene, options)
    number_objects(scene)
    numbers, fps = _frames(scene, options)
    _write_times(options.out, len(numbers), fps)
    for index, number in enumerate(numbers):
        scene.frame_set(number)
        for folder, prepare in (("frames", _for_colour), ("motion", _for_data)):
            path = os.path.join(options.out, folder, f"{index + 1:06d}.exr")
            if not os.path.exists(path):  # a stopped render goes on where it stopped
                prepare(scene, options)
                _render(bpy, scene, path)


def _read(words: list[str], is_inside: bool) -> Any:
    parser = argparse.ArgumentParser(prog="render_passes.py", description=__doc__.split("\n")[0])
    if not is_inside:
        parser.add_argument("blend", help="the .blend file")
    parser.add_argument("out", help="folder to make")
    parser.add_argument("--start", type=int, help="first frame, counted as in the .blend")
    parser.add_argument("--end", type=int, help="last frame, counted as in the .blend")
    parser.add_argument("--fps", type=int, help="frames per second of the film that is made")
    parser.add_argument("--samples", type=int, help="samples of a pixel's colour")
    parser.add_argument("--width", type=int)
    parser.add_argument("--height", type=int)
    return parser.parse_args(words)


def _check(scene: Any) -> None:
    if scene.camera is None:
        sys.exit("the scene has no camera; add one in Blender")
    if scene.render.engine != "CYCLES":
        sys.exit(
            f"the scene renders with {scene.render.engine}; its Vector pass is known for CYCLES"
        )


def _set_up(scene: Any, options: Any) -> None:
    render = scene.render
    render.use_motion_blur = False  # an event camera has no exposure; blur also mixes the passes
    render.use_compositing = render.use_sequencer = False
    render.resolution_percentage = 100
    render.resolution_x = options.width or render.resolution_x
    render.resolution_y = options.height or render.resolution_y
    scene.cycles.use_denoising = scene.cycles.use_adaptive_sampling = False
    scene.cycles.use_animated_seed = False  # noise that changes with every frame makes events
    options.filter = (scene.cycles.pixel_filter_type, scene.cycles.filter_width)
    options.samples = options.samples or scene.cycles.samples


def number_objects(scene: Any) -> None:
    """Give every object without an index (Object Properties, Relations) one of its own."""
    used = {one.pass_index for one in scene.objects}
    free = (number for number in range(1, len(used) + len(scene.objects) + 1) if number not in used)
    for one in scene.objects:
        if one.pass_index == 0:
            one.pass_index = next(free)


def _frames(scene: Any, options: Any) -> tuple[list[int], float]:
    """The frames to render, in the numbers of the film that is made, and its rate."""
    render = scene.render
    fps = render.fps / render.fps_base
    first = scene.frame_start if options.start is None else options.start
    last = scene.frame_end if options.end is None else options.end
    if options.fps is None or options.fps == fps:
        return list(range(first, last + 1)), fps
    if render.fps_base != 1.0 or not (render.fps <= 900 and options.fps <= 900):
        sys.exit("--fps needs whole rates up to 900, of the .blend too")
    render.frame_map_old, render.frame_map_new = render.fps, options.fps
    ratio = options.fps / render.fps
    return list(range(round(first * ratio), round(last * ratio) + 1)), float(options.fps)


def _write_times(out: str, count: int, fps: float) -> None:
    os.makedirs(out, exist_ok=True)
    with open(os.path.join(out, "timestamps.txt"), "w", encoding="utf-8") as file:
        file.writelines(f"{i / fps:.9f} frames/{i + 1:06d}.exr\n" for i in range(count))


def _for_colour(scene: Any, options: Any) -> None:
    scene.cycles.samples = options.samples
    scene.cycles.pixel_filter_type, scene.cycles.filter_width = options.filter
    _pass(scene, False)
    _exr(scene.render.image_settings, "OPEN_EXR", "IMAGE", "RGB")


def _for_data(scene: Any, options: Any) -> None:
    scene.cycles.samples = 1
    scene.cycles.pixel_filter_type, scene.cycles.filter_width = "BOX", 0.01
    _pass(scene, True)
    _exr(scene.render.image_settings, "OPEN_EXR_MULTILAYER", "MULTI_LAYER_IMAGE", "RGBA")


def _pass(scene: Any, is_on: bool) -> None:
    for layer in scene.view_layers:
        for name in DATA_PASSES:
            setattr(layer, name, is_on)
        layer.use_pass_combined = not is_on


def _exr(settings: Any, name: str, medium: str, colours: str) -> None:
    if hasattr(settings, "media_type"):  # Blender 5
        settings.media_type = medium
    settings.file_format = name
    settings.color_mode, settings.color_depth, settings.exr_codec = colours, "32", "ZIP"


def _render(bpy: Any, scene: Any, path: str) -> None:
    """Render into a file that appears under its name when it is complete."""
    part = path.removesuffix(".exr") + ".part.exr"
    scene.render.filepath = os.path.abspath(part)
    bpy.ops.render.render(write_still=True)
    os.replace(part, path)


if __name__ == "__main__":
    main(sys.argv[1:])
