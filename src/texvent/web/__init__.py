"""Local web pages, which only this machine can reach: events made, events live."""
