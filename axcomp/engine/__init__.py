"""The engine on its own: step by step, over whole trajectories, with NC commands; and the motions to run it with."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..model.face import face

if TYPE_CHECKING:
    from .engine import COMMAND as COMMAND, Engine as Engine
    from .motion import Array as Array, Course as Course, Limits as Limits, Setpoints as Setpoints, move as move
    from .nc_commands import (
        Assignment as Assignment,
        AxisCommand as AxisCommand,
        AxisVariable as AxisVariable,
        Command as Command,
        Variable as Variable,
        VolumetricSwitch as VolumetricSwitch,
        VolumetricUpdate as VolumetricUpdate,
        parse_block as parse_block,
    )
    from .nc_scanner import NcError as NcError
    from .result import Result as Result
    from .sheet import (
        Row as Row,
        Sheet as Sheet,
        SheetError as SheetError,
        number as number,
        read_sheets as read_sheets,
    )
    from .tcp_model import TcpModel as TcpModel
    from .trajectory import (
        LIMITS as LIMITS,
        TIME as TIME,
        Columns as Columns,
        InputError as InputError,
        InputFile as InputFile,
        Motion as Motion,
        Sine as Sine,
        completed as completed,
        read_input as read_input,
        read_table as read_table,
    )
else:
    __all__, __getattr__, __dir__ = face(
        __name__,
        engine="COMMAND Engine",
        motion="Array Course Limits Setpoints move",
        nc_commands="Assignment AxisCommand AxisVariable Command Variable VolumetricSwitch VolumetricUpdate "
        "parse_block",
        nc_scanner="NcError",
        result="Result",
        sheet="Row Sheet SheetError number read_sheets",
        tcp_model="TcpModel",
        trajectory="Columns InputError InputFile LIMITS Motion Sine TIME completed read_input read_table",
    )
