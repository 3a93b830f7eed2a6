"""Speed measurements that anyone can rerun: `python -m texvent_lab.measure.NAME`."""
