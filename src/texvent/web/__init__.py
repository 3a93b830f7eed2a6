"""Local web page: prompts and videos in, events out; only this machine can reach it."""
