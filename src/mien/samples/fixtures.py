"""Motions whose every number is known in closed form, for testing signal processing."""

from dataclasses import replace
from typing import Unpack

import numpy as np

from ..rotations import quaternion
from .gestures import REST, statue
from .pose import Figure, about, build
from .sample import Form, Sample, Truth, sample, times


def pendulum(
    *, seconds: float = 4.0, amplitude: float = 0.5, frequency: float = 1.0, **form: Unpack[Form]
) -> Sample:
    """Swing the straight right arm from the shoulder: ``amplitude sin(2 pi frequency t)`` radians."""
    t = times(seconds, form)
    swing = amplitude * np.sin(2.0 * np.pi * frequency * t)
    pose, contacts = statue(t)
    straight = replace(REST, flexion=swing, abduction=0.0, rotation=0.0, elbow=0.0)
    figure, angles = build(replace(pose, arms={"left": REST, "right": straight}))
    facts = {"amplitude": amplitude, "frequency": frequency}
    return sample("pendulum", figure, Truth(contacts, angles, facts=facts), **form)


def spin(*, seconds: float = 2.0, rate: float = 2.0 * np.pi, **form: Unpack[Form]) -> Sample:
    """Turn the stiff body about the vertical at ``rate`` radians a second: 720 degrees in two seconds.

    Nothing is planted: the figure turns as if on a plate.
    """
    t = times(seconds, form)
    pose, contacts = statue(t)
    figure, angles = build(pose)
    plate = about(1, rate * t)
    rotations = quaternion.multiply(plate[:, None], figure.rotations)
    turned = Figure(rotations, quaternion.rotate(plate, figure.hips))
    truth = Truth(np.zeros_like(contacts), angles | {"heading": rate * t}, facts={"heading_rate": rate})
    return sample("spin", turned, truth, **form)
