"""Pictures of a motion: a mannequin in strips, GIF and video."""
