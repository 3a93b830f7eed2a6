"""Loading of stored samples: by number, in any order, from any process."""
