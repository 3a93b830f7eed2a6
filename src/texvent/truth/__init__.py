"""Ground truth on disk, beside the events: optical flow, depth, ids, boxes, poses."""
