"""Event recordings changed: parts, other sizes, turned, filtered, merged, undistorted.

Functions take an `EventStream` or `EventPackets` and return the same kind. Packets stream by:
nothing is read until the result is iterated, and memory stays flat.
"""
