"""Where the parts of one welded skin end: moved to creases and seams, and cut through large faces."""
