"""A page that shows how well a fitted model agrees with its recording."""
