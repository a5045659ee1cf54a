"""The FMU: its variables, its model description, its instance at run time, and the file it is packed into."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..model.face import face

if TYPE_CHECKING:
    from ..native import HEADERS as HEADERS, SOURCES as SOURCES
    from .archive import (
        BuildError as BuildError,
        archive_of as archive_of,
        content_guid as content_guid,
        file_bytes as file_bytes,
        generation_date as generation_date,
        write_fmu as write_fmu,
    )
    from .bill import BILL as BILL, bill_of_archive as bill_of_archive
    from .content import NAME as NAME, PACKAGE as PACKAGE, Built as Built, Version as Version
    from .description import (
        Description as Description,
        add_units as add_units,
        document as document,
        model_description as model_description,
    )
    from .documentation import accompanying as accompanying
    from .instance import Instance as Instance
    from .native_package import (
        IMAGE as IMAGE,
        NoCompilerError as NoCompilerError,
        package_native as package_native,
        write_image as write_image,
    )
    from .package import package_axcomp as package_axcomp, write_python_fmu as write_python_fmu
    from .packed_interface import FOLDER as FOLDER, Interface as Interface
    from .packing import packed_lists as packed_lists
    from .saved import MAGIC as MAGIC
    from .sources import needed_files as needed_files, renamed_sources as renamed_sources
else:
    __all__, __getattr__, __dir__ = face(
        __name__,
        archive="BuildError archive_of content_guid file_bytes generation_date write_fmu",
        bill="BILL bill_of_archive",
        content="Built NAME PACKAGE Version",
        description="Description add_units document model_description",
        documentation="accompanying",
        instance="Instance",
        embedded="HEADERS SOURCES",
        native_package="IMAGE NoCompilerError package_native write_image",
        package="package_axcomp write_python_fmu",
        packed_interface="FOLDER Interface",
        packing="packed_lists",
        saved="MAGIC",
        sources="needed_files renamed_sources",
    )
