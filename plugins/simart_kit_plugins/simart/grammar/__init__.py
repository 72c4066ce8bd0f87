"""Decoding under a grammar: output that is not valid cannot be written."""
