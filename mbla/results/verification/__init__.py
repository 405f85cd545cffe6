"""What ``mbla verify`` holds against the deck in a file beside its figures: what is asked for, and what is remarked."""
