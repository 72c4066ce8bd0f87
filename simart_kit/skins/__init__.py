"""Closed skins, as generative models deliver them, cut into the pieces that they seem to be made of."""
