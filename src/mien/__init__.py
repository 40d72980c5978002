"""Edit what a captured human motion expresses."""
