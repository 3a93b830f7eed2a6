"""Threads, devices, compilation, memory, progress; work beside the main path; files; displays."""
