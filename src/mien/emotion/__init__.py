"""Emotion words and the recipes that stand for them."""
