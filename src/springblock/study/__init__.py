"""The study: its configuration, its chapters, its report and their commands."""

COMMANDS = {
    "make": "springblock.study.commands.make:make",
    "figure": "springblock.study.commands.figure:figure",
    "report": "springblock.study.commands.report:report",
}
