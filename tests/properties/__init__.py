"""Properties that hold for every deck, on random ones."""
