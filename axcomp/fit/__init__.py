"""Lists from measurements: one module a kind of compensation that says what is special about it, one way for all."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..model.face import face

if TYPE_CHECKING:
    from .axis_list import AxisList as AxisList
    from .circle_tuning import (
        TunedAxis as TunedAxis,
        plant_description as plant_description,
        tune_on_circle as tune_on_circle,
    )
    from .creation import (
        LEFT_OUT as LEFT_OUT,
        MEASURED as MEASURED,
        PREDICTED as PREDICTED,
        CannotCreateError as CannotCreateError,
        Creation as Creation,
    )
    from .crosstalk import AccelerationTests as AccelerationTests
    from .driver import DROP as DROP, KEEP as KEEP, REPORT as REPORT, Fit as Fit, Options as Options
    from .friction import FrictionReadings as FrictionReadings
    from .hat_functions import hats as hats
    from .plane import Flatness as Flatness
    from .registry import FITS as FITS, create as create, fit_of as fit_of
    from .reversal import Circle as Circle, Peaks as Peaks, ReversingAxis as ReversingAxis, Tuned as Tuned, tune as tune
    from .target_list import TargetList as TargetList
    from .thinning import closest as closest, deviation as deviation, fewest as fewest
    from .volumetric_basis import Sought as Sought, sought_errors as sought_errors
    from .volumetric_identification import Identifier as Identifier
    from .volumetric_plan import Plan as Plan, plan_volumetric as plan_volumetric, rows_of as rows_of
    from .volumetric_readings import TcpDeviations as TcpDeviations
    from .volumetric_target import VolumetricTarget as VolumetricTarget
else:
    __all__, __getattr__, __dir__ = face(
        __name__,
        axis_list="AxisList",
        circle_tuning="TunedAxis plant_description tune_on_circle",
        creation="CannotCreateError Creation LEFT_OUT MEASURED PREDICTED",
        crosstalk="AccelerationTests",
        driver="DROP Fit KEEP Options REPORT",
        friction="FrictionReadings",
        hat_functions="hats",
        plane="Flatness",
        registry="FITS create fit_of",
        reversal="Circle Peaks ReversingAxis Tuned tune",
        target_list="TargetList",
        thinning="closest deviation fewest",
        volumetric_basis="Sought sought_errors",
        volumetric_identification="Identifier",
        volumetric_plan="Plan plan_volumetric rows_of",
        volumetric_readings="TcpDeviations",
        volumetric_target="VolumetricTarget",
    )
