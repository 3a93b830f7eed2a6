"""Stage 3, dense frames → events: pixel models behind one protocol."""
