"""Foot contacts: when which foot stands on the floor."""
