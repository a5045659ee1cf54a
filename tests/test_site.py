"""The documentation site: it builds without a warning, its links lead somewhere, its tutorials can be followed."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
from html.parser import HTMLParser
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
TUTORIALS = sorted((ROOT / "docs" / "tutorials").glob("*.md"))


class Links(HTMLParser):
    """Collects what a page refers to, and the places in it that can be referred to."""

    def __init__(self) -> None:
        super().__init__()
        self.links: list[str] = []
        self.anchors: set[str] = set()

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        given = dict(attrs)
        self.anchors |= {value for key in ("id", "name") if (value := given.get(key))}
        key = "href" if tag in {"a", "link"} else "src"
        if (value := given.get(key)) is not None:
            self.links.append(value)


def collected(page: Path) -> Links:
    links = Links()
    links.feed(page.read_text(encoding="utf-8"))
    return links


@pytest.mark.slow
def test_the_site_builds_without_a_warning_and_its_links_lead_somewhere(tmp_path: Path) -> None:
    pytest.importorskip("material")
    environment = {**os.environ, "PYTHONPATH": str(ROOT), "NO_MKDOCS_2_WARNING": "1"}
    site = tmp_path / "site"
    command = [sys.executable, "-m", "mkdocs", "build", "--strict", "--quiet", "--site-dir", str(site)]
    done = subprocess.run(command, cwd=ROOT, env=environment, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout.strip(), done.stderr.strip()) == (0, "", "")
    pages = {page.resolve(): collected(page) for page in site.rglob("*.html") if page.name != "404.html"}
    assert len(pages) > 20
    for page, links in pages.items():
        for link in links.links:
            if re.match(r"(?:[a-z]+:|//|/|\Z)", link):
                assert not re.match(r"(?:https?:)?//.*\.(?:css|js|woff2?)\b", link), f"{page.name} loads {link}"
                continue
            path, _, anchor = link.partition("#")
            target = (page.parent / path.partition("?")[0]).resolve() if path else page
            assert target.exists(), f"{page.name}: {link}"
            if anchor and target in pages:
                assert anchor in pages[target].anchors | {"__top"}, f"{page.name}: {link}"
    for name in ("compensations.html", "gallery.html"):
        assert pages[(site / name).resolve()].links.count("") == 0
        assert (site / name).read_text(encoding="utf-8").count("<img") >= 5


@pytest.mark.slow
@pytest.mark.parametrize("page", TUTORIALS, ids=lambda page: page.stem)
def test_a_tutorial_can_be_followed(page: Path, tmp_path: Path) -> None:
    """Every block of the page, in its order, in an empty folder, by the commands that a user has."""
    if shutil.which("sh") is None:
        pytest.skip("the commands are those of a shell")
    commands = tmp_path / "bin"
    commands.mkdir()
    for name, module in (("axcomp", "axcomp"), ("fmpy", "fmpy"), ("python", "")):
        run = f'-m {module} "$@"' if module else '"$@"'
        (commands / name).write_text(f"#!/bin/sh\nexec {sys.executable} {run}\n")
        (commands / name).chmod(0o755)
    work = tmp_path / "work"
    work.mkdir()
    path = f"{commands}{os.pathsep}{os.environ['PATH']}"
    environment = {**os.environ, "PYTHONPATH": str(ROOT), "PATH": path, "COLUMNS": "80"}
    blocks = re.findall(r"```(sh|python)\n(.*?)```", page.read_text(encoding="utf-8"), re.DOTALL)
    assert len(blocks) >= 4
    for kind, text in blocks:
        command = ["sh", "-e", "-c", text] if kind == "sh" else [sys.executable, "-c", text]
        done = subprocess.run(command, cwd=work, env=environment, capture_output=True, text=True, check=False)
        assert done.returncode == 0, f"{text}\n{done.stdout}\n{done.stderr}"
        assert "Traceback" not in done.stderr
