"""Real articulated objects with ground truth, made from what public packages hold; see __main__.py."""
