"""A simulated event camera beside a frame camera.

ros2 launch texvent_ros event_camera.launch.py image:=/camera/image_raw options:="--seed 3"
"""

import shlex

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, OpaqueFunction
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node

ARGUMENTS = {
    "namespace": ("event_camera", "Namespace of the node and of its topics."),
    "image": ("/camera/image_raw", "Topic of sensor_msgs/Image to read."),
    "frame_id": ("event_camera", "Coordinate frame of images that state none."),
    "options": ("", "More options of `texvent ros`, such as --contrast-threshold 0.2."),
}


def make_nodes(context):
    """The node, with the values of the arguments."""
    value = {name: LaunchConfiguration(name).perform(context) for name in ARGUMENTS}
    words = ["--image-topic", value["image"], "--frame-id", value["frame_id"]]
    return [
        Node(
            package="texvent_ros",
            executable="event_camera",
            name="texvent",
            namespace=value["namespace"],
            arguments=[*words, *shlex.split(value["options"])],
            output="screen",
        )
    ]


def generate_launch_description():
    """Arguments and the node."""
    declared = [
        DeclareLaunchArgument(name, default_value=default, description=text)
        for name, (default, text) in ARGUMENTS.items()
    ]
    return LaunchDescription([*declared, OpaqueFunction(function=make_nodes)])
