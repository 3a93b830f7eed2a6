"""Call any diffusers text-to-video pipeline: by its own argument names, watched, interruptible."""

from __future__ import annotations

import contextlib
import inspect
from collections.abc import Iterator, Mapping
from fractions import Fraction
from pathlib import Path
from typing import Any

from texvent._require import require
from texvent.errors import ConfigError, InputError, TexventError, one_line
from texvent.generate.video_config import DiffusersConfig
from texvent.runtime.progress import Progress

EXTRA = "generate"
ARGUMENTS: Mapping[str, tuple[str, ...]] = {
    "frames": ("num_frames", "video_length", "frames"),
    "width": ("width",),
    "height": ("height",),
    "steps": ("num_inference_steps",),
    "guidance": ("guidance_scale",),
    "negative_prompt": ("negative_prompt",),
}
"""Option → what pipelines call it."""
RATE_ARGUMENTS = ("fps", "frame_rate")
SOUND = "sample_audio"
"""Switch of pipelines that can make sound as well, which no event shows."""
STEP_CALLBACK = "callback_on_step_end"
GUIDER = "guider"
"""Part of pipelines that holds the guidance scale, where the call does not take one."""
DISTILLED = "true_cfg_scale"
"""Argument of pipelines that make one pass, and follow no negative prompt, unless it is set."""


def call_pipeline(
    pipe: Any,
    prompt: Mapping[str, Any],
    config: DiffusersConfig,
    *,
    fps: Fraction,
    seed: int,
    output_type: str,
    progress: Progress,
) -> Any:
    """Run a pipeline once.

    Args:
        pipe: a diffusers pipeline.
        prompt: `{"prompt": text}`, or embeddings by the pipeline's argument names.
        config: options; those that are None are not passed.
        fps: passed where the model takes the rate as an input (it changes the pixels).
        seed: of a CPU generator, which gives the same noise on every device.
        output_type: "np" for frames [F, H, W, 3] float32 in 0..1, "latent" for latents.
        progress: receives every denoising step.

    Returns:
        The first result of the batch of one: frames, or the latent tensor with its batch axis.

    Raises:
        ConfigError: the pipeline does not take an option, or refuses its value.
        TexventError: the GPU's memory is too small.
    """
    accepted = check_options(type(pipe), config)
    arguments = {**_options(config, accepted), **prompt}
    if "prompt_embeds" in prompt:
        arguments.pop("negative_prompt", None)
    for name in RATE_ARGUMENTS:
        if name in accepted:
            arguments[name] = int(fps) if fps.denominator == 1 else float(fps)
    if SOUND in accepted:
        arguments[SOUND] = False
    if "image" in accepted:
        arguments.update(_image(config, accepted))
    if STEP_CALLBACK in accepted:
        arguments[STEP_CALLBACK] = _step_callback(progress)
    with _guided(pipe, config, accepted):
        output = _run(pipe, {**arguments, "output_type": output_type}, seed)
    return output if output_type == "latent" else output[0]


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
            is_taken |= GUIDER in inspect.signature(pipeline_class).parameters
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
        raise ConfigError(f"{name} starts from an image; give --image PATH")
    return accepted


def _run(pipe: Any, arguments: Mapping[str, Any], seed: int) -> Any:
    """The first result of a call."""
    torch = require("torch", extra=EXTRA)
    try:
        return pipe(
            **arguments, generator=torch.Generator("cpu").manual_seed(seed), return_dict=False
        )[0]
    except ValueError as error:
        raise ConfigError(
            f"{type(pipe).__name__} refuses the options: {one_line(error)}"
        ) from error
    except torch.OutOfMemoryError as error:
        raise TexventError(
            f"{type(pipe).__name__} does not fit into the GPU's memory; try --offload model or "
            "--offload sequential, --quantize 8bit, a smaller --width and --height, or fewer "
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
    values = {option: getattr(config, option) for option in ARGUMENTS}
    return {
        name: value
        for option, value in values.items()
        for name in ARGUMENTS[option]
        if value is not None and name in accepted
    }


@contextlib.contextmanager
def _guided(
    pipe: Any, config: DiffusersConfig, accepted: Mapping[str, inspect.Parameter]
) -> Iterator[None]:
    """Inside, the part that holds the guidance scale has the one that was asked for."""
    usual = getattr(pipe, GUIDER, None)
    if config.guidance is None or usual is None or "guidance_scale" in accepted:
        yield
        return
    pipe.guider = usual.new(guidance_scale=config.guidance)
    try:
        yield
    finally:
        pipe.guider = usual


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


def _step_callback(progress: Progress) -> Any:
    def report(pipe: Any, step: int, time: Any, tensors: dict[str, Any]) -> dict[str, Any]:
        del time
        progress.advance("denoise", step + 1, int(pipe.num_timesteps))
        return tensors

    return report
