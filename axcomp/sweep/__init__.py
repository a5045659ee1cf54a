"""Many runs over varied lists, inputs and parameters: ``axcomp sweep``."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..model.face import face

if TYPE_CHECKING:
    from .journal import Journal as Journal, keys_of as keys_of
    from .list_variation import ListEntry as ListEntry, Table as Table, read_files as read_files, varied as varied
    from .reductions import Reduction as Reduction
    from .spec import (
        ERROR as ERROR,
        FINDINGS as FINDINGS,
        RUN as RUN,
        Spec as Spec,
        SpecError as SpecError,
        read_spec as read_spec,
    )
    from .sweep import Sweep as Sweep, job_of as job_of, run_sweep as run_sweep
    from .task import perform as perform
else:
    __all__, __getattr__, __dir__ = face(
        __name__,
        journal="Journal keys_of",
        list_variation="ListEntry Table read_files varied",
        reductions="Reduction",
        spec="ERROR FINDINGS RUN Spec SpecError read_spec",
        sweep="Sweep job_of run_sweep",
        task="perform",
    )
