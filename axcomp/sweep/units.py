"""Units of what is varied and of what comes out of a sweep."""

from __future__ import annotations

from ..interface import variables_of
from ..kinds import key_of
from ..lists import SPELLINGS
from ..model import symbol
from .list_variation import ListEntry
from .settings import Setting
from .spec import Spec
from .task import Job, reading_of

_PARAMETERS = {"cycle_time": "s", "duration": "s"}


def units_of(spec: Spec, job: Job) -> dict[str, str]:
    """Return the unit of each column that has one: of variables as the lists' machine has them, of entries their own.

    The variables of a machine that is an FMU are not known here.
    """
    machine = next((reading_of(source).machine for source in job.sources if not source.is_fmu), None)
    variables = {} if machine is None else {one.name: symbol(one.unit) for one in variables_of(machine)}
    units = {name: variables.get(reduction.minuend, "") for name, reduction in job.results.items()}
    units |= {setting.key: _of_setting(setting, variables) for setting in spec.settings}
    return {name: unit for name, unit in units.items() if unit}


def _of_setting(setting: Setting, variables: dict[str, str]) -> str:
    if setting.kind == "parameter":
        return _PARAMETERS.get(setting.name, variables.get(setting.name, ""))
    if setting.kind == "input":
        return variables.get(setting.name, "")
    if not isinstance(setting.target, ListEntry) or setting.target.scale:
        return ""
    key = key_of(setting.target.entry)
    return next((names[key].parameter.unit for names in SPELLINGS.values() if key in names), "")
