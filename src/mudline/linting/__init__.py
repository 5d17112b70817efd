"""Rules over a deck and its scene, and the forms in which their findings are told."""
