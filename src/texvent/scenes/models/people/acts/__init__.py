"""What people do at their own head, in the gym, in play, and with each other."""
