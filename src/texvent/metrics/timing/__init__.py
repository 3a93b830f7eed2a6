"""Metrics of event times: batches, cadence, soundness of a recording."""
