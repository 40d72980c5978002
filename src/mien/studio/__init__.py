"""The studio: a local page where a clip's mood is changed and seen at once, and the server behind it."""
