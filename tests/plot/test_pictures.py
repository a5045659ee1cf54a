"""Pictures and the page: labelled with units, 1200 pixels wide, the same bytes every time, and nothing from outside."""

import struct
from dataclasses import replace
from html.parser import HTMLParser

import numpy as np
import pytest
from shown_machines import MACHINE, MEASURED

from axcomp.plot import Content, Map, contents_of, page, png, printed, shown

CONTENTS = [*contents_of(MACHINE), *contents_of(MEASURED, kind="volumetric")]
NAMES = [content.subject.name for content in CONTENTS]


@pytest.mark.parametrize("content", CONTENTS, ids=NAMES)
def test_a_picture_is_1200_pixels_wide_and_all_its_axes_have_labels_with_units(content: Content) -> None:
    figure = content.figure()
    width, height = struct.unpack(">II", png(figure)[16:24])
    assert width == 1200
    assert 300 < height < 2000
    for drawn in (figure, content.against(content).figure()):
        labels = [
            label
            for ax in drawn.axes
            for label in (ax.get_xlabel(), ax.get_ylabel(), getattr(ax, "get_zlabel", str)())
            if label
        ]
        assert len(labels) >= (1 if content.subject.part.startswith("constant") else 2)
        assert all(label.endswith("]") and "[" in label for label in labels)
        assert any(ax.get_title() for ax in drawn.axes)


@pytest.mark.parametrize("name", ["X-leadscrew", "0-volumetric-TCP-error"])
def test_the_same_picture_has_the_same_bytes(name: str) -> None:
    content = CONTENTS[NAMES.index(name)]
    assert png(content.figure()) == png(content.figure())


def test_the_curves_of_a_picture_are_the_table() -> None:
    upper, lower = CONTENTS[NAMES.index("X-leadscrew")].figure().axes
    drawn = [line.get_ydata() for line in upper.lines[:2]]
    assert np.allclose(drawn, [[0, 4, -2], [1, 6, 1]])
    assert np.allclose(lower.lines[0].get_ydata(), [-1, -2, -3])


def test_all_layers_of_a_map_share_one_scale_of_colours() -> None:
    content = CONTENTS[NAMES.index("Z-crosstalk")]
    assert isinstance(content, Map)
    limits = {collection.get_clim() for ax in content.figure().axes[:2] for collection in ax.collections[:1]}
    largest = float(np.abs(content.values()).max())
    assert limits == {(-largest, largest)}


class _Page(HTMLParser):
    def __init__(self, text: str) -> None:
        super().__init__()
        self.tags: list[str] = []
        self.references: list[str] = []
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append(tag)
        self.references += [value or "" for name, value in attrs if name in {"src", "href"}]


def test_a_page_needs_nothing_from_outside() -> None:
    machine = replace(MACHINE, axes=(replace(MACHINE.axes[0], name='X<b>"&'), *MACHINE.axes[1:]))
    contents = contents_of(machine, kind="leadscrew")
    text = page("A <machine>", contents, ["one & two"])
    read = _Page(text)
    assert read.tags.count("img") == read.tags.count("section") == len(contents)
    assert "b" not in read.tags
    assert "machine" not in read.tags
    assert "script" not in read.tags
    assert all(reference.startswith(("data:", "#")) for reference in read.references)
    assert "one &amp; two" in text


def test_numbers_are_printed_with_true_minus_signs() -> None:
    assert shown(-0.0) == "0"
    assert shown(-12.345678) == "−12.346"
    assert printed("X-leadscrew: -4.7 … -.5, 2-3") == "X-leadscrew: −4.7 … −.5, 2-3"
