"""Kinds of things that files of the model stage register, and what the deck knows of them."""
