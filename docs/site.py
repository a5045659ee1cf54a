"""What the documentation site generates while it is built: commands, API, compensations with pictures, gallery."""

from __future__ import annotations

import argparse
import inspect
import io
import os
import re
from collections.abc import Iterator
from importlib import import_module
from pathlib import Path
from typing import Any

from mkdocs.structure.files import File, Files

import axcomp
from axcomp.cli import COMMANDS
from axcomp.cli.parser import Parser
from axcomp.kinds import KINDS
from axcomp.lists import cells
from axcomp.plot import contents_of

SHOWN = {"volumetric": ("five_axis", "volumetric"), "temperature": ("warm_axis", "temperature"),
         "backlash": ("warm_axis", "backlash")}  # fmt: skip
"""Machine and kind of the picture; else of ``three_axis``."""


def on_files(files: Files, config: Any) -> Files:
    """Add the generated pages and pictures."""
    os.environ["COLUMNS"] = "90"
    pages = {"commands.md": commands(), "api.md": api()}
    pictures: dict[str, bytes] = {}
    pages["compensations.md"] = compensations(pictures)
    pages["gallery.md"] = gallery(pictures)
    for name, content in {**pages, **pictures}.items():
        files.append(File.generated(config, name, content=content))
    return files


def on_page_markdown(markdown: str, page: Any, **_: Any) -> str:
    """Take links off that lead out of the documentation: into the sources, which the site does not hold."""
    here = Path(page.file.src_uri).parent

    def kept(match: re.Match[str]) -> str:
        target = match[2].partition("#")[0]
        outside = not target.startswith(("http", "mailto")) and os.path.normpath(here / target).startswith("..")
        return match[1] if outside or target.endswith((".json", ".py")) else match[0]

    return re.sub(r"(?<!!)\[([^\]\n]+)\]\(([^)\s]+)\)", kept, markdown)


def _parsers() -> Iterator[argparse.ArgumentParser]:
    for command in COMMANDS:
        parser = Parser(prog="axcomp")
        made = parser.add_subparsers()
        import_module(f"axcomp.cli.{command}").add_subparser(made)
        yield made.choices[command]
        for action in made.choices[command]._actions:
            if isinstance(action, argparse._SubParsersAction):
                yield from action.choices.values()


def commands() -> str:
    """Return the help of every command."""
    parts = [f"## {one.prog}\n\n```text\n{one.format_help().rstrip()}\n```\n" for one in _parsers()]
    return "# Commands\n\n" + "\n".join(parts)


def api() -> str:
    """Return the docstring of everything that axcomp offers."""
    parts = ["# Python API\n\nWhat `import axcomp` offers; see [Python](python.md) for a walk.\n"]
    for name in axcomp.__all__:
        thing = getattr(axcomp, name)
        if not callable(thing):
            continue
        try:
            signature = str(inspect.signature(thing)) if not inspect.isclass(thing) else ""
        except ValueError:
            signature = ""
        parts.append(f"## {name}\n\n```text\n{name}{signature}\n\n{inspect.getdoc(thing)}\n```\n")
        methods = [(key, one) for key, one in vars(thing).items() if inspect.isclass(thing) and key[0] != "_"]
        for method, defined in methods:
            function = getattr(defined, "__func__", defined)
            if inspect.isfunction(function):
                text = f"{name}.{method}{inspect.signature(function)}\n\n{inspect.getdoc(function)}"
                parts.append(f"```text\n{text}\n```\n")
    return "\n".join(parts)


def compensations(pictures: dict[str, bytes]) -> str:
    """Return what each compensation does, as its kernel says, with a picture of an example's table."""
    parts = [
        "# Compensations\n\nWhat each compensation computes in a cycle, in the words of the code that does it, and a "
        "table of an example machine. Where the manuals leave room, see [Conventions](conventions.md).\n"
    ]
    for kind in (*KINDS, "volumetric"):
        said = inspect.getdoc(import_module(f"axcomp.kernel.{kind}")) or ""
        title = KINDS[kind].title if kind in KINDS else "Volumetric compensation"
        ids = [cells(one)[1] for one in KINDS[kind].parameters] if kind in KINDS else ["P-VOLC-00001 … P-VOLC-00020"]
        named = ", ".join(dict.fromkeys(filter(None, ids)))
        parts.append(f"## {title}\n\n```text\n{said}\n```\n\nThe manuals' parameters: {named}.\n")
        machine, wanted = SHOWN.get(kind, ("three_axis", kind))
        contents = contents_of(axcomp.read_machine(axcomp.models() / machine).machine, kind=wanted)
        if contents:
            name = f"images/generated/{kind}.png"
            pictures[name] = _png(contents[0].figure())
            parts.append(f"![{title} of models/{machine}]({name})\n")
    return "\n".join(parts)


GALLERY = {
    "A run": """
import numpy as np
from axcomp import Engine, models
t = np.linspace(0.0, 2.0, 2000)
result = Engine(models() / "three_axis").run({"X.setpoint": 50.0 * np.sin(np.pi * t)})
figure = result.plot("X.correction", "X.current")
""",
    "A measurement by ISO 230-2": """
from axcomp import measure, models
figure = measure(models() / "measurements" / "x.rtl").plot().figure
""",
    "A plane table": """
from axcomp import models, show
figure = show(models() / "three_axis", axis="X", kind="plane").plot()[0]
""",
    "Volumetric errors": """
from axcomp import models, show
figure = show(models() / "five_axis", kind="volumetric").plot()[-1]
""",
    "A budget": """
from axcomp import budget, models
machine = models() / "three_axis"
figure = budget(machine, machine / "input.csv").plot(axis="X").figure
""",
}


def gallery(pictures: dict[str, bytes]) -> str:
    """Return pictures with the code that makes each; it is run here."""
    parts = ["# Gallery\n\nEach picture is made by the code above it while this page is built.\n"]
    for number, (title, code) in enumerate(GALLERY.items()):
        space: dict[str, Any] = {}
        exec(code, space)
        name = f"images/generated/gallery{number}.png"
        pictures[name] = _png(space["figure"])
        parts.append(f"## {title}\n\n```python\n{code.strip()}\n```\n\n![{title}]({name})\n")
    return "\n".join(parts)


def _png(figure: Any) -> bytes:
    written = io.BytesIO()
    figure.savefig(written, format="png", dpi=100)
    return written.getvalue()
