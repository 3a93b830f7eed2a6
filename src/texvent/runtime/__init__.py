"""Threads, prefetching, compilation, memory and signals: what every stage runs on."""
