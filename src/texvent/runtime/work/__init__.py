"""Work beside the main path: threads that make or write ahead, engines of tasks, signals."""
