"""V2CE: a published network, and its sampling of event times (LDATI)."""
