"""Events drawn by matplotlib: one function for each kind of plot, which draws into axes."""
