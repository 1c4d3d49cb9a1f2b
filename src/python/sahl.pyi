# Types of the module that src/python/module.cpp makes; docs/python.md tells how it is used.
from os import PathLike
from typing import Any, Mapping, Sequence

import numpy

__version__: str
events: tuple[str, ...]
"""Names of the codes in the columns `born` and `ended`."""

class InputError(ValueError):
    """Bad input; the text is the program's: place, problem, remedy."""

class Log:
    """The rows of a ray log, a segment each; columns, units and codes as in docs/ray-log.md."""

    @property
    def columns(self) -> dict[str, numpy.ndarray]: ...
    @property
    def surfaces(self) -> list[str]:
        """By the column `surface`."""
    @property
    def media(self) -> list[str]:
        """By the column `medium`."""
    @property
    def sources(self) -> list[str]: ...
    @property
    def title(self) -> str: ...
    def __getitem__(self, column: str) -> numpy.ndarray: ...
    def __len__(self) -> int: ...

def run(
    experiment: str | PathLike[str] | Mapping[str, Any],
    *,
    set: Sequence[str] = (),
    out: str | PathLike[str] | None = None,
    threads: int = 0,
) -> tuple[dict[str, Any], list[str]]:
    """Runs an experiment file, or a dict of the same structure, whose files are found from the working directory.

    set      KEY=VALUE, as of `sahl trace --set`
    out      folder of the results, which holds the log too (trace.log = true); None: nothing is written
    threads  0: all there are
    Returns the summary, and the checks of physics that failed. Ctrl-C stops it, and leaves nothing half-written.
    """

def read_log(path: str | PathLike[str], *, where: str = "") -> Log:
    """All rows of a log (the folder of a run, or its rays.h5), or those of the paths that a filter selects."""

def paths(path: str | PathLike[str], *, where: str = "", share: float = 1e-3) -> dict[str, Any]:
    """What `sahl paths --json` says of a log."""
