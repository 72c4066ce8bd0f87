"""Built-in modifiers: small steps from Asset to Asset, one file each."""
