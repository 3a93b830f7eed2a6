"""`texvent ros`: a ROS 2 node that turns images into event packets."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, ClassVar

from texvent.cli.command import resolve_command
from texvent.cli.options import peek_options
from texvent.cli.run import print_settings
from texvent.cli.subject import read_subject
from texvent.errors import ConfigError
from texvent.options.fields import option_names
from texvent.ros.config import RosConfig
from texvent.run.prepare import prepare_prompt, prepare_source
from texvent.runtime.displays.console_progress import ConsoleProgress

DESCRIPTION = """A ROS 2 node: sensor_msgs/Image in, event_camera_msgs/EventPacket (evt3) out.

  texvent ros --image-topic camera/image_raw --contrast-threshold 0.2
  texvent ros --prompt "a dog runs" --ros-args -r events:=/dvs/events

Words after --ros-args go to ROS. rclpy comes with ROS 2: source its setup.bash first."""
ROS_ARGS = "--ros-args"


@dataclass(frozen=True, kw_only=True)
class RosOptions(RosConfig):
    """What is read, and how it is published."""

    input_texts: ClassVar[tuple[str, ...]] = ("source",)
    positional: ClassVar[tuple[str, ...]] = ("source",)
    main_options: ClassVar[tuple[str, ...]] = (
        "prompt", "image_topic", "events_topic", "view_topic", "stamps", "rate", "loop", "sensor",
        "simulator", "contrast_threshold", "noise", "interpolate", "seed", "config",
    )  # fmt: skip

    source: str | None = None
    """Video file, image folder or camera to publish; without it and without --prompt, the images of
    a topic."""
    prompt: str | None = None
    """Publish the scene that this describes."""

    def node_config(self) -> RosConfig:
        """The options of the node alone."""
        return RosConfig(**{name: getattr(self, name) for name in option_names(RosConfig)})


@dataclass(frozen=True, kw_only=True)
class RosOutputOptions:
    """Options from a file."""

    config: Path | None = None
    """TOML or YAML file with options of the simulation; flags override it."""
    print_config: bool = False
    """Print all resolved options of the simulation as TOML, ready for --config, and stop."""


def run(arguments: Sequence[str]) -> int:
    """Run the command; returns its exit code."""
    words, ros_words = split_ros_arguments(arguments)
    is_prompt = peek_options(words, ("prompt",))["prompt"] is not None
    settings, own, output = resolve_command(
        "generate" if is_prompt else "simulate",
        words,
        RosOptions(),
        description=DESCRIPTION,
        prog="texvent ros",
        output=RosOutputOptions(),
    )
    if output.print_config:
        return print_settings(settings)
    if own.source is not None and own.prompt is not None:
        raise ConfigError("a video and --prompt are both given; one of them is published")
    from texvent.ros.node import Ros, run_image_node, run_source_node

    config = own.node_config()
    ros = Ros()  # before long work: says what is missing
    if own.source is None and own.prompt is None:
        return run_image_node(ros, settings, config, ros_words)
    with ConsoleProgress(is_quiet=config.quiet) as progress:
        simulation: Any
        if own.prompt is not None:
            simulation = prepare_prompt(
                read_subject(own.prompt, getattr(settings.source, "assets", None)),
                settings,
                progress=progress,
            )
        else:
            simulation = prepare_source(own.source, settings, progress=progress)
    return run_source_node(ros, simulation, config, ros_words)


def split_ros_arguments(arguments: Sequence[str]) -> tuple[list[str], list[str]]:
    """The words of texvent, and those of ROS from `--ros-args` to the end or to `--`.

    Example:
        >>> split_ros_arguments(["clip.mp4", "--ros-args", "-r", "a:=b", "--", "--loop"])
        (['clip.mp4', '--loop'], ['--ros-args', '-r', 'a:=b'])
    """
    words = list(arguments)
    if ROS_ARGS not in words:
        return words, []
    start = words.index(ROS_ARGS)
    stop = words.index("--", start) if "--" in words[start:] else len(words)
    return words[:start] + words[stop + 1 :], words[start:stop]
