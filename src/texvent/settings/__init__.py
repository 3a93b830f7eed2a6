"""Settings of a run: presets, config files and options resolved; provenance of its outputs."""
