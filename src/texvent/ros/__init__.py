"""ROS 2: images of a topic become packets of events on another one."""
