"""Speed against accuracy on one deck: ladder of settings -> runs -> distances from a reference -> front, advice."""
