"""The engine on its own: step by step, over whole trajectories, with NC commands; and the motions to run it with."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..model.face import face

if TYPE_CHECKING:
    from .engine import COMMAND as COMMAND
    from .engine import Engine as Engine
    from .engine import Result as Result
    from .motion import Array as Array
    from .motion import Course as Course
    from .motion import Limits as Limits
    from .motion import Setpoints as Setpoints
    from .motion import move as move
    from .nc_commands import Assignment as Assignment
    from .nc_commands import AxisCommand as AxisCommand
    from .nc_commands import AxisVariable as AxisVariable
    from .nc_commands import Command as Command
    from .nc_commands import Variable as Variable
    from .nc_commands import VolumetricSwitch as VolumetricSwitch
    from .nc_commands import VolumetricUpdate as VolumetricUpdate
    from .nc_commands import parse_block as parse_block
    from .nc_scanner import NcError as NcError
    from .tcp_model import TcpModel as TcpModel
    from .trajectory import LIMITS as LIMITS
    from .trajectory import TIME as TIME
    from .trajectory import Columns as Columns
    from .trajectory import InputError as InputError
    from .trajectory import InputFile as InputFile
    from .trajectory import Motion as Motion
    from .trajectory import Sine as Sine
    from .trajectory import completed as completed
    from .trajectory import read_input as read_input
    from .trajectory import read_table as read_table
else:
    __all__, __getattr__, __dir__ = face(
        __name__,
        engine="COMMAND Engine Result",
        motion="Array Course Limits Setpoints move",
        nc_commands="Assignment AxisCommand AxisVariable Command Variable VolumetricSwitch VolumetricUpdate "
        "parse_block",
        nc_scanner="NcError",
        tcp_model="TcpModel",
        trajectory="Columns InputError InputFile LIMITS Motion Sine TIME completed read_input read_table",
    )
