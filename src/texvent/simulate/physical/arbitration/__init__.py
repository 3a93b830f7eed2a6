"""When events are read out: pixels wait for their row or for a scan."""
