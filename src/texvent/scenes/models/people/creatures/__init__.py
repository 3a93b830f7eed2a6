"""Animals and toys that stand upright and do what people do, on a person's joints."""
