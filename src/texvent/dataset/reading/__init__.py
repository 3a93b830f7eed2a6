"""Reading of stored data sets: folder, records, events."""
