"""How `render` makes a picture: rays, surfaces, light; and the sheet that `write_preview` writes."""
