"""Laws of friction read from files: see `docs/howto.md`, "A law of your own"."""

import ast
import hashlib
import inspect
import math
import re
import tokenize
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, fields, replace
from functools import cached_property
from pathlib import Path
from typing import Any

from springblock.model.numbers import check_once

#: Arguments that `friction` and `update` may have besides constants and state variables.
_OF_FRICTION = ("mu_static", "mu_dynamic", "speed")
_OF_UPDATE = ("speed", "step")
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

    The name contains a digest of the file, so that a changed file is a different law.
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
            with tokenize.open(file) as text:  # in the encoding that the file declares
                source = text.read()
        except FileNotFoundError:
            raise ValueError(f"{file} does not exist") from None
        except (OSError, SyntaxError, LookupError, UnicodeDecodeError) as error:
            raise ValueError(f"{file} cannot be read: {error}") from None
        stem = re.sub(r"[^\w.-]", "_", file.stem)
        digest = hashlib.sha256(source.encode()).hexdigest()[:8]
        law = cls(f"{stem}-{digest}", file=file, source=source)
        law._check_definitions()
        law._check_repetition()
        units = {
            name: "" if unit == "1" else unit
            for name, (_, unit) in law._module.get("CONSTANTS", {}).items()
        }
        return replace(law, units=units).vary(constants)

    @classmethod
    def named(cls, text: str) -> "LawFile | None":
        """Return the law that a table describes, without its functions; see `described`."""
        described = re.fullmatch(r"([\w.-]+-[0-9a-f]{8})(?: \((.*)\))?", text)
        if not described:
            return None
        name, constants = described.groups(default="")
        found = re.findall(r"(\w+) = (\S+?)(?: (\S+))?(?:, |$)", constants)
        units = {key: unit for key, _, unit in found}
        return cls(name, tuple((key, float(value)) for key, value, _ in found), units=units)

    @property
    def described(self) -> str:
        """Name and constants, as in tables and captions."""
        constants = (
            f"{name} = {value!r} {self.units[name]}".strip()
            for name, value in self.constants.items()
        )
        return f"{self.name} ({', '.join(constants)})" if self.constants else self.name

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
            exec(compile(self.source, str(self.file), "exec"), module)
        except Exception as error:
            raise ValueError(f"{self.file} cannot be run: {error!r}") from None
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

    def _check_repetition(self) -> None:
        """Refuse names that the file defines twice, of which Python would keep the last."""
        whole = ast.parse(self.source)
        functions = (part.name for part in whole.body if isinstance(part, ast.FunctionDef))
        check_once(str(self.file), functions)
        for node in ast.walk(whole):
            keys = node.keys if isinstance(node, ast.Dict) else []
            check_once(str(self.file), (k.value for k in keys if isinstance(k, ast.Constant)))

    def check(self, mu_static: float, mu_dynamic: float, step: float) -> None:
        """Refuse a law that fails with the mean coefficients at one of several speeds."""
        if self.file is None:
            raise ValueError(f"the file of the law {self} is not available, only its name")
        known = {"mu_static": mu_static, "mu_dynamic": mu_dynamic, "step": step}
        known |= self.constants | self.initial
        for speed in _TRIED:
            at = {**known, "speed": speed}
            mu = self._tried("friction", at)
            if not (_is_number(mu) and mu >= 0.0):
                raise ValueError(
                    f"{self.file}: friction must return one number, finite and not negative, "
                    f"not {mu!r} at {speed} m/s{self._with_constants}"
                )
            state = self._tried("update", at) if self.initial else ()
            after = state if isinstance(state, tuple) else (state,)
            if len(after) != len(self.initial) or not all(map(_is_number, after)):
                raise ValueError(
                    f"{self.file}: update must return {len(self.initial)} finite numbers, "
                    f"not {state!r} at {speed} m/s"
                )

    def _tried(self, name: str, known: Mapping[str, float]) -> Any:
        try:
            return self._function(name)(*(known[each] for each in self.arguments(name)))
        except Exception as error:
            raise ValueError(
                f"{self.file}: {name} fails at {known['speed']} m/s{self._with_constants}: "
                f"{error!r}"
            ) from None

    @property
    def _with_constants(self) -> str:
        constants = ", ".join(f"{name} = {value}" for name, value in self.constants.items())
        return f" with {constants}" if constants else ""


def _is_number(value: Any) -> bool:
    """Return whether a value is a finite real number, of Python or NumPy."""
    return isinstance(value, int | float) and not isinstance(value, bool) and math.isfinite(value)
