"""Every error has a stable identifier, a test with its exact text and place, and an entry in ``mbla explain``."""
