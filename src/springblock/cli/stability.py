"""springblock try: stiff and extreme cases."""

from pathlib import Path

import click
from tqdm import tqdm

from springblock.accuracy.stability.table import SCHEMA, all_cases, row
from springblock.cli.options import OUTPUT, code_version
from springblock.io.parquet import rows_to_table, write


@click.command("try")
@click.option("--output", type=OUTPUT, required=True, help="Parquet file.")
def try_cases(output: Path) -> None:
    """Try stiff and extreme cases, and write their table if each comes out as expected."""
    rows = []
    for case in tqdm(list(all_cases()), unit="case"):
        rows.append(row(case, case.outcome()))
        tqdm.write(f"{case.name}: {rows[-1]['outcome']}")
    wrong = [
        f"{each['case']}: expected {each['expected']!r}, not {each['outcome']!r}"
        for each in rows
        if each["outcome"] != each["expected"]
    ]
    if wrong:
        raise click.ClickException("\n".join(wrong))
    # there is nothing to configure
    write(rows_to_table(rows, SCHEMA), output, {"code_version": code_version("accuracy")})
