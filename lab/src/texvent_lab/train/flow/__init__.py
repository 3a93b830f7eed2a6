"""Optical flow from events: EV-FlowNet trained with exact flow; E-RAFT from its published file."""
