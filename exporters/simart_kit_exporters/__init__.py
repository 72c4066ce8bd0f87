"""Built-in exporters, one format a file."""
