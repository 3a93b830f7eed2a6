"""How a rig's recording is laid out in its folder."""
