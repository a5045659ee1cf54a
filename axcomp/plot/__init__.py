"""Compensation tables as pictures, as tables in the terminal, and the difference of two machines."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..model.face import face

if TYPE_CHECKING:
    from .bars import Bars as Bars
    from .content import (
        VOLUMETRIC as VOLUMETRIC,
        Content as Content,
        NotComparableError as NotComparableError,
        Records as Records,
        Subject as Subject,
        spread as spread,
    )
    from .contents import contents_of as contents_of
    from .curves import Curves as Curves
    from .field import Field as Field
    from .interactive import NoPlotlyError as NoPlotlyError, script as script
    from .maps import Map as Map
    from .pages import (
        document as document,
        html_table as html_table,
        made as made,
        navigation as navigation,
        overview as overview,
        page as page,
        picture as picture,
        remarks as remarks,
        section as section,
        sections as sections,
        shown as shown,
    )
    from .style import (
        COLOURS as COLOURS,
        DOWN as DOWN,
        UP as UP,
        embedded as embedded,
        framed_figure as framed_figure,
        labelled as labelled,
        line_styles as line_styles,
        new_figure as new_figure,
        png as png,
        printed as printed,
        save as save,
        svg as svg,
        thinned as thinned,
    )
    from .terminal import compared as compared, console as console, figure as figure, table as table
else:
    __all__, __getattr__, __dir__ = face(
        __name__,
        bars="Bars",
        content="Content NotComparableError Records Subject VOLUMETRIC spread",
        contents="contents_of",
        curves="Curves",
        field="Field",
        interactive="NoPlotlyError script",
        maps="Map",
        pages="document html_table made navigation overview page picture remarks section sections shown",
        style="COLOURS DOWN UP embedded framed_figure labelled line_styles new_figure png printed save svg thinned",
        terminal="compared console figure table",
    )
