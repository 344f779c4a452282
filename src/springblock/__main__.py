"""python -m springblock"""

from springblock.cli import main

main(prog_name="springblock")
