"""Threads, prefetching, compilation, memory, signals and progress: what every stage runs on."""
