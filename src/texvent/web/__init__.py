"""The web page: prompts and videos in the browser, events out."""
