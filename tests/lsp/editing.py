"""An editor: a client of pygls that starts ``axcomp lsp`` and talks to it over standard input and output."""

from __future__ import annotations

import asyncio
import os
import sys
from collections.abc import Awaitable, Callable
from pathlib import Path
from typing import Any, TypeVar

from lsprotocol import types
from pygls.lsp.client import LanguageClient
from pygls.uris import from_fs_path

ROOT = Path(__file__).parents[2]
T = TypeVar("T")


class Editor:
    """Keeps what the server tells."""

    def __init__(self) -> None:
        self.client = LanguageClient("editor", "1")
        self.diagnostics: dict[str, list[types.Diagnostic]] = {}
        self._news = asyncio.Event()
        self._versions: dict[str, int] = {}

        @self.client.feature(types.TEXT_DOCUMENT_PUBLISH_DIAGNOSTICS)
        def told(params: types.PublishDiagnosticsParams) -> None:
            self.diagnostics[params.uri] = list(params.diagnostics)
            self._news.set()

    async def start(self, folder: Path) -> types.InitializeResult:
        environment = {**os.environ, "PYTHONPATH": str(ROOT)}
        program = "import sys; from axcomp.cli import main; sys.exit(main(['lsp', '--stdio']))"
        await self.client.start_io(sys.executable, "-c", program, env=environment)
        result = await self.client.initialize_async(
            types.InitializeParams(types.ClientCapabilities(), root_uri=from_fs_path(str(folder)))
        )
        self.client.initialized(types.InitializedParams())
        return result

    async def stop(self) -> None:
        await self.client.shutdown_async(None)
        self.client.exit(None)
        await self.client.stop()

    def open(self, path: Path, text: str | None = None) -> str:
        uri = from_fs_path(str(path)) or ""
        source = path.read_text(encoding="utf-8") if text is None else text
        self._versions[uri] = 1
        self._news.clear()
        item = types.TextDocumentItem(uri, "lis", 1, source)
        self.client.text_document_did_open(types.DidOpenTextDocumentParams(item))
        return uri

    def change(self, uri: str, *changes: types.TextDocumentContentChangeEvent) -> None:
        self._versions[uri] += 1
        self._news.clear()
        document = types.VersionedTextDocumentIdentifier(self._versions[uri], uri)
        self.client.text_document_did_change(types.DidChangeTextDocumentParams(document, list(changes)))

    def replace(self, uri: str, start: tuple[int, int], end: tuple[int, int], text: str) -> None:
        where = types.Range(types.Position(*start), types.Position(*end))
        self.change(uri, types.TextDocumentContentChangePartial(where, text))

    async def news(self, seconds: float = 20.0) -> None:
        """Wait for the next diagnostics."""
        await asyncio.wait_for(self._news.wait(), seconds)
        self._news.clear()

    async def until(self, true: Callable[[], bool], seconds: float = 20.0) -> None:
        """Wait until what the server has told makes something true."""
        async with asyncio.timeout(seconds):
            while not true():
                await self._news.wait()
                self._news.clear()

    def codes(self, uri: str) -> list[Any]:
        return [one.code for one in self.diagnostics.get(uri, ())]


def edit(folder: Path, work: Callable[[Editor], Awaitable[T]]) -> T:
    """Do some work with a server that has been started in a folder."""

    async def run() -> T:
        editor = Editor()
        await editor.start(folder)
        try:
            return await asyncio.wait_for(work(editor), 60)
        finally:
            await editor.stop()

    return asyncio.run(run())


def applied(text: str, edits: list[types.TextEdit]) -> str:
    """Return a text after edits, in units of UTF-16, written independently of the server."""
    lines = text.split("\n")

    def offset(at: types.Position) -> int:
        if at.line >= len(lines):
            return len(text)
        before = sum(len(line) + 1 for line in lines[: at.line])
        line = lines[at.line].encode("utf-16-le")[: 2 * at.character]
        return before + len(line.decode("utf-16-le"))

    for one in sorted(edits, key=lambda e: (e.range.start.line, e.range.start.character), reverse=True):
        text = text[: offset(one.range.start)] + one.new_text + text[offset(one.range.end) :]
    return text


def marked(text: str, where: types.Range) -> str:
    """Return what stands in a range of one line, in units of UTF-16."""
    assert where.start.line == where.end.line
    line = text.split("\n")[where.start.line].encode("utf-16-le")
    return line[2 * where.start.character : 2 * where.end.character].decode("utf-16-le")
