"""How close one event stream is to another: `compare`, and one file per family of metrics."""
