"""Every command is found by its name and says what it does."""

import re
import subprocess
import sys

import pytest

from springblock.cli import COMMANDS


@pytest.mark.parametrize("command", COMMANDS)
def test_a_command_explains_itself(springblock, command):
    assert re.search(rf"^  {command} +[A-Z]\w+ ", springblock("--help"), re.MULTILINE)
    assert springblock(command, "--help").startswith(f"Usage: main {command} ")


def test_an_unknown_command_is_refused_by_name(springblock):
    assert "No such command 'slide'" in springblock("slide", refused=True)


EXTRAS = [
    "jinja2",
    "jsonschema",
    "markdown_it",
    "pandas",
    "rocrate",
    "seaborn",
    "snakemake",
    "yaml",
]


def test_help_needs_no_extra():
    """Every command explains itself where only the solver's own dependencies are installed."""
    script = f"""if True:
        import sys
        sys.modules |= dict.fromkeys({EXTRAS})  # importing any of them fails
        from click.testing import CliRunner
        from springblock.cli import COMMANDS, main
        for command in COMMANDS:
            result = CliRunner().invoke(main, [command, "--help"])
            assert result.exit_code == 0, (command, result.exception)
    """
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
