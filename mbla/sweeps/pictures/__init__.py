"""Pictures of a sweep, one kind per file."""
