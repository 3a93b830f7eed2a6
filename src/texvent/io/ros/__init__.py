"""ROS bags and MCAP."""
