"""Event recordings changed as they stream by: cut in space and time, resized, merged, undistorted.

Each function takes and returns `EventPackets`, reads nothing until the result is iterated, and
keeps memory flat.
"""
