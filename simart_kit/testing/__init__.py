"""For plugin authors: contract classes, fake plugins and generated meshes."""
