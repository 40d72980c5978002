"""``python -m mien`` is ``mien``."""

from .cli import main

if __name__ == "__main__":
    main()
