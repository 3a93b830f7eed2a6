"""Models of what stands in streets, gardens and landscapes, and in the sky."""
