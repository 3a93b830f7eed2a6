"""Layouts rosbag1 and mcap: everything in one bag, on the topics that Kalibr expects.

    /cam0/events        dvs_msgs/EventArray (rosbag1), event_camera_msgs/EventPacket (mcap)
    /cam0/image_raw     sensor_msgs/Image, rgb8
    /cam0/camera_info   sensor_msgs/CameraInfo, with each frame (without frames: once)
    /imu0               sensor_msgs/Imu
    /groundtruth        geometry_msgs/PoseStamped of the IMU (without one: of the first camera)
    /texvent            std_msgs/String, what made it

Beside the bag lie calib.yaml, imu.yaml and rig.json.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

from texvent._require import require
from texvent.errors import ConfigError
from texvent.events import EventStream
from texvent.io.metadata import sidecar_text
from texvent.io.ros.bag_writer import (
    EXTENSIONS,
    BagKind,
    CameraFacts,
    SensorBag,
    open_sensor_bag,
)
from texvent.pipeline import Simulation
from texvent.run.files import OnStep
from texvent.runtime.progress import Progress
from texvent_scenes.rig.description import RigCamera
from texvent_scenes.rig.layouts.parts import (
    IMU_TOPIC,
    Tally,
    counted_frames,
    counter,
    image_topic,
    intrinsic_values,
    quaternions,
    write_calibration,
)
from texvent_scenes.rig.recording import Recording

LARGEST_EVT3 = 2048


def check(recording: Recording) -> None:
    """Refuse what a bag cannot hold.

    Raises:
        MissingDependencyError: rosbags is not installed.
        ConfigError: a sensor is too large for EVT3.
    """
    require("rosbags", extra="bags")
    for camera in recording.rig.cameras:
        if recording.config.layout == "mcap" and max(camera.size) > LARGEST_EVT3:
            raise ConfigError(
                f"{camera.name} is {camera.size}; EVT3, in which mcap holds events, ends at "
                f"{LARGEST_EVT3} pixels; choose layout rosbag1 or hdf5"
            )


def write(recording: Recording, folder: Path, tally: Tally, progress: Progress) -> None:
    """Everything but `rig.json`."""
    kind: BagKind = "mcap" if recording.config.layout == "mcap" else "rosbag1"
    with open_sensor_bag(folder / f"rig{EXTENSIONS[kind]}", kind) as bag:
        facts = {**recording.provenance(), "rig": recording.facts()}
        # As texvent's own bags, which read the first camera's events.
        bag.add_text(sidecar_text(recording.rig.cameras[0].size, facts), 0)
        for camera in recording.rig.cameras:
            simulation = recording.simulation(camera, progress)
            count = counter(simulation, camera, tally, progress)
            bag.add_events(f"/{camera.name}/events", _packets(simulation, count), camera.size)
            _add_frames(bag, recording, camera, tally, progress)
        if recording.imu is not None:
            imu = recording.imu
            bag.add_imu(IMU_TOPIC, "imu0", imu.t_us, imu.acceleration, imu.rate)
        place, turn = recording.poses()
        bag.add_poses("/groundtruth", "world", recording.pose_times, place, quaternions(turn))
    write_calibration(recording, folder)


def _packets(simulation: Simulation, count: OnStep) -> Iterator[EventStream]:
    for frame, packet in simulation.steps():
        count(frame, packet)
        yield packet


def _add_frames(
    bag: SensorBag, recording: Recording, camera: RigCamera, tally: Tally, progress: Progress
) -> None:
    def images() -> Iterator[tuple[int, Any]]:
        for frame in counted_frames(recording, camera, tally, progress):
            yield frame.t_us, frame.pixels

    times = recording.frame_times(camera)
    if times:
        bag.add_images(image_topic(camera), camera.name, images())
    bag.add_camera_info(
        f"/{camera.name}/camera_info", camera.name, _camera_facts(camera), times or [0]
    )


def _camera_facts(camera: RigCamera) -> CameraFacts:
    model, coefficients, (fx, fy, cx, cy) = intrinsic_values(camera)
    is_fisheye = model == "equidistant"
    return CameraFacts(
        camera.size,
        "equidistant" if is_fisheye else "plumb_bob",
        coefficients if is_fisheye else [*coefficients, 0.0],
        np.array([[fx, 0.0, cx], [0.0, fy, cy], [0.0, 0.0, 1.0]]),
    )
