"""The server: what an editor asks, answered by the rooms below."""

from __future__ import annotations

import asyncio
import os
import sys
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from lsprotocol import types
from pygls.exceptions import JsonRpcInvalidParams
from pygls.lsp.server import LanguageServer
from pygls.uris import from_fs_path, to_fs_path

from .. import __version__
from ..kinds import Severity
from ..lint import fixes_of, formatted, help_address
from ..lists import Document, Finding, number
from .entries import NAME, TOKENS, completion, entry_at, hover, inlay_hints, semantic_tokens, symbols
from .links import NUMBER_MAX, Place, definitions, is_axis_number, numbers_of, value_place
from .sources import Sources, by_file
from .text import Text, span

_IDLE = 0.4
"""Seconds without a change after which tables are judged too."""

_SEVERITIES = {
    Severity.ERROR: types.DiagnosticSeverity.Error,
    Severity.WARNING: types.DiagnosticSeverity.Warning,
    Severity.INFO: types.DiagnosticSeverity.Information,
}


class _Server(LanguageServer):
    """Keeps the lists, and tells editors what there is to say about them."""

    def __init__(self) -> None:
        super().__init__("axcomp", __version__, types.TextDocumentSyncKind.Incremental)
        self.sources = Sources()
        self._told: dict[Path, set[Path]] = {}
        self._waiting: dict[Path, asyncio.TimerHandle] = {}

    def lines(self, path: Path) -> list[str]:
        """Return the lines of a file, as an editor holds it or as it lies on the disk."""
        text = self.sources.open.get(path)
        if text is not None:
            return text.source.replace("\r\n", "\n").replace("\r", "\n").split("\n")
        try:
            document = Document(path, path.read_bytes())
            return document.text.split("\n")
        except (OSError, ValueError):
            return []

    def tell(self, path: Path, later: bool = True) -> None:
        """Send what there is to say about the machine of a file: about its entries now, about its tables soon."""
        machine = self.sources.machine_of(path)
        self.sources.reading(machine, again=True)
        self._send(machine, self.sources.told(machine))
        if (handle := self._waiting.pop(machine, None)) is not None:
            handle.cancel()
        if later:
            self._waiting[machine] = asyncio.get_running_loop().call_later(_IDLE, self._judge, machine)

    def _judge(self, machine: Path) -> None:
        self._waiting.pop(machine, None)
        self._send(machine, list(self.sources.checked(machine).findings))

    def _send(self, machine: Path, findings: Sequence[Finding]) -> None:
        found = by_file(findings)
        base = self.sources.settings(machine).help_address
        files = set(found) | (self.sources.files(machine) & set(self.sources.open))
        for path in files | self._told.get(machine, set()):
            lines = self.lines(path)
            diagnostics = [_diagnostic(one, lines, base) for one in found.get(path, ())]
            self._publish(path, diagnostics)
        self._told[machine] = set(found)
        used = {self.sources.machine_of(path) for path in self.sources.open} | {machine}
        for other in [one for one in self._told if one not in used]:
            # Its lists belong to another machine by now, or nobody looks at them.
            for path in self._told.pop(other) - set(found):
                self._publish(path, [])

    def _publish(self, path: Path, diagnostics: list[types.Diagnostic]) -> None:
        self.text_document_publish_diagnostics(types.PublishDiagnosticsParams(_uri(path), diagnostics))

    def at(self, uri: str) -> tuple[Path, Document | None, list[str]]:
        """Return path, list and lines of a file."""
        path = path_of(uri)
        return path, self.sources.document(path), self.lines(path)

    def range(self, place: Place) -> types.Range:
        """Return where something stands, as editors count."""
        return span(self.lines(place.path), place.line, place.start, place.end)


def path_of(uri: str) -> Path:
    """Return the path of a file."""
    return Path(to_fs_path(uri) or uri)


def _diagnostic(finding: Finding, lines: Sequence[str], base: str) -> types.Diagnostic:
    at = max(finding.line - 1, 0)
    line = lines[at] if at < len(lines) else ""
    name = NAME.match(line) if finding.column else None
    start, end = len(line) - len(line.lstrip()), len(line.rstrip())
    if name is not None and name.start(1) == finding.column - 1:
        start, end = name.span(1)
    return types.Diagnostic(
        range=span(lines, at, start, max(end, start)),
        message=str(finding).partition(f" {finding.code}: ")[2],
        severity=_SEVERITIES[finding.severity],
        code=finding.code,
        code_description=types.CodeDescription(help_address(finding.code, base)),
        source="axcomp",
        tags=[types.DiagnosticTag.Unnecessary] if finding.code == "AXC-UNUSED" else None,
    )


def serve() -> None:
    """Serve an editor over standard input and output until it ends."""
    # It closes what it has written to; the command has to flush what remains.
    make_server().start_io(sys.stdin.buffer, os.fdopen(os.dup(sys.stdout.fileno()), "wb"))


def make_server() -> _Server:
    """Return a server that knows what to answer."""
    server = _Server()
    _synchronize(server)
    _look_up(server)
    _change(server)
    return server


def _synchronize(server: _Server) -> None:
    @server.feature(types.TEXT_DOCUMENT_DID_OPEN)
    def opened(params: types.DidOpenTextDocumentParams) -> None:
        path = path_of(params.text_document.uri)
        server.sources.hold(path, Text(params.text_document.text))
        server.tell(path)

    @server.feature(types.TEXT_DOCUMENT_DID_CHANGE)
    def changed(params: types.DidChangeTextDocumentParams) -> None:
        path = path_of(params.text_document.uri)
        text = server.sources.open.get(path) or Text("")
        for change in params.content_changes:
            text.change(change)
        server.sources.hold(path, text)
        server.tell(path)

    @server.feature(types.TEXT_DOCUMENT_DID_SAVE)
    def saved(params: types.DidSaveTextDocumentParams) -> None:
        server.tell(path_of(params.text_document.uri))

    @server.feature(types.TEXT_DOCUMENT_DID_CLOSE)
    def closed(params: types.DidCloseTextDocumentParams) -> None:
        path = path_of(params.text_document.uri)
        server.sources.close(path)
        server.tell(path)

    @server.feature(types.WORKSPACE_DID_CHANGE_WATCHED_FILES)
    def changed_on_disk(params: types.DidChangeWatchedFilesParams) -> None:
        paths = [path_of(change.uri) for change in params.changes]
        for path in paths:
            server.sources.forget(path)
        for machine in {server.sources.machine_of(path) for path in (*paths, *server.sources.open)}:
            server.tell(machine)


def _look_up(server: _Server) -> None:
    @server.feature(types.TEXT_DOCUMENT_HOVER)
    def hovered(params: types.HoverParams) -> types.Hover | None:
        path, document, lines = server.at(params.text_document.uri)
        reading = server.sources.reading(server.sources.machine_of(path))
        return None if document is None else hover(document, lines, params.position, reading)

    @server.feature(types.TEXT_DOCUMENT_COMPLETION, types.CompletionOptions(trigger_characters=[".", " "]))
    def completed(params: types.CompletionParams) -> list[types.CompletionItem]:
        path, document, lines = server.at(params.text_document.uri)
        return [] if document is None else completion(document, lines, params.position, path.parent)

    @server.feature(types.TEXT_DOCUMENT_DEFINITION)
    def defined(params: types.DefinitionParams) -> list[types.Location]:
        path, document, _ = server.at(params.text_document.uri)
        if document is None:
            return []
        found = definitions(document, params.position.line, server.sources.reading(server.sources.machine_of(path)))
        return [_location(server, place) for place in found]

    @server.feature(types.TEXT_DOCUMENT_REFERENCES)
    def referred(params: types.ReferenceParams) -> list[types.Location]:
        path, document, _ = server.at(params.text_document.uri)
        entry = None if document is None else entry_at(document, params.position.line)
        if document is None or entry is None or not is_axis_number(document, entry):
            return []
        reading = server.sources.reading(server.sources.machine_of(path))
        return [_location(server, place) for place in numbers_of(reading, int(number(entry.value) or 0))]

    @server.feature(types.TEXT_DOCUMENT_DOCUMENT_SYMBOL)
    def listed(params: types.DocumentSymbolParams) -> list[types.DocumentSymbol]:
        _, document, lines = server.at(params.text_document.uri)
        return [] if document is None else symbols(document, lines)

    @server.feature(types.TEXT_DOCUMENT_INLAY_HINT)
    def hinted(params: types.InlayHintParams) -> list[types.InlayHint]:
        path, document, lines = server.at(params.text_document.uri)
        reading = server.sources.reading(server.sources.machine_of(path))
        return [] if document is None else inlay_hints(document, lines, params.range, reading)

    legend = types.SemanticTokensLegend(list(TOKENS), [])

    @server.feature(types.TEXT_DOCUMENT_SEMANTIC_TOKENS_FULL, legend)
    def coloured(params: types.SemanticTokensParams) -> types.SemanticTokens:
        _, document, lines = server.at(params.text_document.uri)
        return types.SemanticTokens([] if document is None else semantic_tokens(document, lines))


def _change(server: _Server) -> None:
    @server.feature(types.TEXT_DOCUMENT_PREPARE_RENAME)
    def prepared(params: types.PrepareRenameParams) -> types.Range | None:
        _, document, _ = server.at(params.text_document.uri)
        entry = None if document is None else entry_at(document, params.position.line)
        if document is None or entry is None or not is_axis_number(document, entry):
            return None
        return server.range(value_place(document, entry))

    @server.feature(types.TEXT_DOCUMENT_RENAME, types.RenameOptions(prepare_provider=True))
    def renamed(params: types.RenameParams) -> types.WorkspaceEdit | None:
        path, document, _ = server.at(params.text_document.uri)
        entry = None if document is None else entry_at(document, params.position.line)
        if document is None or entry is None or not is_axis_number(document, entry):
            return None
        reading = server.sources.reading(server.sources.machine_of(path))
        new = number(params.new_name)
        if not isinstance(new, int) or not 0 < new <= NUMBER_MAX:
            raise JsonRpcInvalidParams(f"{params.new_name!r} is no logical axis number: these are 1 to {NUMBER_MAX}")
        if any(axis.number == new for axis in reading.machine.axes):
            raise JsonRpcInvalidParams(f"there is an axis {new} already")
        edits: dict[str, list[types.TextEdit]] = {}
        for place in numbers_of(reading, int(number(entry.value) or 0)):
            edits.setdefault(_uri(place.path), []).append(types.TextEdit(server.range(place), str(new)))
        return types.WorkspaceEdit(changes=dict(edits))

    @server.feature(types.TEXT_DOCUMENT_FORMATTING)
    def laid_out(params: types.DocumentFormattingParams) -> list[types.TextEdit]:
        _, document, lines = server.at(params.text_document.uri)
        text = None if document is None else formatted(document)
        return [] if text is None else _edits(lines, text.split("\n"))

    kinds = [types.CodeActionKind.QuickFix]

    @server.feature(types.TEXT_DOCUMENT_CODE_ACTION, types.CodeActionOptions(code_action_kinds=list(kinds)))
    def mended(params: types.CodeActionParams) -> list[types.CodeAction]:
        path, document, lines = server.at(params.text_document.uri)
        if document is None or document.kind is None:
            return []
        machine = server.sources.machine_of(path)
        asked = {(one.code, one.range.start.line) for one in params.context.diagnostics if one.source == "axcomp"}
        actions = []
        for finding in server.sources.checked(machine).findings:
            if path_of(_uri(Path(finding.file))) == path and (finding.code, max(finding.line - 1, 0)) in asked:
                told = [one for one in params.context.diagnostics if one.code == finding.code]
                actions += _actions(document, finding, lines, params.text_document.uri, told)
        return actions


def _actions(
    document: Document, finding: Finding, lines: list[str], uri: str, told: list[types.Diagnostic]
) -> list[types.CodeAction]:
    actions = []
    fix = fixes_of(document, replace(finding, file=str(document.path)))
    if fix is not None:
        copy = document.copy()
        copy.edit_lines(fix.changed, fix.added)
        edit = types.WorkspaceEdit(changes={uri: _edits(lines, copy.text.split("\n"))})
        actions.append(types.CodeAction(fix.title, types.CodeActionKind.QuickFix, told, True, edit=edit))
    if finding.line and finding.column:
        end = len(lines[finding.line - 1].rstrip())
        quoted = finding.parameter and (entry := entry_at(document, finding.line - 1)) and number(entry.value) is None
        comment = f"( axcomp: ignore {finding.code} )" if quoted else f"# axcomp: ignore {finding.code}"
        text_edit = types.TextEdit(span(lines, finding.line - 1, end, end), f" {comment}")
        edit = types.WorkspaceEdit(changes={uri: [text_edit]})
        title = f"Ignore {finding.code} here"
        actions.append(types.CodeAction(title, types.CodeActionKind.QuickFix, told, edit=edit))
    return actions


def _edits(before: list[str], after: list[str]) -> list[types.TextEdit]:
    """Return how lines become others: what is the same at both ends is not touched."""
    if before == after:
        return []
    least = min(len(before), len(after))
    start = next((i for i in range(least) if before[i] != after[i]), least)
    same = next((i for i in range(least - start) if before[-1 - i] != after[-1 - i]), least - start)
    if same:
        text = "".join(f"{line}\n" for line in after[start : len(after) - same])
        where = types.Range(types.Position(start, 0), types.Position(len(before) - same, 0))
        return [types.TextEdit(where, text)]
    # Behind the last line there is no line end: that of the line before goes or stays with it.
    at = max(start - 1, 0)
    first = span(before, at, len(before[at]), len(before[at])).start if start else types.Position(0, 0)
    last = span(before, len(before) - 1, len(before[-1]), len(before[-1])).end
    text = ("\n" if start and start < len(after) else "") + "\n".join(after[start:])
    return [types.TextEdit(types.Range(first, last), text)]


def _uri(path: Path) -> str:
    return from_fs_path(str(path)) or ""


def _location(server: _Server, place: Place) -> types.Location:
    return types.Location(_uri(place.path), server.range(place))
