"""Styles: several clips make a new one, and whatever lies between many versions of one clip."""
