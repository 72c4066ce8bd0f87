"""Judges: tools that others wrote, asked what they make of our exports. See docs/judges.md."""
