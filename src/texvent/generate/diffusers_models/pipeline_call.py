"""Call any diffusers text-to-video pipeline: by its own argument names, watched, interruptible."""

from __future__ import annotations

import inspect
from collections.abc import Mapping
from fractions import Fraction
from pathlib import Path
from typing import Any

from texvent._require import require
from texvent.errors import ConfigError, InputError, TexventError, one_line
from texvent.generate.diffusers_models.call_adjustments import SIGMAS, adjusted, has_guider
from texvent.generate.diffusers_models.pipeline_loading import TILED_ONLY
from texvent.generate.video_config import DiffusersConfig
from texvent.generate.video_models.known_models import VideoModel
from texvent.generate.videos.reference_video import read_reference
from texvent.runtime.progress import Progress

EXTRA = "generate"
PYRAMID_STEPS = "pyramid_num_inference_steps_list"
"""Steps at each of several sizes, small to large."""
ARGUMENTS: Mapping[str, tuple[str, ...]] = {
    "frames": ("num_frames", "video_length", "frames"),
    "width": ("width",),
    "height": ("height",),
    "steps": ("num_inference_steps", PYRAMID_STEPS),
    "guidance": ("guidance_scale",),
    "negative_prompt": ("negative_prompt",),
}
"""Option → what pipelines call it."""
RATE_ARGUMENTS = ("fps", "frame_rate")
SOUND = "sample_audio"
"""Switch of pipelines that can make sound as well, which no event shows."""
DISTILLED = "true_cfg_scale"
"""Argument of pipelines that make one pass, and follow no negative prompt, unless it is set."""
REFERENCE_CLASSES: Mapping[str, tuple[str, str]] = {
    "LTX2HDRPipeline": (
        "diffusers.pipelines.ltx2.pipeline_ltx2_hdr_lora",
        "LTX2HDRReferenceCondition",
    ),
}
"""Pipelines that follow a video → module and class that hand it over."""
FRAME_DIMENSIONS = 4
"""Of one video, [F, H, W, 3]; most pipelines return a batch of them."""


def call_pipeline(
    pipe: Any,
    prompt: Mapping[str, Any],
    config: DiffusersConfig,
    *,
    model: VideoModel,
    fps: Fraction,
    generator: Any,
    output_type: str,
    progress: Progress,
) -> tuple[Any, ...]:
    """Run a pipeline once.

    Args:
        pipe: a diffusers pipeline.
        prompt: `{"prompt": text}`, or embeddings by the pipeline's argument names.
        config: options; those that are None are not passed.
        model: its row, with what the call needs beside them.
        fps: passed where the model takes the rate as an input (it changes the pixels).
        generator: torch's, of the CPU, which gives the same noise on every device.
        output_type: "np" for frames [F, H, W, 3] float32 in 0..1, "latent" for latents.
        progress: receives every denoising step.

    Returns:
        All results; the first is the frames of the batch of one, or the latent tensor with its
        batch axis.

    Raises:
        ConfigError: the pipeline does not take an option, or refuses its value.
        TexventError: the GPU's memory is too small.
    """
    accepted = check_options(type(pipe), config)
    _check_tiles(pipe, config)
    # Other step counts have no levels of their own: the pipeline's schedule gives them.
    sigmas = model.sigmas if config.steps in (None, len(model.sigmas or ())) else None
    arguments = {**model.call, **_options(config, accepted), **prompt}
    if sigmas is not None and SIGMAS in accepted:
        arguments[SIGMAS] = list(sigmas)
    if "prompt_embeds" in prompt:
        arguments.pop("negative_prompt", None)
    for name in RATE_ARGUMENTS:
        if name in accepted:
            arguments[name] = int(fps) if fps.denominator == 1 else float(fps)
    if SOUND in accepted:
        arguments[SOUND] = False
    if "image" in accepted:
        arguments.update(_image(config, accepted))
    if config.reference_video is not None:
        arguments["reference_conditions"] = [_reference(pipe, config.reference_video, arguments)]
    arguments |= {"output_type": output_type, "generator": generator}
    # A schedule of another class than the pipeline's may add noise that the pipeline seeds not.
    noise = generator if "class" in model.scheduler else None
    with adjusted(
        pipe, accepted, progress, guidance=config.guidance, sigmas=sigmas, generator=noise
    ):
        first, *others = run_pipeline(pipe, arguments)
    is_batch = output_type != "latent" and first.ndim > FRAME_DIMENSIONS
    return first[0] if is_batch else first, *others


def check_options(pipeline_class: type, config: DiffusersConfig) -> Mapping[str, inspect.Parameter]:
    """Refuse options that the pipeline does not take; nothing has to be loaded for that.

    Returns:
        Name → parameter of its call.

    Raises:
        ConfigError: an option is set that it does not take, or one is missing that it needs.
    """
    accepted = inspect.signature(pipeline_class.__call__).parameters
    name = pipeline_class.__name__
    for option, names in ARGUMENTS.items():
        is_taken = bool(set(names) & set(accepted))
        if option == "guidance":
            is_taken |= has_guider(pipeline_class)
        if getattr(config, option) is not None and not is_taken:
            raise ConfigError(f"{option} is set, but {name} does not take it")
    if config.negative_prompt is not None and DISTILLED in accepted:
        raise ConfigError(
            f"negative_prompt is set, but {name} is distilled to one pass, which follows none"
        )
    if config.image is not None and "image" not in accepted:
        raise ConfigError(f"image is set, but {name} starts from text alone")
    image = accepted.get("image")
    if image is not None and image.default is inspect.Parameter.empty and config.image is None:
        raise ConfigError(f"{name} starts from an image; give image=PATH")
    check_reference(name, config)
    return accepted


def check_reference(pipeline: str, config: DiffusersConfig) -> None:
    """Refuse a reference video that a pipeline cannot follow, or that it lacks.

    Args:
        pipeline: name of the diffusers class.
        config: its `reference_video` is looked at; the file is not.

    Raises:
        ConfigError: see above.
    """
    follows = pipeline in REFERENCE_CLASSES
    if config.reference_video is not None and not follows:
        raise ConfigError(f"reference_video is set, but {pipeline} follows none")
    if config.reference_video is None and follows:
        raise ConfigError(f"{pipeline} follows a video; give reference_video=FILE")


def _check_tiles(pipe: Any, config: DiffusersConfig) -> None:
    """Refuse sizes of which a decoder that knows only whole tiles would leave a part black.

    Raises:
        ConfigError: frames or size are not made of whole tiles.
    """
    if type(getattr(pipe, "vae", None)).__name__ not in TILED_ONLY:
        return
    for option, tile, stride in zip(
        ("frames", "height", "width"), pipe.vae.kernel, pipe.vae.stride, strict=True
    ):
        value = getattr(config, option)
        if value is not None and (value < tile or (value - tile) % stride):
            raise ConfigError(
                f"{option} is {value}, of which {type(pipe).__name__} would leave a part black; "
                f"allowed: {tile}, {tile + stride}, {tile + 2 * stride}, ..."
            )


def run_pipeline(pipe: Any, arguments: Mapping[str, Any]) -> tuple[Any, ...]:
    """The results of a call.

    Raises:
        ConfigError: the pipeline refuses an argument.
        TexventError: the GPU's memory is too small.
    """
    torch = require("torch", extra=EXTRA)
    try:
        return tuple(pipe(**arguments, return_dict=False))
    except ValueError as error:
        raise ConfigError(
            f"{type(pipe).__name__} refuses the options: {one_line(error)}"
        ) from error
    except torch.OutOfMemoryError as error:
        raise TexventError(
            f"{type(pipe).__name__} does not fit into the GPU's memory; try offload='model' or "
            "offload='sequential', quantize='8bit', a smaller `width` and `height`, or fewer "
            "--frames"
        ) from error
    finally:
        # Also after Ctrl-C: parts that are offloaded go back, so that the next prompt can run.
        pipe.maybe_free_model_hooks()


def default_guidance(pipe: Any, config: DiffusersConfig) -> float:
    """The guidance scale that a call will use."""
    if config.guidance is not None:
        return config.guidance
    default = inspect.signature(pipe.__call__).parameters["guidance_scale"].default
    return float(default)


def _options(config: DiffusersConfig, accepted: Mapping[str, inspect.Parameter]) -> dict[str, Any]:
    """The options that are set, by the names that a call accepts."""
    arguments = {
        name: getattr(config, option)
        for option, names in ARGUMENTS.items()
        for name in names
        if getattr(config, option) is not None and name in accepted
    }
    if PYRAMID_STEPS in arguments:
        arguments[PYRAMID_STEPS] = _spread(arguments[PYRAMID_STEPS], accepted[PYRAMID_STEPS])
    return arguments


def _spread(steps: int, parameter: inspect.Parameter) -> list[int]:
    """Steps for each size of a pyramid, at least one, together `steps` or a little more."""
    return [-(-steps // len(parameter.default))] * len(parameter.default)


def _image(config: DiffusersConfig, accepted: Mapping[str, inspect.Parameter]) -> dict[str, Any]:
    """The image to start from, its middle cut to the video's shape and resized to its size."""
    if config.image is None:
        return {}
    image = read_image(config.image)
    size = [
        getattr(config, name) or (accepted[name].default if name in accepted else None)
        for name in ("width", "height")
    ]
    if all(isinstance(side, int) for side in size):
        image = require("PIL.ImageOps", extra=EXTRA).fit(image, tuple(size))
    return {"image": image}


def _reference(pipe: Any, path: Path, arguments: Mapping[str, Any]) -> Any:
    """The frames to follow, each with its middle cut to the video's shape and resized to its size.

    As many as the pipeline makes of the frames that it is asked for.
    """
    images, operations = (require(f"PIL.{name}", extra=EXTRA) for name in ("Image", "ImageOps"))
    defaults = inspect.signature(type(pipe).__call__).parameters
    frames, *size = (
        arguments.get(name, defaults[name].default) for name in ("num_frames", "width", "height")
    )
    stride = pipe.vae_temporal_compression_ratio
    fitted = [
        operations.fit(images.fromarray(pixels), tuple(size))
        for pixels in read_reference(path, (frames - 1) // stride * stride + 1)
    ]
    module, name = REFERENCE_CLASSES[type(pipe).__name__]
    return getattr(require(module, extra=EXTRA), name)(frames=fitted, strength=1.0)


def read_image(path: Path) -> Any:
    """An image as PIL's RGB image, turned as its camera noted.

    Raises:
        InputError: it is not there, or no image.
        MissingDependencyError: Pillow is not installed.
    """
    images, operations = (require(f"PIL.{name}", extra=EXTRA) for name in ("Image", "ImageOps"))
    if not path.is_file():
        raise InputError(f"there is no image {path}")
    try:
        with images.open(path) as opened:
            return operations.exif_transpose(opened).convert("RGB")
    except (OSError, ValueError, SyntaxError, images.DecompressionBombError) as error:
        raise InputError(f"{path} cannot be read as an image ({one_line(error)})") from error
