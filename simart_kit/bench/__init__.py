"""Scoring articulated objects against the truth: metrics, protocols, readers, runs and reports."""
