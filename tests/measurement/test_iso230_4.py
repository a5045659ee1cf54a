"""ISO 230-4: its figures against independent computations, and what they come from against what was put in."""

from __future__ import annotations

import json
from itertools import combinations

import numpy as np
import pytest
from scipy.optimize import minimize

from axcomp.cli import main
from axcomp.measurement import evaluate_circular, least_squares_circle, minimum_zone, read_circular


def separation(centre, points):
    distances = np.hypot(*(points - centre).T)
    return np.ptp(distances)


def around(radius, deviations, angles, centre=(0.0, 0.0)):
    """mm, deviations in µm."""
    r = radius + 1e-3 * deviations
    return np.column_stack([centre[0] + r * np.cos(angles), centre[1] + r * np.sin(angles)])


def drawn(seed, n=720, size=5.0):
    random = np.random.default_rng(seed)
    angles = np.linspace(0.0, 2.0 * np.pi, n, endpoint=False)
    deviations = sum(random.normal(0.0, size / k) * np.cos(k * angles + random.uniform(0, 6)) for k in range(2, 9))
    return around(100.0, deviations + random.normal(0.0, 0.2 * size, n), angles, random.normal(0.0, 0.05, 2)), random


@pytest.mark.parametrize("seed", range(6))
def test_the_minimum_zone_is_what_scipy_finds_by_a_search(seed):
    points, random = drawn(seed)
    zone = minimum_zone(points)
    best = np.inf
    for _ in range(4):
        start = points.mean(axis=0) + random.normal(0.0, 0.003, 2)
        options = {"xatol": 1e-12, "fatol": 1e-14, "maxiter": 4000, "maxfev": 4000}
        for _ in range(3):
            found = minimize(separation, start, args=(points,), method="Nelder-Mead", options=options)
            start = found.x
        best = min(best, found.fun)
    assert 1e3 * zone.width <= 1e3 * best + 1e-9
    assert 1e3 * zone.width == pytest.approx(1e3 * best, abs=1e-6)


@pytest.mark.parametrize("seed", range(5))
def test_the_minimum_zone_is_the_least_of_all_choices_of_touching_points(seed):
    """Two points outside and two inside: their bisectors cross in the centre. All choices of 12 points are tried."""
    random = np.random.default_rng(seed)
    points = around(50.0, random.normal(0.0, 8.0, 12), np.sort(random.uniform(0.0, 2.0 * np.pi, 12)))
    best = np.inf
    pairs = list(combinations(range(12), 2))
    for a, b in combinations(pairs, 2):
        rows = np.array([points[a[1]] - points[a[0]], points[b[1]] - points[b[0]]])
        right = [0.5 * (points[p[1]] @ points[p[1]] - points[p[0]] @ points[p[0]]) for p in (a, b)]
        if abs(np.linalg.det(rows)) > 1e-9:
            best = min(best, separation(np.linalg.solve(rows, right), points))
    assert 1e3 * minimum_zone(points).width == pytest.approx(1e3 * best, abs=1e-6)


def test_a_coarse_circle_and_one_off_its_centre_have_the_same_zone():
    points, _ = drawn(3, n=60, size=300.0)
    width = minimum_zone(points).width
    assert minimum_zone(points + np.array([40.0, -70.0])).width == pytest.approx(width, abs=1e-9)
    turned = points @ np.array([[0.6, -0.8], [0.8, 0.6]])
    assert minimum_zone(turned).width == pytest.approx(width, abs=1e-9)


def test_the_least_squares_circle_is_where_the_slopes_of_the_squares_vanish():
    points, _ = drawn(1)
    circle = least_squares_circle(points)

    def squares(x):
        return np.sum((np.hypot(*(points - x[:2]).T) - x[2]) ** 2)

    at, step = np.array([*circle.centre, circle.radius]), 1e-5
    for axis in np.eye(3) * step:
        assert abs(squares(at + axis) - squares(at - axis)) / (2 * step) < 1e-8


ANGLES = np.radians(np.arange(-30.0, 390.0, 0.25))


def path_of(direction, scale=30e-6, square=20e-6, play=(4.0, 6.0), servo=1.5, peaks=0.0, radius=100.0):
    """A ball-bar's deviations, µm, made axis by axis: errors of x and y, seen along the radius."""
    angles = ANGLES if direction > 0 else -ANGLES
    x, y = radius * np.cos(angles), radius * np.sin(angles)
    vx, vy = -direction * np.sin(angles), direction * np.cos(angles)
    ex = 1e3 * (0.5 * scale * x - square * y) - 0.5 * play[0] * np.sign(vx)
    ey = 1e3 * (-0.5 * scale * y) - 0.5 * play[1] * np.sign(vy)
    out = ex * np.cos(angles) + ey * np.sin(angles) + servo * direction * np.sin(2.0 * angles) + 3.0
    on_the_way = np.degrees(direction * angles)
    for quadrant in (0.0, 90.0, 180.0, 270.0, 360.0):
        out += peaks * np.exp(-0.5 * ((on_the_way - quadrant - 4.0) / 1.2) ** 2)
    return np.degrees(angles), out


def ball_bar(file, *directions, header="", noise=0.0, **errors):
    rows, random = [], np.random.default_rng(0)
    for direction in directions:
        angles, out = path_of(direction, **errors)
        out = out + random.normal(0.0, noise, len(out))
        rows += [f"{a:.6f},{d:.9f},{'+' if direction > 0 else '-'}" for a, d in zip(angles, out, strict=True)]
    file.write_text("# radius: 100\n# plane: XY\n" + header + "angle,deviation,direction\n" + "\n".join(rows) + "\n")
    return file


def test_what_it_comes_from_is_found(tmp_path):
    result = evaluate_circular(read_circular(ball_bar(tmp_path / "b.csv", 1, -1)))
    assert result.scale_mismatch == pytest.approx(30.0, abs=0.3)
    assert result.squareness == pytest.approx(20.0, abs=0.3)
    assert result.servo_mismatch == pytest.approx(1.5, abs=0.05)
    assert result.reversal == {"X": pytest.approx(4.0, abs=0.05), "Y": pytest.approx(6.0, abs=0.05)}
    assert result.left < 0.02


def test_the_angle_between_the_axes_is_above_90_degrees_where_squareness_is():
    """x = x − s · y leans the second axis away from the first one."""
    direction = np.array([-20e-6, 1.0])
    assert np.degrees(np.arccos(direction[0] / np.hypot(*direction))) > 90.0


def test_noise_and_peaks_do_not_hide_it(tmp_path):
    result = evaluate_circular(read_circular(ball_bar(tmp_path / "b.csv", 1, -1, noise=0.3, peaks=8.0)))
    assert result.scale_mismatch == pytest.approx(30.0, abs=2.0)
    assert result.squareness == pytest.approx(20.0, abs=2.0)
    assert result.reversal == {"X": pytest.approx(4.0, abs=0.3), "Y": pytest.approx(6.0, abs=0.3)}


def test_peaks_stand_out_with_their_sign(tmp_path):
    none = {"scale": 0.0, "square": 0.0, "play": (0.0, 0.0), "servo": 0.0}
    result = evaluate_circular(read_circular(ball_bar(tmp_path / "b.csv", 1, -1, peaks=-7.0, **none)))
    for path in result.paths:
        assert path.peaks == {end: pytest.approx(-7.0, abs=0.1) for end in ("+X", "+Y", "-X", "-Y")}


def test_figures_are_those_of_the_standard(tmp_path):
    test = read_circular(ball_bar(tmp_path / "b.csv", 1, -1, peaks=5.0))
    result = evaluate_circular(test)
    both = np.concatenate([path.points for path in test.paths])
    assert result.G_bidirectional == pytest.approx(1e3 * minimum_zone(both).width, abs=1e-6)
    assert result.G_bidirectional > max(path.G for path in result.paths) - 1e-9
    assert pytest.approx(1e3 * (least_squares_circle(both).radius - 100.0), abs=1e-9) == result.D
    for path, of in zip(result.paths, test.paths, strict=True):
        out = 1e3 * (np.hypot(*(of.points - least_squares_circle(of.points).centre).T) - 100.0)
        assert (path.F_max, path.F_min) == (pytest.approx(out.max(), abs=1e-6), pytest.approx(out.min(), abs=1e-6))
        assert path.F_max - path.F_min >= path.G
    set_up = evaluate_circular(test, set_up=True)
    assert set_up.paths[0].F_max == pytest.approx(path_of(1, peaks=5.0)[1].max(), abs=1e-5)


def test_an_offset_of_the_instrument_changes_nothing_but_f_about_its_centre(tmp_path):
    angles = np.radians(np.arange(0.0, 361.0, 0.5))
    files = []
    for name, centre in (("a", (0.0, 0.0)), ("b", (0.02, -0.03))):
        points = around(50.0, 4.0 * np.cos(3.0 * angles), angles, centre)
        files.append(tmp_path / f"{name}.csv")
        rows = "\n".join(f"{x:.9f};{y:.9f}" for x, y in points)
        files[-1].write_text(f"# radius: 50\nx [mm];y [mm]\n{rows}\n")
    here, there = (evaluate_circular(read_circular(file)).paths[0] for file in files)
    assert pytest.approx(there.G, abs=1e-5) == here.G
    assert here.F_max == pytest.approx(there.F_max, abs=1e-4)
    assert abs(evaluate_circular(read_circular(files[1]), set_up=True).paths[0].F_max - here.F_max) > 20.0


def test_times_become_angles_by_the_feed(tmp_path):
    angles, out = path_of(-1)
    file = tmp_path / "t.csv"
    head = "# radius: 100\n# feed: 1200\n# direction: cw\n# start: 30\n"
    at = (angles[0] - angles) / np.degrees(1.0) * 100.0 / 20.0
    file.write_text(head + "time,deviation\n" + "\n".join(f"{t:.8f},{d:.8f}" for t, d in zip(at, out, strict=True)))
    path = evaluate_circular(read_circular(file)).paths[0]
    bar = evaluate_circular(read_circular(ball_bar(tmp_path / "b.csv", -1))).paths[0]
    assert (path.direction, path.G) == (-1, pytest.approx(bar.G, abs=1e-4))


def test_the_command_prints_draws_and_joins(tmp_path, capsys):
    files = [str(ball_bar(tmp_path / f"{n}.csv", way, noise=0.2)) for n, way in (("a", 1), ("b", -1))]
    picture = tmp_path / "p.png"
    assert main(["measure", *files, "--together", "--plot", str(picture)]) == 0
    said = capsys.readouterr().out
    assert picture.stat().st_size > 10_000
    for word in ("G↺", "G↻", "G(b)", "F↺max", "squareness", "scale mismatch", "reversal value X", "+X"):
        assert word in said
    assert main(["measure", files[0], "--format", "json"]) == 0
    (result,) = json.loads(capsys.readouterr().out)
    assert result["standard"] == "ISO 230-4"
    assert result["G_bidirectional"] is None
    assert any("One direction" in note for note in result["notes"])


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("angle,deviation\n" + "\n".join(f"{a},1" for a in range(0, 360, 10)), "radius is not known"),
        ("# radius: 100\nangle,deviation\n0,1\n10,2\n", "at least 16"),
        ("# radius: 100\ntime,deviation\n" + "\n".join(f"{a},1" for a in range(40)), "need the feed"),
        (
            "# radius: 100\n# feed: 500\ntime,deviation\n" + "\n".join(f"{a},1" for a in range(40)),
            "do not say the direction",
        ),
        ("# radius: ten\nangle,deviation\n" + "\n".join(f"{a},1" for a in range(0, 360, 10)), "“ten” is no number"),
        (
            "# radius: 9\nangle,deviation,direction\n" + "\n".join(f"{a},1,-" for a in range(0, 360, 10)),
            "go round the other way",
        ),
    ],
)
def test_what_cannot_be_used_is_refused_with_a_sentence(text, words, tmp_path, capsys):
    file = tmp_path / "c.csv"
    file.write_text(text)
    assert main(["measure", str(file)]) == 1
    assert words in capsys.readouterr().err
