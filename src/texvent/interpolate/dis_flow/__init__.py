"""Dense inverse search: optical flow between the two frames of a pair."""
