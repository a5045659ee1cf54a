from pathlib import Path

import pytest
from fmu_machines import three_axes

from axcomp.fmu import package_axcomp
from axcomp.lists import write_machine


@pytest.fixture(scope="session")
def lists(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The lists of a machine that uses every kind of compensation; not to be changed."""
    folder = tmp_path_factory.mktemp("lists")
    write_machine(three_axes(), folder)
    return folder


@pytest.fixture(scope="session")
def fmu(lists: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    return package_axcomp(lists, tmp_path_factory.mktemp("fmu")).path
