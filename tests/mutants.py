"""Errors put into the code, and the tests that catch them: `make mutants`.

A mutant is a copy of the package with one error: another sign, comparison or index, a constant off
by 1 or by 1 %, a term left out, two coordinates swapped. Mutants are drawn at random, so many of
each folder as `FOLDERS` says, and each is run against the tests of its folder. Printed are a line
for each mutant, with the first test that failed, and a table by folder.

Compiling the kernels takes half a minute. Mutants of the solver are therefore first tested
interpreted, on few blocks.
"""

import argparse
import ast
import os
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
import threading
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import NamedTuple

import numpy as np

ROOT = Path(__file__).resolve().parents[1]
PACKAGE = ROOT / "src/springblock"
SECONDS = 400  #: in which tests must end; a mutant whose tests do not is caught

#: Share of each folder in the mutants, and the tests that must catch them.
FOLDERS = {
    "solver": (
        0.35,
        "tests/solver tests/simulation/test_simulation.py tests/simulation/test_fields.py "
        "tests/validation/test_blocks.py tests/validation/test_specification.py "
        "tests/validation/test_convergence.py tests/validation/test_law_files.py",
    ),
    "analysis": (0.25, "tests/analysis tests/cli/test_tables.py tests/claims/test_rule.py"),
    "simulation": (0.1, "tests/simulation tests/validation/test_blocks.py"),
    "model": (
        0.13,
        "tests/model tests/simulation/test_simulation.py tests/validation/test_law_files.py",
    ),
    "claims": (0.13, "tests/claims"),
    "provenance.py": (0.04, "tests/test_provenance.py"),
}
#: Tests of the solver that run interpreted.
INTERPRETED = (
    "tests/validation/test_specification.py -k 'each_step and flat and coulomb'",
    "tests/solver/test_release.py tests/solver/test_springs.py tests/solver/test_laws.py",
    "tests/validation/test_specification.py -k 'each_step and flat'",
)

_OTHER: dict[type[ast.AST], type[ast.AST]] = {
    ast.Lt: ast.LtE,
    ast.Gt: ast.GtE,
    ast.Eq: ast.NotEq,
    ast.Is: ast.IsNot,
    ast.In: ast.NotIn,
    ast.Add: ast.Sub,
    ast.Mult: ast.Div,
    ast.BitAnd: ast.BitOr,
    ast.And: ast.Or,
}
OTHER = _OTHER | {other: one for one, other in _OTHER.items()} | {ast.Pow: ast.Mult}
EXTREMES = {"min": "max", "max": "min", "minimum": "maximum", "maximum": "minimum"}


def variants(node: ast.AST) -> Iterator[ast.AST]:
    """Yield what an expression may be mistaken for."""
    match node:
        case ast.Compare(ops=[sign]) if type(sign) in OTHER:
            yield ast.Compare(node.left, [OTHER[type(sign)]()], node.comparators)
        case ast.BoolOp(op=sign):
            yield ast.BoolOp(OTHER[type(sign)](), node.values)
        case ast.BinOp(op=sign):
            if type(sign) in OTHER:
                yield ast.BinOp(node.left, OTHER[type(sign)](), node.right)
            if isinstance(sign, ast.Add | ast.Sub):
                yield node.left
                yield node.right
        case ast.UnaryOp(op=ast.USub() | ast.Not()):
            yield node.operand
        case ast.Constant(value=bool(value)):
            yield ast.Constant(not value)
        case ast.Constant(value=int(value)):
            yield ast.Constant(value + 1)
        case ast.Constant(value=float(value)):
            if value != 0.0:
                yield ast.Constant(1.01 * value)
            yield ast.Constant(value + 1.0)
        case ast.Tuple(elts=[one, other], ctx=ast.Load()):
            yield ast.Tuple([other, one], ast.Load())
        case ast.Call(func=ast.Name(id=name)) if name in EXTREMES:
            yield ast.Call(ast.Name(EXTREMES[name], ast.Load()), node.args, node.keywords)
        case ast.Call(func=ast.Attribute(attr=name)) if name in EXTREMES:
            owner = ast.Attribute(node.func.value, EXTREMES[name], ast.Load())
            yield ast.Call(owner, node.args, node.keywords)


def errors(node: ast.AST) -> Iterator[tuple[dict | list, str | int, ast.AST, ast.AST]]:
    """Yield every error in what is computed: where an expression stands, it, and its variant."""
    for field, value in ast.iter_fields(node):
        if field in ("annotation", "returns", "decorator_list", "bases"):
            continue
        place = value if isinstance(value, list) else node.__dict__
        for key in range(len(value)) if isinstance(value, list) else (field,):
            child = place[key]
            if isinstance(child, ast.AST) and not isinstance(child, ast.Raise | ast.JoinedStr):
                yield from ((place, key, child, variant) for variant in variants(child))
                yield from errors(child)


class Mutant(NamedTuple):
    """One error in one file of the package."""

    folder: str  #: key of `FOLDERS`
    file: str  #: within the package
    change: str  #: line, expression and its variant
    source: str  #: of the whole file


def mutant(folder: str, file: Path, number: int) -> Mutant:
    """Make one of the errors of a file."""
    tree = ast.parse(file.read_text())
    place, key, node, variant = list(errors(tree))[number]
    change = f"{node.lineno}: {ast.unparse(node)}  ->  {ast.unparse(variant)}"
    place[key] = ast.copy_location(variant, node)
    source = ast.unparse(ast.fix_missing_locations(tree))
    return Mutant(folder, file.relative_to(PACKAGE).as_posix(), change, source)


def drawn(number: int, seed: int, only: str = "") -> Iterator[Mutant]:
    """Draw mutants, each folder's share of `number`, or all of them from the folder `only`."""
    rng = np.random.default_rng(seed)
    for folder, (share, _) in FOLDERS.items():
        if only in ("", folder):
            place = PACKAGE / folder
            files = [place] if place.is_file() else sorted(place.glob("*.py"))
            counts = {file: len(list(errors(ast.parse(file.read_text())))) for file in files}
            every = [(file, i) for file in files for i in range(counts[file])]
            chosen = rng.permutation(len(every))[: number if only else round(number * share)]
            yield from (mutant(folder, *every[i]) for i in chosen)


def failing(sources: Path, tests: str, interpreted: bool) -> str:
    """Return the first test that fails against a copy of the sources, or nothing."""
    options = ["-qx", "--tb=no", "-p", "no:cacheprovider", "-p", "no:xdist", *shlex.split(tests)]
    options += ["-W", "ignore"] if interpreted else []
    environment = {
        "PYTHONPATH": str(sources),
        "NUMBA_CACHE_DIR": str(sources.parent / "numba"),
        "NUMBA_DISABLE_JIT": str(int(interpreted)),
        "PYTHONDONTWRITEBYTECODE": "1",  # it would be found again by size and time, to the second
    }
    try:
        done = subprocess.run(
            [sys.executable, "-m", "pytest", *options],
            cwd=ROOT,
            env=os.environ | environment,
            capture_output=True,
            text=True,
            timeout=SECONDS,
        )
    except subprocess.TimeoutExpired:
        return "no end"
    failed = re.search(r"^(?:FAILED|ERROR) ([^\s\[]+)", done.stdout, re.MULTILINE)
    return (failed[1] if failed else "crash") if done.returncode else ""


def caught_by(mutant: Mutant, folder: Path) -> str:
    """Return the first test that fails on a mutant, or nothing; copies are made in `folder`."""
    sources = folder / threading.current_thread().name / "src"
    shutil.rmtree(sources, ignore_errors=True)
    shutil.copytree(PACKAGE, sources / PACKAGE.name)  # with its times: machine code is found again
    (sources / PACKAGE.name / mutant.file).write_text(mutant.source)
    runs = [(FOLDERS[mutant.folder][1], False)]
    if mutant.folder == "solver":
        runs = [*((tests, True) for tests in INTERPRETED), *runs]
    found = next(filter(None, (failing(sources, *run) for run in runs)), "")
    print(f"{mutant.file}:{mutant.change}: {found or 'SURVIVED'}", flush=True)
    return found


def main() -> None:
    """Draw mutants, test each of them, and print the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--number", type=int, default=300)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--only", choices=list(FOLDERS), default="", help="folder to draw from")
    given = parser.parse_args()
    mutants = list(drawn(given.number, given.seed, given.only))
    with tempfile.TemporaryDirectory() as folder, ThreadPoolExecutor(os.cpu_count()) as pool:
        found = list(pool.map(lambda mutant: caught_by(mutant, Path(folder)), mutants))
    print("\n| folder | drawn | caught |\n| --- | ---: | ---: |")
    for name in dict.fromkeys(mutant.folder for mutant in mutants):
        caught = [bool(test) for m, test in zip(mutants, found, strict=True) if m.folder == name]
        print(f"| {name} | {len(caught)} | {sum(caught)} |")


if __name__ == "__main__":
    main()
