"""Laws of friction read from files, see `docs/law.md`."""

import hashlib
import inspect
import json
import re
import tokenize
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, fields, replace
from functools import cached_property
from pathlib import Path
from typing import Any
from unicodedata import normalize

from springblock.model.numbers import is_finite

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

    The name contains a digest of the file and of those that it lists in `INPUTS`, by paths from its
    own folder: if one of them changes, it is a different law.
    """

    name: str  #: name of the file and eight digits, as ageing-1a2b3c4d
    given: tuple[tuple[str, float], ...] = ()  #: its constants, in the order of the file
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
        except (OSError, SyntaxError, UnicodeDecodeError) as error:
            raise ValueError(f"{file} cannot be read: {error}") from None
        stem = re.sub(r"[^\w.-]", "_", file.stem)
        law = cls(stem, file=file, source=source)
        law._check_definitions()
        name = f"{stem}-{law._digest()}"
        given = law._module["CONSTANTS"].items()
        # the Greek letter looks like the micro sign
        units = {key: "" if unit == "1" else unit.replace("μ", "µ") for key, (_, unit) in given}
        return replace(law, name=name, units=units).vary(constants)

    def _digest(self) -> str:
        """Return eight digits of the source, and of the files that it lists."""
        whole = hashlib.sha256(self.source.encode())
        try:
            for each in self._module.get("INPUTS", []):
                whole.update(Path(str(self.file)).with_name(each).read_bytes())
        except (OSError, TypeError, ValueError) as error:
            raise ValueError(f"{self.file}: INPUTS must be a list of files: {error}") from None
        return whole.hexdigest()[:8]

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
        given = self.constants
        for name, value in {normalize("NFKC", key): constants[key] for key in constants}.items():
            if name not in self.constants:
                raise ValueError(
                    f"{self.file}: unknown constant {name!r}; choose from "
                    f"{', '.join(self.constants) or 'none'}"
                )
            if not is_finite(value):
                raise ValueError(f"{name} must be a finite number, not {value!r}")
            given[name] = float(value)
        return replace(self, given=tuple(given.items()))

    def run(self) -> dict[str, Any]:
        """Run the file and return its definitions, by name."""
        module: dict[str, Any] = {"__file__": str(self.file)}
        try:
            exec(compile(self.source, str(self.file), "exec"), module)
        except (Exception, SystemExit) as error:
            raise ValueError(f"{self.file} cannot be run: {error!r}") from None
        for name in ("CONSTANTS", "STATE"):  # in the form of Python's names of arguments
            table = module.get(name, {})
            if not isinstance(table, dict):
                raise ValueError(f"{self.file}: {name} must be a dictionary")
            module[name] = {normalize("NFKC", str(key)): value for key, value in table.items()}
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
        function = getattr(function, "py_func", function)  # of a function that numba compiles
        if not inspect.isfunction(function):
            raise ValueError(f"{self.file} must define the function {name}")
        return function

    @property
    def constants(self) -> dict[str, float]:
        """Values of its constants, by name."""
        in_file = self._module["CONSTANTS"] if self.source else {}
        return {name: float(value) for name, (value, _) in in_file.items()} | dict(self.given)

    @property
    def initial(self) -> dict[str, float]:
        """State of a block that detaches, by name."""
        constants, state = self.constants, self._module["STATE"]
        return {name: float(constants.get(given, given)) for name, given in state.items()}

    def arguments(self, name: str) -> list[str]:
        """Names of the arguments of `friction` or `update`."""
        return list(inspect.signature(self._function(name)).parameters)

    def _check_definitions(self) -> None:
        """Refuse a file that does not define a law."""
        constants, state = self._module["CONSTANTS"], self._module["STATE"]
        for name, given in constants.items():
            if not (isinstance(given, tuple) and len(given) == 2 and is_finite(given[0])):
                raise ValueError(
                    f"{self.file}: CONSTANTS[{name!r}] must be (number, unit), not {given!r}"
                )
        for name, given in state.items():
            if not (is_finite(given) or given in constants):
                raise ValueError(
                    f"{self.file}: STATE[{name!r}] must be a number or the name of a constant, "
                    f"not {given!r}"
                )
        own = [*constants, *state]
        for name in own:
            if name in (*_OF_FRICTION, *_OF_UPDATE) or own.count(name) > 1:
                raise ValueError(f"{self.file}: the name {name!r} has two meanings; rename one")
        known = {"friction": [*_OF_FRICTION, *own], "update": [*_OF_UPDATE, *own]}
        for function in known if state else ["friction"]:
            for name in self.arguments(function):
                if name not in known[function]:
                    raise ValueError(
                        f"{self.file}: {function} has the unknown argument {name!r}; choose from "
                        f"{', '.join(known[function])}"
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
            if not (is_finite(mu) and mu >= 0.0):
                raise ValueError(
                    f"{self.file}: friction must return one number, finite and not negative, "
                    f"not {mu!r}{self._at(at)}"
                )
            new = self._tried("update", at) if self.initial else ()
            after = new if isinstance(new, tuple) else (new,)
            if len(after) != len(self.initial) or not all(map(is_finite, after)):
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
        """Return where a law was evaluated, in words."""
        own = ", ".join(f"{name} = {known[name]}" for name in (*self.constants, *self.initial))
        where = f"{known['speed']} m/s" if known["speed"] else "rest (speed = 0)"
        return f" at {where}" + (f" with {own}" if own else "")
