"""The law of elastic joints, and one implicit step of it."""
