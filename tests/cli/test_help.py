"""Every command is found by its name and says what it does."""

import re

import pytest

from springblock.cli import COMMANDS


@pytest.mark.parametrize("command", COMMANDS)
def test_a_command_explains_itself(springblock, command):
    assert re.search(rf"^  {command} +[A-Z]\w+ ", springblock("--help"), re.MULTILINE)
    assert springblock(command, "--help").startswith(f"Usage: main {command} ")


def test_an_unknown_command_is_refused_by_name(springblock):
    assert "No such command 'slide'" in springblock("slide", refused=True)
