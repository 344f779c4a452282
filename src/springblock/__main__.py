"""The program `springblock`: commands of the package, and of the study."""

from springblock import study
from springblock.cli import COMMANDS, main

COMMANDS |= study.COMMANDS

if __name__ == "__main__":
    main(prog_name="springblock")
