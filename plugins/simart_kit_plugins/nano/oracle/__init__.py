"""The oracle ladder: what is lost where between a mesh and its joints, one true thing replaced a step."""
