"""Start the studio that is installed, ask it for its page and for an edit, and end it: a smoke run."""

import json
import subprocess
import sys
import tempfile
import urllib.request
from typing import Any


def main() -> None:
    """Raise where anything is not as it should be."""
    with tempfile.TemporaryDirectory() as folder:
        command = [sys.executable, "-m", "mien", "studio", "--no-browser", "--workspace", folder]
        child = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
        try:
            assert child.stdout
            base, token = child.stdout.readline().strip().split("/#token=")

            def ask(path: str, message: Any = None) -> bytes:
                data = None if message is None else json.dumps(message).encode()
                headers = {"Authorization": f"Bearer {token}", "Content-Type": "application/json"}
                request = urllib.request.Request(base + path, data, headers)
                with urllib.request.urlopen(request, timeout=60) as answer:
                    return bytes(answer.read())

            page = ask("/").decode()
            script = page.split('src="./')[1].split('"')[0]
            assert len(ask(f"/{script}")) > 10_000, "the page's script is there"
            clip = json.loads(ask("/api/samples/walk", {}))["id"]
            stack = {"layers": [{"id": "1", "kind": "emotion", "name": "sad"}]}
            assert ask("/api/edit", {"clip": clip, "stack": stack}).startswith(b"MIEN")
            print(f"studio: page of {len(page)} bytes, {script}, an edit was made")
        finally:
            child.terminate()
            child.wait(timeout=30)


if __name__ == "__main__":
    main()
