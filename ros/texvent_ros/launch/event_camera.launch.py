"""A simulated event camera beside a frame camera.

ros2 launch texvent_ros event_camera.launch.py image:=/camera/image_raw parameters:=camera.yaml
"""

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, OpaqueFunction
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node

ARGUMENTS = {
    "namespace": ("event_camera", "Namespace of the node and of its topics."),
    "image": ("/camera/image_raw", "Topic of sensor_msgs/Image to read."),
    "frame_id": ("event_camera", "Coordinate frame of images that state none."),
    "parameters": ("", "YAML file with parameters of the node, such as contrast_threshold."),
}


def make_nodes(context):
    """The node, with the values of the arguments."""
    value = {name: LaunchConfiguration(name).perform(context) for name in ARGUMENTS}
    files = [value["parameters"]] if value["parameters"] else []
    return [
        Node(
            package="texvent_ros",
            executable="event_camera",
            name="texvent",
            namespace=value["namespace"],
            remappings=[("image_raw", value["image"])],
            parameters=[{"frame_id": value["frame_id"]}, *files],
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
