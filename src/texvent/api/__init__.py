"""Public functions, the event camera that is given frames one by one, and lists of names."""
