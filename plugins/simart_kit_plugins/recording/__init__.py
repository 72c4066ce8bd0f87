"""A run as a rerun recording, one idea a file; `write.py` is the table of contents."""
