"""Metrics: pure functions, each with its formula, unit and source; protocols choose among them."""
