"""What the reader knows."""
