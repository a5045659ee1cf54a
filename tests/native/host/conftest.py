"""The host programs of these tests, built once for all processes that run them."""

from collections.abc import Callable

import pytest
from host_program import Program, program


@pytest.fixture(scope="session")
def host(tmp_path_factory: pytest.TempPathFactory) -> Callable[[str], Program]:
    """Return a function that builds a host program in one of the ways."""
    base = tmp_path_factory.getbasetemp()
    work = base.parent if base.name.startswith("popen-") else base  # xdist: one folder for all processes
    return lambda name: program(name, work)
