"""Events of one interval, from unsorted columns to a sorted packet."""
