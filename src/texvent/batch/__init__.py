"""Many runs from a list: samples, what is done of them, and the processes that make them."""
