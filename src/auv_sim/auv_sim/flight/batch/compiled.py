"""Compiles the batch engine's functions where Numba is installed; without it they run as Python."""

from __future__ import annotations

import hashlib
import os
import tempfile
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from types import ModuleType
from typing import Any, TypeVar

import auv_msgs_py
import auv_path_following
import auv_sim
from auv_msgs_py.values.pure import DISPATCHED, PURE, Step

F = TypeVar("F", bound=Callable[..., Any])

# A flight is as fast with fewer optimisations, and compiled in 0.8 of the time.
os.environ.setdefault("NUMBA_OPT", "1")
numba: Any
try:
    import numba
    from numba.core.codegen import JITCodeLibrary
    from numba.core.compiler import CompilerBase, DefaultPassBuilder
    from numba.extending import overload, register_jitable
except ImportError:
    numba = None

#: Source files of the functions in compiled code: (package, pattern).
_COMPILED_FROM = (
    (auv_msgs_py, "values/*.py"),
    (auv_msgs_py, "contract/*.py"),
    (auv_path_following, "*.py"),
    *((auv_path_following, f"{room}/**/*.py") for room in ("curves", "missions", "navigation")),
    *((auv_path_following, f"{room}/**/*.py") for room in ("guidance", "control", "comparators")),
    (auv_sim, "flight/**/*.py"),
    (auv_sim, "vehicle/**/*.py"),
    (auv_sim, "own_vehicle/identify/**/*.py"),
)

#: Whether the engine is compiled; otherwise a flight takes about as long as one of `closed_loop`.
COMPILED = numba is not None

#: Inlined, because a call passes every number of a nested named tuple: this takes 0.4 to 0.6 of the time.
#: Python never calls these functions: without the wrappers for it compiling takes 0.75 of the time.
_OPTIONS: Any = {
    "error_model": "numpy",
    "forceinline": True,
    "no_cpython_wrapper": True,
    "no_cfunc_wrapper": True,
}

if numba is not None:

    class _LinkedOnly(JITCodeLibrary):
        """Code of an inlined function, for its callers to link.

        Numba would also optimise and load every inlined function with all that it inlines, although only its
        callers run. That doubles the time in LLVM.
        """

        def finalize(self) -> None:
            """Link what the function calls, and neither optimise nor load it."""
            for library in dict.fromkeys(self._linking_libraries):
                self._reload_init.update(library._reload_init)
                self._final_module.link_in(library._get_module_for_linking(), preserve=True)
            self._finalized = True

        def get_pointer_to_function(self, name: str) -> int:
            """Return 0, as for a function that is not in the library."""
            return 0

        @property
        def codegen(self) -> _LinkedOnly:
            """Return the library itself, so that Numba calls its `set_env`."""
            return self

        def set_env(self, name: str, environment: object) -> None:
            """Do nothing: a function that is not loaded has no place for its environment."""

    class _Inlined(CompilerBase):
        """Numba's compiler for functions that are inlined into every caller."""

        def define_pipelines(self) -> list[Any]:
            name = self.state.func_id.func_qualname
            library: Any = _LinkedOnly
            builder: Any = DefaultPassBuilder
            self.state.library = library(self.state.targetctx.codegen(), name)
            return [builder.define_nopython_pipeline(self.state)]

    _OPTIONS["pipeline_class"] = _Inlined


def compiled(function: F) -> F:
    """Compile a function to machine code that releases the interpreter's lock, cached from run to run."""
    if numba is None:
        return function
    options = {"nogil": True, "cache": True, "no_cfunc_wrapper": True, "error_model": "numpy"}
    return numba.njit(**options)(function)  # type: ignore[no-any-return]


def inlined(function: F) -> F:
    """Make a function callable from compiled code, which inlines it."""
    if numba is not None:
        register_jitable(**_OPTIONS)(function)
    return function


def overloads(function: Callable[..., Any]) -> Callable[[F], F]:
    """Decorate the maker of a function's compiled form, given the types of its arguments."""

    def decorate(maker: F) -> F:
        if numba is not None:
            overload(function, jit_options=_OPTIONS, strict=False)(maker)
        return maker

    return decorate


_taken_over: set[int] = set()


def take_over_pure() -> None:
    """Make pure functions defined so far callable from compiled code, with steps chosen by configuration."""
    if numba is None:
        return
    for function in PURE:
        if id(function) not in _taken_over:
            _taken_over.add(id(function))
            inlined(function)
    for step, steps in DISPATCHED:
        if id(step) not in _taken_over:
            _taken_over.add(id(step))
            overloads(step)(_chooser(steps))


def _chooser(steps: Mapping[type[Any], Step]) -> Callable[..., Any]:
    """Return what picks a step while a caller is compiled, by the class of the configuration."""

    def choose(config: Any, *inputs: Any) -> Any:
        return steps.get(getattr(config, "instance_class", type(None)))

    return choose


def files_of(sources: Iterable[tuple[ModuleType, str]]) -> list[Path]:
    """Return the files of packages that match a pattern, in order."""
    return [
        path
        for package, pattern in sources
        for path in sorted(Path(str(package.__file__)).parent.glob(pattern))
    ]


def digest_of(files: Iterable[Path]) -> str:
    """Return a digest of the files' content."""
    digest = hashlib.sha256()
    for path in files:
        digest.update(path.read_bytes() + b"\0")
    return digest.hexdigest()[:16]


if COMPILED:
    # Numba checks only the file of the compiled function, not those of the functions that it calls. So the
    # compiled code of every version of the laws has its own folder.
    _HOME = os.path.expanduser("~")  # noqa: PTH111 - Path.expanduser() raises where there is no home
    _CACHES = Path(_HOME) / ".cache" if _HOME != "~" else Path(tempfile.gettempdir())
    _BASE = os.environ.get("NUMBA_CACHE_DIR") or _CACHES / "auv_sim"
    numba.config.CACHE_DIR = str(Path(_BASE) / digest_of(files_of(_COMPILED_FROM)))
