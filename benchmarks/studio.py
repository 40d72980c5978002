"""How long a slider waits for the studio's server: every preset on a walk of ten seconds, live and made safe.

Run: python benchmarks/studio.py

Each is asked for twice under another strength, so that nothing is remembered; the second counts. The budget
is 150 ms for what is on its way. Sizes are those of the answers.
"""

import tempfile
from pathlib import Path
from time import perf_counter

import numpy as np

from mien.emotion.presets import OWN
from mien.formats import bvh
from mien.render.wire import encode
from mien.samples import walk
from mien.studio.messages import EditRequest, Layer, Stack
from mien.studio.session import Session
from mien.studio.workspace import Workspace


def answer(session: Session, request: EditRequest) -> tuple[float, int]:
    """Return the milliseconds and bytes of one answer."""
    start = perf_counter()
    clip = session.clip(request.clip)
    after = session.edited(clip.id, request.stack, live=request.live)
    data = encode(after, clip.id, like=clip.figure)
    return 1e3 * (perf_counter() - start), len(data)


def main() -> None:
    with tempfile.TemporaryDirectory() as folder:
        session = Session(Workspace(Path(folder)))
        clip = session.open("walk.bvh", bvh.render(walk(seconds=10.0).motion)).id
        print("| preset | live, ms | safe, ms | kB |\n| --- | --- | --- | --- |")
        found = []
        for name in OWN:
            times = []
            for live in (True, False):
                for strength in (0.99, 1.0):
                    stack = Stack([Layer("1", "emotion", name, strength=strength)])
                    taken, size = answer(session, EditRequest(clip, stack, live))
                times.append(taken)
            found.append(times)
            print(f"| {name} | {times[0]:.0f} | {times[1]:.0f} | {size / 1000:.0f} |")
        middle, most = np.median(found, axis=0), np.max(found, axis=0)
        print(f"| median | {middle[0]:.0f} | {middle[1]:.0f} | |\n| most | {most[0]:.0f} | {most[1]:.0f} | |")


if __name__ == "__main__":
    main()
