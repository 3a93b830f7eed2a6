"""`ros2 run texvent_ros event_camera`: the command `texvent ros` under a name of ROS."""

from __future__ import annotations

import sys

from texvent.cli.app import main as texvent


def main() -> int:
    """Run the node with the words of the command line."""
    return texvent(["ros", *sys.argv[1:]])


if __name__ == "__main__":
    sys.exit(main())
