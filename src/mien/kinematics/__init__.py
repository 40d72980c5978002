"""Skeletons in space: forward and inverse kinematics, body roles, contacts."""
