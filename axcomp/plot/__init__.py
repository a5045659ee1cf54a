"""Compensation tables as pictures, as tables in the terminal, and the difference of two machines."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..model.face import face

if TYPE_CHECKING:
    from .bars import Bars as Bars
    from .content import VOLUMETRIC as VOLUMETRIC
    from .content import Content as Content
    from .content import NotComparableError as NotComparableError
    from .content import Records as Records
    from .content import Subject as Subject
    from .content import spread as spread
    from .contents import contents_of as contents_of
    from .curves import Curves as Curves
    from .field import Field as Field
    from .maps import Map as Map
    from .pages import document as document
    from .pages import html_table as html_table
    from .pages import navigation as navigation
    from .pages import overview as overview
    from .pages import page as page
    from .pages import picture as picture
    from .pages import remarks as remarks
    from .pages import section as section
    from .pages import shown as shown
    from .style import COLOURS as COLOURS
    from .style import DOWN as DOWN
    from .style import UP as UP
    from .style import labelled as labelled
    from .style import line_styles as line_styles
    from .style import new_figure as new_figure
    from .style import png as png
    from .style import printed as printed
    from .style import save as save
    from .terminal import compared as compared
    from .terminal import console as console
    from .terminal import figure as figure
    from .terminal import table as table
else:
    __all__, __getattr__, __dir__ = face(
        __name__,
        bars="Bars",
        content="Content NotComparableError Records Subject VOLUMETRIC spread",
        contents="contents_of",
        curves="Curves",
        field="Field",
        maps="Map",
        pages="document html_table navigation overview page picture remarks section shown",
        style="COLOURS DOWN UP labelled line_styles new_figure png printed save",
        terminal="compared console figure table",
    )
