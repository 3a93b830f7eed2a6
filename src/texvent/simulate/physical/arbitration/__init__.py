"""Who reads events out, and when: pixels wait for their row or for a scan."""
