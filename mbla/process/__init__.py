"""What concerns the process that a run lives in: threads, memory, signals, time, what decks share."""
