"""Surfaces made by numbers and dice: what generated objects are built of."""
