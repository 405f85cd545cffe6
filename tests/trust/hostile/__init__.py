"""Decks, sweep files and geometry files from somebody who means harm, or from nobody: made at random."""
