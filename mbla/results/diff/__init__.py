"""What differs between two results; ``mbla diff`` shows it."""
