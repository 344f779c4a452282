"""The register of statements, written down before the run on fresh seeds that judges them.

`register.csv` is the table `claims` of earlier seeds, with the verdicts that these gave and, beside
them, those of version 1.0.0, whose rule was another.
"""

import csv
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from springblock.io.rows import Row, markdown_table

_FILE = Path(__file__).with_name("register.csv")
#: What is registered of a statement, beside its ranges and cases.
_REGISTERED, _SETS = ("form", "statement"), ("range", "cases")
#: Why a statement, its test or its range is not the one that was registered.
_REASONS: dict[str, str] = {
    "Static friction is greater across grooves than along": "the paper speaks of narrow grooves; "
    "those of 10 between pawls of 10 have been left out",
    "A step of 1e-8 s suffices": "errors of single runs with plain Runge-Kutta were held against "
    "biases of means, a different quantity, and have been left out",
    "The slider's springs follow from the shear modulus": "the paper does not say what part of the "
    "layer shears; both readings are tested",
    "Velocity, pressure and scatter affect the number of fronts": "at the largest velocity all "
    "fronts have merged 1 µs after t_max, a tenth of it: they are counted at 1.01 t_max",
    "Blocks detach in the order of their stress": "equal stresses bound the correlation, to "
    "-0.43 at n_p = 60: it is taken over this bound",
    "Pillars with n_p <= 3 behave like a flat surface": "the paper contrasts them with n_p >= 6, "
    "not with 20; being further away on the other side no longer counts as similar",
    "Static friction is lowest where n_p is about l_c": "the paper's ~ leaves the amplitude open: "
    "A exp(-r/l_c) is tested, too",
    "Correlation length of about three blocks or more": "the paper's ~ leaves the amplitude open: "
    "A exp(-r/l_c) is tested, too",
    "Exponential decay of c_x": "the paper's ~ leaves the amplitude open: all curves have one",
    "The most precursors where static friction is lowest": "on the registered seeds n_p = 6 and 7 "
    "could not be told apart as those of the lowest friction: there are 300 of each",
    "The roundest force peak where static friction is lowest": "as above",
    "The longest transition where static friction is lowest": "as above",
    "All blocks of a side detach at the same time on average": "sides along and across the sliding "
    "direction are told apart, as in other statements on sides",
    "c_x has a long range, c_y a short one": "sides of less than 10 blocks have been left out: at "
    "r = 3 their corners are compared, which detach first",
    "Isolated precursors on flat surfaces": "0.9 t_max is a bound of the study; 0.99 t_max shows "
    "that all but the last hundredth of the time before t_max gives the same",
    "t_avg is when the fronts cross the surface": "within a tenth of t_avg, the former bound, lies "
    "the whole transition, and t_max too: the duration of the transition is the measure now",
    "Small parts of the surface stick and slip while it slides": "1 µs was a choice of the study, "
    "and 4 µs would have failed: the duration of the transition is the measure now",
    **dict.fromkeys(
        (
            "Detachment times are uniform on flat surfaces",
            "Nucleation anywhere on flat surfaces",
            "Detachment waves start near the edge of pillars",
            "Square pawls have one load peak",
            "The edges make the first load peak",
        ),
        "the paper gives no bound: the statement says for which the verdict stays, or changes",
    ),
    "Precursors are uncorrelated when sliding across grooves": "surfaces that the earlier seeds "
    "lack; the paper gives no bound: the statement says for which others the verdict is the same",
    "A quiet phase between the load peaks": "the verdict hinges on how long the quiet has to last: "
    "the former 2 % of t_avg lay between what holds and what fails",
    "What has detached slips again between the load peaks": "the paper does not say how many of "
    "the blocks: two readings are tested",
    "The surface stays stressed between the load peaks": "a surface that slides bears nine tenths "
    "of the largest force as well: the former bound could hardly be missed",
    "A small additional force detaches the surface": "against the force itself any growth between "
    "two equal peaks is small; a second reading measures it by what exceeds sliding friction",
    **dict.fromkeys(
        (
            "Fronts run faster along grooves",
            "Grooves make stress more uniform",
            "Without hierarchy one load peak",
            "The length of pillars changes static friction",
        ),
        "surfaces that the earlier seeds lack: they are in `config/full.yaml` of the same commit",
    ),
    "The lengths control the interval between the load peaks": "chance lies in the choice of "
    "surfaces, which are drawn from anew; that n_p - n_p2 explains more than n_p is not claimed",
}


def registered() -> list[Row]:
    """Return the rows of the register, all as text."""
    with _FILE.open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def verdicts() -> dict[str, Row]:
    """Return a row of each registered statement, with its earlier verdicts."""
    return {row["claim"]: row for row in registered()}


def changes(table: Sequence[Row]) -> str:
    """Say in a Markdown table what differs between the register and what was tested."""
    before, now = _statements(registered()), _statements(table)
    changed = [name for name in now if _difference(before.get(name), now[name])]
    if not changed:
        return "Nothing has been changed since."
    lines = [[name, _difference(before.get(name), now[name])] for name in changed]
    return markdown_table(
        ["statement", "changed", "why"],
        [[*line, _REASONS.get(line[0], "no reason is given")] for line in lines],
    )


def _statements(table: Sequence[Row]) -> dict[str, dict[str, Any]]:
    """What is registered of each statement that was tested: words, form, ranges and cases."""
    found: dict[str, dict[str, Any]] = {}
    for row in table:
        if row["verdict"] == "not tested":
            continue
        new = {name: row[name] for name in _REGISTERED} | {name: set() for name in _SETS}
        said = found.setdefault(row["claim"], new)
        said["range"].add((float(row["claimed_low"]), float(row["claimed_high"])))
        said["cases"].add(row["case"])
    return found


def _difference(before: dict[str, Any] | None, now: dict[str, Any]) -> str:
    """Name what differs; of ranges and cases what is new, since not all need to be simulated."""
    if before is None:
        return "new"
    names = [name for name in _REGISTERED if before[name] != now[name]]
    return ", ".join(names + [name for name in _SETS if now[name] - before[name]])
