"""Styles: many versions of one motion at once, and whatever lies between them."""
