"""The ament_python package texvent_ros."""

from glob import glob

from setuptools import setup

PACKAGE = "texvent_ros"

setup(
    name=PACKAGE,
    version="0.1.0",
    packages=[PACKAGE],
    data_files=[
        ("share/ament_index/resource_index/packages", [f"resource/{PACKAGE}"]),
        (f"share/{PACKAGE}", ["package.xml"]),
        (f"share/{PACKAGE}/launch", glob("launch/*.launch.py")),
    ],
    install_requires=["setuptools", "texvent"],
    zip_safe=True,
    maintainer="The texvent authors",
    maintainer_email="maintainer@example.com",
    description="A simulated event camera: sensor_msgs/Image in, EventPacket out.",
    license="Apache-2.0",
    entry_points={"console_scripts": [f"event_camera = {PACKAGE}.node:main"]},
)
