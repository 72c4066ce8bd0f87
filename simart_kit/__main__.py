"""`python -m simart_kit`."""

from .cli import main

if __name__ == "__main__":
    main()
