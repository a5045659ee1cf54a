"""What all tests share: helper modules beside this file can be imported; how Hypothesis draws.

The same examples are drawn in every run, so that a commit is judged by what it changes; with ``AXCOMP_RANDOM=1``
others are drawn each time.
"""

import os

import pytest
from hypothesis import settings

settings.register_profile("axcomp", deadline=None, derandomize="AXCOMP_RANDOM" not in os.environ)
settings.load_profile("axcomp")


@pytest.fixture(autouse=True)
def _terminal(monkeypatch: pytest.MonkeyPatch) -> None:
    """What is printed does not depend on where the tests run."""
    monkeypatch.setenv("COLUMNS", "200")
