"""Still images: the busiest window, the contact sheet."""
