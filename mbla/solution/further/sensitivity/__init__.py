"""How the associative load factor changes with parameters of the deck."""
