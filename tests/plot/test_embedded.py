"""Pictures of a page: the smaller of SVG and PNG, lines thinned to what is seen, no rounding blown up."""

from __future__ import annotations

import io
from base64 import b64encode
from urllib.parse import quote

import numpy as np
import pytest
from PIL import Image
from shown_machines import MACHINE, MEASURED

from axcomp.plot import Content, contents_of, embedded, framed_figure, png, svg, thinned

CONTENTS = [*contents_of(MACHINE), *contents_of(MEASURED, kind="volumetric")]


@pytest.mark.parametrize("content", CONTENTS, ids=lambda content: content.subject.name)
def test_a_picture_is_at_most_a_little_larger_than_the_smaller_of_both(content: Content) -> None:
    figure = content.figure()
    both = (len(b64encode(png(figure))), len(quote(svg(figure), safe=" <>='/")))
    assert len(embedded(figure)) <= 1.5 * min(both) + 5000


def test_a_thinned_line_lies_on_the_whole_one_within_a_pixel() -> None:
    x = np.linspace(-500.0, 500.0, 20_000)
    y = np.round(20.0 * np.sin(x / 50.0), 1)
    seen_x, seen_y = thinned(x, y)
    assert len(seen_x) < len(x) / 4
    assert (seen_x[0], seen_y[0]) == pytest.approx((x[0], y[0]))
    assert (seen_x[-1], seen_y[-1]) == pytest.approx((x[-1], y[-1]))
    pixel = np.ptp(y) / 672
    assert np.abs(np.interp(x, seen_x, seen_y) - y).max() < 1.5 * pixel + 0.05
    assert seen_y.max() == pytest.approx(y.max(), abs=pixel)


def test_paper_is_white() -> None:
    figure = framed_figure()
    figure.add_subplot().plot([0.0, 1.0], [0.0, 1.0])
    assert Image.open(io.BytesIO(png(figure))).convert("RGB").getpixel((0, 0)) == (255, 255, 255)


def test_rounding_is_not_blown_up_to_full_size() -> None:
    [plane] = [one for one in CONTENTS if one.subject.name == "X-plane"]
    nothing = plane.against(plane).figure()
    assert nothing.axes[0].collections[0].get_clim() == (-0.1, 0.1)
    [screw] = [one for one in CONTENTS if one.subject.name == "X-leadscrew"]
    below = screw.against(screw).figure().axes[1]
    assert np.ptp(below.get_ylim()) >= 0.1
