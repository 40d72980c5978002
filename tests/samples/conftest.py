"""Where the joints of a sample are, by role."""

from collections.abc import Callable

import numpy as np
import pytest

from mien.kinematics.fk import world
from mien.samples import Sample


@pytest.fixture(scope="session")
def places() -> Callable[[Sample], dict[str, np.ndarray]]:
    """A function from a sample to the place (T, 3) of each role's joint, in the clip's unit and axes."""

    def measure(sample: Sample) -> dict[str, np.ndarray]:
        names, positions = sample.motion.skeleton.names, world(sample.motion)[1]
        return {role: positions[:, names.index(name)] for role, name in sample.roles.items()}

    return measure
