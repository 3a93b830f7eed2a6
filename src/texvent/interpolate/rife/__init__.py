"""RIFE: intermediate frames by a published network."""
