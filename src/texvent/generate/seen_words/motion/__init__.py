"""Whether what moves is seen to do what its verbs say."""
