"""Acts in contact: holding, wearing, riding, pushing, kicking, throwing, colliding."""
