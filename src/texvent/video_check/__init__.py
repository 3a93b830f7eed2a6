"""Check of a video before it becomes events: measurements of one pass, limits and advice."""
