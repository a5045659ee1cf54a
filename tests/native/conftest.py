from pathlib import Path

import pytest
from fmu_machines import three_axes

from axcomp.fmu import NoCompilerError, package_native
from axcomp.lists import write_machine


@pytest.fixture(scope="session")
def lists(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The lists of a machine that uses every kind of compensation; not to be changed."""
    folder = tmp_path_factory.mktemp("lists")
    write_machine(three_axes(), folder)
    return folder


@pytest.fixture(scope="session")
def native_fmu(lists: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The native FMU of these lists for this machine."""
    try:
        return package_native(lists, tmp_path_factory.mktemp("fmu")).path
    except NoCompilerError as error:
        pytest.skip(str(error))
