"""Laws of friction read from files: see `docs/howto.md`, "A law of your own"."""

import ast
import hashlib
import inspect
import json
import math
import re
import sys
import tokenize
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, fields, replace
from functools import cached_property
from graphlib import CycleError, TopologicalSorter
from pathlib import Path
from typing import Any

import numpy as np

#: Arguments that `friction` and `update` may have besides constants and state variables.
_OF_FRICTION = ("mu_static", "mu_dynamic", "speed")
_OF_UPDATE = ("speed", "step")
#: Packages, besides the standard library, that a law may import, and functions that run other code.
_IMPORTED, _RUNNERS = {"numba", "numpy", "scipy"}, {"exec", "eval", "__import__"}
#: Speeds in m/s at which a law is evaluated before a run.
_TRIED = (0.0, 1e-12, 1e-9, 1e-6, 1e-3, 1.0)


@dataclass(frozen=True)
class LawFile:
    """A law of friction from a Python file, with the values of its constants.

    The file defines `friction`, which returns mu of a sliding block. It may define `CONSTANTS`,
    name: (value, unit), and `STATE`, the state variables of a sliding block, name: initial value or
    the name of the constant that is the initial value. With a state it also defines `update`, which
    returns the state after a step. Both functions receive their arguments by name: `mu_static`,
    `mu_dynamic` (of the block) and `speed` (m/s) in `friction`, `speed` (mean of the step, m/s) and
    `step` (s) in `update`, and constants and state variables in both.

    The name contains a digest of the file and of the values of its global names, which it may have
    read from other files: if one of them changes, it is a different law. Code comes from this file
    alone, and from packages of `_IMPORTED` and the standard library.
    """

    name: str  #: name of the file and eight digits, as ageing-1a2b3c4d
    given: tuple[tuple[str, float], ...] = ()  #: values that replace those of the file
    file: Path | None = field(default=None, compare=False, repr=False)  #: None if not known
    source: str = field(default="", compare=False, repr=False)
    units: Mapping[str, str] = field(default_factory=dict, compare=False, repr=False)

    def __str__(self) -> str:
        return self.name

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickle without the functions: another process runs the file itself."""
        return LawFile, tuple(getattr(self, field.name) for field in fields(self))

    @classmethod
    def read(cls, file: Path, **constants: float) -> "LawFile":
        """Read a law; `constants` replace values in the file."""
        try:
            with tokenize.open(file) as text:  # a byte order mark, or an encoding as of PEP 263
                source = text.read()
        except FileNotFoundError:
            raise ValueError(f"{file} does not exist") from None
        except (LookupError, OSError, SyntaxError, UnicodeDecodeError) as error:
            raise ValueError(f"{file} cannot be read: {error}") from None
        stem = re.sub(r"[^\w.-]", "_", file.stem)
        law = cls(stem, file=file, source=source)
        law._check_definitions()
        with np.printoptions(threshold=sys.maxsize):
            read = repr({name: each for name, each in law._module.items() if _is_data(name, each)})
        digest = hashlib.sha256(f"{source}{read}".encode()).hexdigest()[:8]
        law = replace(law, name=f"{stem}-{digest}")
        units = {
            name: "" if unit == "1" else unit
            for name, (_, unit) in law._module.get("CONSTANTS", {}).items()
        }
        return replace(law, units=units).vary(constants)

    @classmethod
    def named(cls, text: str) -> "LawFile | None":
        """Return the law that a table describes, without its functions; see `described`."""
        name, _, constants = text.partition(" ")
        if not re.fullmatch(r"[\w.-]+-[0-9a-f]{8}", name):
            return None
        known = json.loads(constants or "{}")
        given = tuple((key, value) for key, (value, _) in known.items())
        return cls(name, given, units={key: unit for key, (_, unit) in known.items()})

    @property
    def described(self) -> str:
        """Name, and constants with their units as JSON: the law in a table."""
        known = {name: (value, self.units[name]) for name, value in self.constants.items()}
        return f"{self.name} {json.dumps(known)}" if known else self.name

    def vary(self, constants: Mapping[str, Any]) -> "LawFile":
        """Return the law with other values of its constants."""
        given = dict(self.given)
        for name, value in constants.items():
            if name not in self.constants:
                raise ValueError(
                    f"{self.file}: unknown constant {name!r}; choose from "
                    f"{', '.join(self.constants) or 'none'}"
                )
            if not _is_number(value):
                raise ValueError(f"{name} must be a finite number, not {value!r}")
            given[name] = float(value)
        return replace(self, given=tuple(sorted(given.items())))

    def run(self) -> dict[str, Any]:
        """Run the file and return its definitions, by name."""
        module: dict[str, Any] = {}
        try:
            program = ast.parse(self.source)
            if not (reason := _foreign(program) or _twice(program) or _endless(program)):
                exec(compile(program, str(self.file), "exec"), module)
        except (Exception, SystemExit) as error:
            reason = repr(error)
        if reason:
            raise ValueError(f"{self.file} cannot be run: {reason}")
        return module

    @cached_property
    def _module(self) -> dict[str, Any]:
        return self.run()

    @property
    def friction(self) -> Callable[..., float]:
        """(arguments by name) -> mu."""
        return self._function("friction")

    @property
    def update(self) -> Callable[..., Any]:
        """(arguments by name) -> the state after a step: a number, or a tuple of several."""
        return self._function("update")

    def _function(self, name: str) -> Callable[..., Any]:
        function = self._module.get(name)
        if not inspect.isfunction(function):
            raise ValueError(f"{self.file} must define the function {name}")
        return function

    @property
    def constants(self) -> dict[str, float]:
        """Values of its constants, by name."""
        in_file = self._module.get("CONSTANTS", {}) if self.source else {}
        return {name: float(value) for name, (value, _) in in_file.items()} | dict(self.given)

    @property
    def initial(self) -> dict[str, float]:
        """State of a block that detaches, by name."""
        constants, state = self.constants, self._module.get("STATE", {})
        return {name: float(constants.get(given, given)) for name, given in state.items()}

    def arguments(self, name: str) -> list[str]:
        """Names of the arguments of `friction` or `update`."""
        return list(inspect.signature(self._function(name)).parameters)

    def _check_definitions(self) -> None:
        """Refuse a file that does not define a law."""
        constants, state = (self._module.get(table, {}) for table in ("CONSTANTS", "STATE"))
        for name, table in {"CONSTANTS": constants, "STATE": state}.items():
            if not isinstance(table, dict):
                raise ValueError(f"{self.file}: {name} must be a dictionary")
        for name, given in constants.items():
            if not (isinstance(given, tuple) and len(given) == 2 and _is_number(given[0])):
                raise ValueError(
                    f"{self.file}: CONSTANTS[{name!r}] must be (number, unit), not {given!r}"
                )
        for name, given in state.items():
            if not (_is_number(given) or given in constants):
                raise ValueError(
                    f"{self.file}: STATE[{name!r}] must be a number or the name of a constant, "
                    f"not {given!r}"
                )
        own = [*constants, *state]
        for name in own:
            if name in (*_OF_FRICTION, *_OF_UPDATE) or own.count(name) > 1:
                raise ValueError(f"{self.file}: the name {name!r} has two meanings; rename one")
        for function, more in {"friction": _OF_FRICTION, "update": _OF_UPDATE}.items():
            if function == "update" and not state:
                continue
            for name in self.arguments(function):
                if name not in (*own, *more):
                    raise ValueError(
                        f"{self.file}: {function} has the unknown argument {name!r}; choose from "
                        f"{', '.join([*more, *own])}"
                    )

    def check(self, mu_static: float, mu_dynamic: float, step: float, *where: float) -> None:
        """Refuse a law that fails at one of several speeds, or `where`: a speed and a state."""
        if self.file is None:
            raise ValueError(f"the file of the law {self} is not available, only its name")
        known = {"mu_static": mu_static, "mu_dynamic": mu_dynamic, "step": step}
        known |= self.constants | self.initial | dict(zip(self.initial, where[1:], strict=False))
        for speed in where[:1] or _TRIED:
            at = {**known, "speed": speed}
            mu = self._tried("friction", at)
            if not (_is_number(mu) and mu >= 0.0):
                raise ValueError(
                    f"{self.file}: friction must return one number, finite and not negative, "
                    f"not {mu!r}{self._at(at)}"
                )
            new = self._tried("update", at) if self.initial else ()
            after = new if isinstance(new, tuple) else (new,)
            if len(after) != len(self.initial) or not all(map(_is_number, after)):
                raise ValueError(
                    f"{self.file}: update must return {len(self.initial)} finite numbers, "
                    f"not {new!r}{self._at(at)}"
                )

    def _tried(self, name: str, known: Mapping[str, float]) -> Any:
        try:
            return self._function(name)(*(known[each] for each in self.arguments(name)))
        except (Exception, SystemExit) as error:
            raise ValueError(f"{self.file}: {name} fails{self._at(known)}: {error!r}") from None

    def _at(self, known: Mapping[str, float]) -> str:
        own = ", ".join(f"{name} = {known[name]}" for name in (*self.constants, *self.initial))
        return f" at {known['speed']} m/s" + (f" with {own}" if own else "")


def _foreign(program: ast.Module) -> str | None:
    """Return the use of code from elsewhere, which the digest of the file would not cover."""
    nodes = list(ast.walk(program))
    used = [each.name for node in nodes if isinstance(node, ast.Import) for each in node.names]
    used += [node.module or "." for node in nodes if isinstance(node, ast.ImportFrom)]
    used += [node.id for node in nodes if isinstance(node, ast.Name) and node.id in _RUNNERS]
    for name in used:
        if name.partition(".")[0] not in _IMPORTED | sys.stdlib_module_names - {"importlib"}:
            packages = ", ".join(sorted(_IMPORTED))
            return f"it uses {name}; import only the standard library and {packages}"
    return None


def _twice(program: ast.Module) -> str | None:
    """Return a name that is defined twice, of which Python would keep the last definition."""
    functions = [part.name for part in program.body if isinstance(part, ast.FunctionDef)]
    tables = [node for node in ast.walk(program) if isinstance(node, ast.Dict)]
    keys = [[ast.unparse(key) for key in table.keys if key] for table in tables]
    for names in (functions, *keys):
        if len(set(names)) < len(names):
            return f"{max(names, key=names.count)} is defined twice; remove one"
    return None


def _endless(program: ast.Module) -> str | None:
    """Return what may never end: a compiled function cannot be interrupted.

    What a file does under a condition, as in `if __name__ == "__main__"`, is left to it.
    """
    calls: dict[str, set[str]] = {}
    for part in program.body:
        nodes = [] if isinstance(part, ast.If) else list(ast.walk(part))
        if any(isinstance(node, ast.While) for node in nodes):
            return "a while loop may never end; use `for`, `range` and `break`"
        called = [node.func for node in nodes if isinstance(node, ast.Call)]
        if isinstance(part, ast.FunctionDef):
            calls[part.name] = {each.id for each in called if isinstance(each, ast.Name)}
    try:
        TopologicalSorter(calls).prepare()
    except CycleError as error:
        return f"{' calls '.join(error.args[1])}, which may never end"
    return None


def _is_data(name: str, value: Any) -> bool:
    """Return whether a global name has a value that a compiled function may use."""
    plain = (bool, int, float, complex, str, tuple, list, dict, np.generic, np.ndarray)
    return not name.startswith("__") and isinstance(value, plain)


def _is_number(value: Any) -> bool:
    """Return whether a value is a finite real number, of Python or NumPy."""
    return isinstance(value, int | float) and not isinstance(value, bool) and math.isfinite(value)
