"""The numerical hearts of the simulators: a readable reference and fast equals of it."""
