"""Results in words: the listing, what the terminal shows, and the sentences and tables that both are made of."""
