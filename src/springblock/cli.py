"""The command line. Commands are imported when they are called: a job loads what it needs."""

from importlib import import_module

import click

COMMANDS = {
    "compile": "springblock.commands.simulate:compile_kernels",
    "prelude": "springblock.commands.simulate:compute_prelude",
    "simulate": "springblock.commands.simulate:simulate_batch",
    "aggregate": "springblock.commands.aggregate:aggregate",
    "correlation": "springblock.commands.correlation:correlation",
    "collect": "springblock.commands.correlation:collect",
    "compare": "springblock.commands.compare:compare",
    "try": "springblock.commands.stability:try_cases",
    "accuracy": "springblock.commands.accuracy:write_page",
    "claims": "springblock.commands.claims:test_statements",
    "figure_1": "springblock.commands.figures:figure_1",
    "figure_2": "springblock.commands.figures:figure_2",
    "figure_3": "springblock.commands.figures:figure_3",
    "figure_4": "springblock.commands.figures:figure_4",
    "figure_5": "springblock.commands.figures:figure_5",
    "figure_6": "springblock.commands.figures:figure_6",
    "figure_7": "springblock.commands.figures:figure_7",
    "figure_8": "springblock.commands.figures:figure_8",
    "figure_9": "springblock.commands.figures:figure_9",
    "supplement_spacing": "springblock.commands.figures:supplement_spacing",
    "supplement_size": "springblock.commands.figures:supplement_size",
    "supplement_angle": "springblock.commands.figures:supplement_angle",
    "supplement_levels": "springblock.commands.figures:supplement_levels",
    "supplement_repetitions": "springblock.commands.figures:supplement_repetitions",
    "supplement_restick": "springblock.commands.figures:supplement_restick",
    "work_precision": "springblock.commands.figures:work_precision",
    "stability": "springblock.commands.figures:stability",
}


class _LazyGroup(click.Group):
    def list_commands(self, ctx: click.Context) -> list[str]:
        return list(COMMANDS)

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        if cmd_name not in COMMANDS:
            return None
        module, name = COMMANDS[cmd_name].split(":")
        return getattr(import_module(module), name)


@click.group(cls=_LazyGroup, context_settings={"help_option_names": ["-h", "--help"]})
@click.version_option(package_name="springblock")
def main() -> None:
    """Spring-block model of the onset of sliding on patterned surfaces."""
