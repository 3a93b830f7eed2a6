"""What sets people of a trade, a sport or an age apart: hats, garments, what they hold."""
