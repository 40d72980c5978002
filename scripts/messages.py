"""Write ``frontend/src/messages.ts``: the studio's messages as TypeScript types, from Python's."""

import dataclasses
import sys
import types
from pathlib import Path
from typing import Any, Literal, Union, get_args, get_origin, get_type_hints

from mien.studio import messages

ROOT = Path(__file__).resolve().parents[1]
TARGET = ROOT / "frontend" / "src" / "messages.ts"
COMMAND = "python scripts/messages.py"
HEAD = f"// Made by `{COMMAND}` from src/mien/studio/messages.py; do not edit.\n"
PLAIN = {bool: "boolean", int: "number", float: "number", str: "string", type(None): "null", Any: "unknown"}


def typescript() -> str:
    """Return the TypeScript text of all messages."""
    found = [m for m in vars(messages).values() if dataclasses.is_dataclass(m)]
    return HEAD + "".join(_interface(message) for message in found)


def _interface(message: Any) -> str:
    hints = get_type_hints(message)
    summary = (message.__doc__ or "").split("\n")[0]
    fields = "".join(f"  {f.name}: {_type(hints[f.name])};\n" for f in dataclasses.fields(message))
    return f"\n/** {summary} */\nexport interface {message.__name__} {{\n{fields}}}\n"


def _type(hint: Any) -> str:
    """Return a Python type as TypeScript writes it."""
    if hint in PLAIN:
        return PLAIN[hint]
    if dataclasses.is_dataclass(hint):
        return str(hint.__name__)
    origin, inner = get_origin(hint), get_args(hint)
    if origin is Literal:
        return " | ".join(f'"{value}"' for value in inner)
    if origin in (Union, types.UnionType):
        return " | ".join(dict.fromkeys(_type(part) for part in inner))
    if origin is list:
        part = _type(inner[0])
        return f"({part})[]" if " | " in part else f"{part}[]"
    if origin is tuple:
        return f"[{', '.join(_type(part) for part in inner)}]"
    if origin is dict:
        return f"Record<{_type(inner[0])}, {_type(inner[1])}>"
    sys.exit(f"no TypeScript for {hint}")


if __name__ == "__main__":
    TARGET.write_text(typescript(), encoding="utf-8")
    print(TARGET.relative_to(ROOT))
