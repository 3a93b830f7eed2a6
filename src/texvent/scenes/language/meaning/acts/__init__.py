"""What the objects of a clause do: motions, activities, acts on other objects."""
