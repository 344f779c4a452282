"""How many errors the tests catch: `make mutants`, or `python tests/mutants.py --only solver`.

A mutant is a copy of the package with one error: a sign, a comparison, an index, a constant off by
1 or by 1 %, a term left out, two coordinates swapped. Mutants are drawn at random, so many of each
folder as `PLANS` says, and each is run against the tests of its module first. Standard output has a
line for each mutant, a table by folder, and the tests that were never the first to fail.

To compile the kernels anew takes half a minute for each mutant of the solver. These therefore run
interpreted first, against the specification on a surface of 25 blocks; only those that survive are
compiled and run against the tests of their module.
"""

import argparse
import ast
import multiprocessing
import os
import re
import shutil
import sys
import tempfile
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import redirect_stderr, redirect_stdout
from multiprocessing.connection import Connection
from pathlib import Path
from queue import SimpleQueue
from typing import NamedTuple

import numba
import numpy as np
import pytest

ROOT = Path(__file__).resolve().parents[1]
PACKAGE = ROOT / "src/springblock"
SECONDS = 400  #: in which tests must end; a mutant whose tests do not is caught
#: Each run of tests is a copy of one process that has loaded the libraries, but not the package.
PROCESSES = multiprocessing.get_context("forkserver")
PROCESSES.set_forkserver_preload(
    ["numba", "pytest", "scipy.stats", "scipy.signal", "pyarrow.parquet", "matplotlib.pyplot"]
)


class Plan(NamedTuple):
    """How mutants of a folder are tested: its share of all, and tests beside the module's own."""

    share: float
    tests: tuple[str, ...]
    interpreted: tuple[str, ...] = ()  #: tests that run first, without compilation


_STEPS = "tests/validation/test_specification.py -k each_step and"
PLANS = {
    "solver": Plan(
        0.35,
        ("tests/simulation/test_simulation.py", "tests/validation/test_blocks.py"),
        (
            f"{_STEPS} flat and coulomb",
            " ".join(f"tests/solver/test_{name}.py" for name in ("release", "springs", "laws")),
            f"{_STEPS} flat",
        ),
    ),
    "analysis": Plan(0.25, ("tests/analysis",)),
    "simulation": Plan(0.1, ("tests/simulation", "tests/validation/test_blocks.py")),
    "model": Plan(0.13, ("tests/model", "tests/simulation/test_simulation.py")),
    "claims": Plan(0.13, ("tests/claims",)),
    "provenance.py": Plan(0.04, ()),
}
#: Tests of modules that have no file of their own name.
OWN = {
    "analysis/ensembles": "tests/cli/test_tables.py",
    "analysis/estimate": "tests/claims/test_rule.py",
    "model/law": "tests/validation/test_law_files.py",
    "provenance": "tests/test_provenance.py",
    "simulation/run": "tests/simulation/test_simulation.py",
    "simulation/setup": "tests/simulation/test_simulation.py",
    "simulation/simulate": "tests/simulation/test_simulation.py",
    "solver/lattice": "tests/solver/test_leapfrog.py",
    "solver/law_file": "tests/validation/test_law_files.py",
    "solver/rk4": "tests/validation/test_convergence.py",
}

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

    file: str  #: within the package
    line: int
    change: str
    source: str  #: of the whole file

    @property
    def folder(self) -> str:
        """Return the key of its plan."""
        return self.file.partition("/")[0]


def mutant(file: Path, number: int) -> Mutant:
    """Make one of the errors of a file."""
    tree = ast.parse(file.read_text())
    place, key, node, variant = list(errors(tree))[number]
    change = f"{ast.unparse(node)}  ->  {ast.unparse(variant)}"
    place[key] = ast.copy_location(variant, node)
    source = ast.unparse(ast.fix_missing_locations(tree))
    return Mutant(file.relative_to(PACKAGE).as_posix(), node.lineno, change, source)


def drawn(number: int, seed: int, only: str) -> list[Mutant]:
    """Draw mutants, each folder's share of `number`, or all of them from the folder `only`."""
    rng, found = np.random.default_rng(seed), []
    for folder, plan in PLANS.items():
        if only not in ("", folder):
            continue
        place = PACKAGE / folder
        files = [place] if place.is_file() else sorted(place.glob("*.py"))
        numbers = {file: len(list(errors(ast.parse(file.read_text())))) for file in files}
        every = [(file, i) for file in files for i in range(numbers[file])]
        share = number if only else round(number * plan.share)
        found += [mutant(*every[i]) for i in rng.permutation(len(every))[:share]]
    return found


class FirstFailure:
    """Plugin of pytest that keeps the name of the first test that fails, without parameters."""

    name = ""

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        """Keep the name of a test that fails."""
        if report.failed:
            self.name = self.name or report.nodeid.partition("[")[0]


def run_tests(sources: Path, tests: str, interpreted: bool, answer: Connection) -> None:
    """Run tests against a copy of the sources, in a process of their own; send what fails."""
    path, _, words = tests.partition(" -k ")
    options = ["-q", "-x", "--tb=no", "-p", "no:cacheprovider", "-p", "no:xdist", *path.split()]
    options += ["-k", words] if words else []
    options += ["-W", "ignore"] if interpreted else []
    os.chdir(ROOT)
    os.environ |= {"PYTHONPATH": str(sources), "NUMBA_CACHE_DIR": str(sources.parent / "numba")}
    sys.path.insert(0, str(sources))
    numba.config.DISABLE_JIT = interpreted
    sys.dont_write_bytecode = True  # it is found again by size and time, to the second
    first = FirstFailure()
    with Path(os.devnull).open("w") as nowhere, redirect_stdout(nowhere), redirect_stderr(nowhere):
        code = pytest.main(options, plugins=[first])
    passed = code in (pytest.ExitCode.OK, pytest.ExitCode.NO_TESTS_COLLECTED)
    answer.send("" if passed else first.name or f"{path}::(import)")


def failing(sources: Path, tests: str, interpreted: bool = False) -> str:
    """Return the first test that fails against a copy of the sources, or nothing."""
    here, there = PROCESSES.Pipe(duplex=False)
    child = PROCESSES.Process(target=run_tests, args=(sources, tests, interpreted, there))
    child.start()
    there.close()
    path = tests.partition(" ")[0]
    try:
        return here.recv() if here.poll(SECONDS) else f"{path}::(no end)"
    except EOFError:
        return f"{path}::(crash)"
    finally:
        child.kill()
        child.join()


def caught_by(mutant: Mutant, room: Path) -> str:
    """Return the first test that fails on a mutant, or nothing; `room` is for copies."""
    plan, stem = PLANS[mutant.folder], mutant.file.removesuffix(".py")
    package, folder = room / "src/springblock", Path(stem).parent
    for interpreted in (True, False) if plan.interpreted else (False,):
        shutil.rmtree(room / "src", ignore_errors=True)
        shutil.copytree(PACKAGE, package)  # with its time stamps: machine code is found again
        (package / mutant.file).write_text(mutant.source)
        own = OWN.get(stem, f"tests/{folder}/test_{Path(stem).name}.py")
        tests = plan.interpreted if interpreted else (own, *plan.tests)
        for each in tests:
            exists = (ROOT / each.partition(" ")[0]).exists()
            if exists and (found := failing(room / "src", each, interpreted)):
                return found
    return ""


def report(mutants: list[Mutant], tests: list[str]) -> None:
    """Print the table, the survivors, and tests of these mutants' files that never failed."""
    print("\n| folder | drawn | caught |\n| --- | ---: | ---: |")
    for folder in dict.fromkeys(mutant.folder for mutant in mutants):
        found = [
            test for mutant, test in zip(mutants, tests, strict=True) if mutant.folder == folder
        ]
        print(f"| {folder} | {len(found)} | {sum(map(bool, found))} |")
    files = sorted({test.partition("::")[0] for test in tests if test})
    print("\nTests in", *files, "that were never the first to fail:")
    for file in files:
        for name in re.findall(r"^def (test_\w+)", (ROOT / file).read_text(), re.MULTILINE):
            if f"{file}::{name}" not in tests:
                print(f"    {file}::{name}")


def main() -> None:
    """Draw mutants, test each of them, and report."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--number", type=int, default=300)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--only", choices=list(PLANS), default="", help="folder to draw from")
    parser.add_argument("--jobs", type=int, default=os.cpu_count() or 1)
    given = parser.parse_args()
    mutants, rooms = drawn(given.number, given.seed, given.only), SimpleQueue()
    with tempfile.TemporaryDirectory() as folder, ThreadPoolExecutor(given.jobs) as pool:
        for job in range(given.jobs):
            rooms.put(Path(folder, str(job)))

        def tried(mutant: Mutant) -> str:
            room = rooms.get()
            found = caught_by(mutant, room)
            rooms.put(room)
            print(
                f"{mutant.file}:{mutant.line}: {mutant.change}: {found or 'SURVIVED'}", flush=True
            )
            return found

        tests = list(pool.map(tried, mutants))
    report(mutants, tests)


if __name__ == "__main__":
    main()
