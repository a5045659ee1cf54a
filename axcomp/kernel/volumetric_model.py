"""The kinematic model of a machine with errors, and its inversion (semantics §10).

With R(a, b, c) = Rz(c)·Ry(b)·Rx(a), e the direction of an axis, P its centre, q its position and t = (X0 + EX, …):

linear                A = Trans(R(A0, B0, C0)·e·q) · Trans(t) · R(EA, EB, EC)
rotary, default       A = Trans(t) · R(A0 + EA, …) · Trans(P) · Rot(e, q) · Trans(−P)
rotary, alternative   A = Trans(EX, …) · R(EA, …) · L · Trans(P) · Rot(e, q) · Trans(−P) · L⁻¹,
                      L = Trans(X0, …)·R(A0, …)

W(q) = A₁⁻¹ … A_k⁻¹ · A_{k+1} … A_n · (P0 + tool length · N0), k = workpiece axes. Every A is x ↦ M·x + o, M a rotation.

The errors are those where the machine stands, at q + Δ. With errors that are given, W is linear in the corrections of
X, Y and Z: W(q + Δ) = W(q) + J·Δ. A frame of four columns carries W and J from the tool to the workpiece. Matrices are
row by row.
"""

from __future__ import annotations

from typing import Annotated

from .interpolation import fold
from .record import Vec, zeros
from .trigonometry import HALF_PI, cosine, sine
from .volumetric_errors import errors_at
from .volumetric_records import A0, B0, C0, EA, EB, EC, ERRORS, ERRORS_OF_AXIS, EX, LETTERS, LINEAR, X0, VolumetricTable

DEGREE = HALF_PI / 90.0
FRAME = 12  # W, then the columns of J: those of X, Y and Z in their order from the tool
EVALUATIONS = 3  # of the errors in a cycle
SETTLED = 1e-6  # mm; what another evaluation would change less is left
RESIDUAL = 1e-9  # mm
ITERATIONS = 5
SINGULAR = 1e-6  # volume spanned by the columns of J, which are unit vectors


def correction_at(
    pool: Vec,
    table: VolumetricTable,
    position: Annotated[list[float], LETTERS],
    tool_length: float,
    section: Annotated[list[int], ERRORS],
    correction: Annotated[list[float], LINEAR],
) -> bool:
    """Put Δ with W(q + Δ) = nominal W(q) into ``correction``, which is 0 before; False: X, Y and Z are dependent here.

    The errors are evaluated at q, and where these take the axes again until nothing changes any more. How much they can
    change is known from the steepness of the tables: most machines need two evaluations.
    ``section``: see ``errors_at``.
    """
    place = zeros(LETTERS)
    arm = abs(tool_length) + table.reach
    for letter in range(LETTERS):
        place[letter] = position[letter]
        if letter < LINEAR:
            arm += abs(position[letter])
    found = zeros(LINEAR)
    for _ in range(EVALUATIONS):
        if not correction_at_place(pool, table, position, place, tool_length, section, found):
            return False
        change = 0.0
        for d in range(LINEAR):
            change += abs(found[d] - correction[d])
            correction[d] = found[d]
            place[d] = position[d] + found[d]
        if change * (table.steepness + table.angular_steepness * arm) < SETTLED:
            return True
    return True


def correction_at_place(
    pool: Vec,
    table: VolumetricTable,
    position: Annotated[list[float], LETTERS],
    place: Annotated[list[float], LETTERS],
    tool_length: float,
    section: Annotated[list[int], ERRORS],
    correction: Annotated[list[float], LINEAR],
) -> bool:
    """Put Δ at a position into ``correction``, with the errors at another place."""
    errors = zeros(ERRORS)
    errors_at(pool, table, place, section, errors)
    return correction_with(table, position, tool_length, errors, correction)


def correction_with(
    table: VolumetricTable,
    position: Annotated[list[float], LETTERS],
    tool_length: float,
    errors: Annotated[list[float], ERRORS],
    correction: Annotated[list[float], LINEAR],
) -> bool:
    """Put Δ into ``correction`` for errors that are given; False: X, Y and Z are dependent here.

    Newton's method, whose first step is all but exact because W is linear in Δ; the nominal machine decides whether the
    position is singular.
    """
    nominal = zeros(FRAME)
    actual = zeros(FRAME)
    carry_to_workpiece(table, position, tool_length, errors, nominal, actual)
    if abs(volume(nominal)) < SINGULAR or abs(volume(actual)) < SINGULAR:
        return False
    inverse = zeros(9)
    invert(actual, inverse)
    residual = zeros(LINEAR)
    change = zeros(LINEAR)  # of the linear axes in the order of the columns of J
    for _ in range(ITERATIONS):
        largest = 0.0
        for d in range(LINEAR):
            residual[d] = (actual[d] - nominal[d]) + (
                actual[3 + d] * change[0] + actual[6 + d] * change[1] + actual[9 + d] * change[2]
            )
            largest = max(largest, abs(residual[d]))
        if largest < RESIDUAL:
            for d in range(LINEAR):
                correction[d] = change[table.column[d]]
            return True
        turn(inverse, residual)
        for d in range(LINEAR):
            change[d] -= residual[d]
    return False


def carry_to_workpiece(
    table: VolumetricTable,
    position: Annotated[list[float], LETTERS],
    tool_length: float,
    errors: Annotated[list[float], ERRORS],
    nominal: Annotated[list[float], FRAME],
    actual: Annotated[list[float], FRAME],
) -> None:
    """Put W and J at a position into the frames, which are 0 before: without and with errors."""
    for d in range(LINEAR):
        nominal[d] = table.tool_position[d] + tool_length * table.tool_orientation[d]
        actual[d] = nominal[d]
    m = zeros(9)
    o = zeros(3)
    along = zeros(3)
    columns = 1  # of the frames that are in use
    for k in range(table.chain_length):
        place = table.chain_length - 1 - k
        letter = table.chain[place]
        q = position[letter]
        side = -1.0 if place < table.workpiece_axes else 1.0
        if letter < LINEAR:
            at = 3 * columns
            for d in range(LINEAR):
                along[d] = side * table.direction[3 * letter + d]
                nominal[d] += along[d] * q
                nominal[at + d] = along[d]
            if table.exact[letter]:
                for d in range(LINEAR):
                    actual[d] += along[d] * q
                    actual[at + d] = along[d]
            else:
                linear_axis(letter, side * q, errors, m, o, along)
                if side < 0.0:
                    for d in range(LINEAR):
                        actual[at + d] = along[d]
                    transpose(m)
                    apply(m, o, side, columns + 1, actual)
                else:
                    apply(m, o, side, columns, actual)
                    for d in range(LINEAR):
                        actual[at + d] = along[d]
            columns += 1
        else:
            nominal_rotary_axis(table, letter, side * q, m, o)
            apply(m, o, 1.0, columns, nominal)
            if table.exact[letter]:
                apply(m, o, 1.0, columns, actual)
            else:
                rotary_axis(table, letter, q, errors, m, o)
                if side < 0.0:
                    transpose(m)
                apply(m, o, side, columns, actual)


def apply(
    m: Annotated[list[float], 9],
    o: Annotated[list[float], 3],
    side: float,
    columns: int,
    frame: Annotated[list[float], FRAME],
) -> None:
    """Map the first columns of a frame by x ↦ M·x + o; if ``side`` is negative by x ↦ M·(x − o)."""
    if side < 0.0:
        for d in range(LINEAR):
            frame[d] -= o[d]
    xx = m[0]
    xy = m[1]
    xz = m[2]
    yx = m[3]
    yy = m[4]
    yz = m[5]
    zx = m[6]
    zy = m[7]
    zz = m[8]
    for k in range(columns):
        at = 3 * k
        x = frame[at]
        y = frame[at + 1]
        z = frame[at + 2]
        frame[at] = xx * x + xy * y + xz * z
        frame[at + 1] = yx * x + yy * y + yz * z
        frame[at + 2] = zx * x + zy * y + zz * z
    if side > 0.0:
        for d in range(LINEAR):
            frame[d] += o[d]


def linear_axis(
    letter: int,
    q: float,
    errors: Annotated[list[float], ERRORS],
    m: Annotated[list[float], 9],
    o: Annotated[list[float], 3],
    along: Annotated[list[float], 3],
) -> None:
    """Put the map of X, Y or Z into ``m`` and ``o``; ``along``, the nominal direction, becomes the actual one.

    At the workpiece ``q`` and ``along`` both have the opposite sign.
    """
    e = ERRORS_OF_AXIS * letter
    if errors[e + A0] != 0.0 or errors[e + B0] != 0.0 or errors[e + C0] != 0.0:
        rotation(errors[e + A0], errors[e + B0], errors[e + C0], m)
        turn(m, along)
    for d in range(LINEAR):
        o[d] = along[d] * q + (errors[e + X0 + d] + errors[e + EX + d])
    rotation(errors[e + EA], errors[e + EB], errors[e + EC], m)


def nominal_rotary_axis(
    table: VolumetricTable, letter: int, q: float, m: Annotated[list[float], 9], o: Annotated[list[float], 3]
) -> None:
    """Put the map of A, B or C without errors into ``m`` and ``o``; ``q`` in °."""
    axis = zeros(3)
    center = zeros(3)
    for d in range(LINEAR):
        axis[d] = table.direction[3 * letter + d]
        center[d] = table.center[3 * (letter - LINEAR) + d]
    turn_about(axis, center, q, m, o)


def rotary_axis(
    table: VolumetricTable,
    letter: int,
    q: float,
    errors: Annotated[list[float], ERRORS],
    m: Annotated[list[float], 9],
    o: Annotated[list[float], 3],
) -> None:
    """Put the map of A, B or C into ``m`` and ``o``; ``q`` in °."""
    e = ERRORS_OF_AXIS * letter
    axis = zeros(3)
    center = zeros(3)
    tilt = zeros(9)
    for d in range(LINEAR):
        axis[d] = table.direction[3 * letter + d]
        center[d] = table.center[3 * (letter - LINEAR) + d]
    if table.alternative:
        # L · Trans(P) · Rot(e, q) · Trans(−P) · L⁻¹ turns about R(A0, …)·e through L·P.
        rotation(errors[e + A0], errors[e + B0], errors[e + C0], tilt)
        turn(tilt, axis)
        turn(tilt, center)
        for d in range(LINEAR):
            center[d] += errors[e + X0 + d]
        rotation(errors[e + EA], errors[e + EB], errors[e + EC], tilt)
    else:
        rotation(
            errors[e + A0] + errors[e + EA], errors[e + B0] + errors[e + EB], errors[e + C0] + errors[e + EC], tilt
        )
    turn_about(axis, center, q, m, o)
    multiply_from_left(tilt, m)
    turn(tilt, o)
    for d in range(LINEAR):
        o[d] += errors[e + EX + d]
        if not table.alternative:
            o[d] += errors[e + X0 + d]


def turn_about(
    axis: Annotated[list[float], 3],
    center: Annotated[list[float], 3],
    q: float,
    m: Annotated[list[float], 9],
    o: Annotated[list[float], 3],
) -> None:
    """Put the turn by ``q`` in ° about an axis through a point into ``m`` and ``o``; the point is lost."""
    rotation_about(axis, q, m)
    for d in range(LINEAR):
        o[d] = center[d]
    turn(m, center)
    for d in range(LINEAR):
        o[d] -= center[d]


def rotation(a: float, b: float, c: float, m: Annotated[list[float], 9]) -> None:
    """Put Rz(c)·Ry(b)·Rx(a) into ``m``, angles in rad."""
    if a == 0.0 and b == 0.0 and c == 0.0:
        for i in range(9):
            m[i] = 0.0
        for i in range(LINEAR):
            m[4 * i] = 1.0
        return
    sa = sine(a)
    ca = cosine(a)
    sb = sine(b)
    cb = cosine(b)
    sc = sine(c)
    cc = cosine(c)
    m[0] = cb * cc
    m[1] = sa * sb * cc - ca * sc
    m[2] = ca * sb * cc + sa * sc
    m[3] = cb * sc
    m[4] = sa * sb * sc + ca * cc
    m[5] = ca * sb * sc - sa * cc
    m[6] = -sb
    m[7] = sa * cb
    m[8] = ca * cb


def rotation_about(e: Annotated[list[float], 3], q: float, m: Annotated[list[float], 9]) -> None:
    """Put the rotation by ``q`` in ° about the unit vector ``e`` into ``m``."""
    angle = fold(q, 0.0, 360.0) * DEGREE
    s = sine(angle)
    c = cosine(angle)
    for i in range(LINEAR):
        for j in range(LINEAR):
            m[3 * i + j] = (1.0 - c) * e[i] * e[j]
        m[4 * i] += c
    m[1] -= s * e[2]
    m[2] += s * e[1]
    m[3] += s * e[2]
    m[5] -= s * e[0]
    m[6] -= s * e[1]
    m[7] += s * e[0]


def turn(m: Annotated[list[float], 9], v: Annotated[list[float], 3]) -> None:
    """Multiply a vector by a matrix."""
    x = v[0]
    y = v[1]
    z = v[2]
    v[0] = m[0] * x + m[1] * y + m[2] * z
    v[1] = m[3] * x + m[4] * y + m[5] * z
    v[2] = m[6] * x + m[7] * y + m[8] * z


def transpose(m: Annotated[list[float], 9]) -> None:
    """Replace a rotation by its inverse."""
    for i in range(LINEAR):
        for j in range(i):
            upper = m[3 * j + i]
            m[3 * j + i] = m[3 * i + j]
            m[3 * i + j] = upper


def multiply_from_left(a: Annotated[list[float], 9], m: Annotated[list[float], 9]) -> None:
    """Replace ``m`` by a·m."""
    for j in range(LINEAR):
        x = m[j]
        y = m[3 + j]
        z = m[6 + j]
        for i in range(LINEAR):
            m[3 * i + j] = a[3 * i] * x + a[3 * i + 1] * y + a[3 * i + 2] * z


def volume(frame: Annotated[list[float], FRAME]) -> float:
    """Return the determinant of J."""
    return (
        frame[3] * (frame[7] * frame[11] - frame[8] * frame[10])
        + frame[4] * (frame[8] * frame[9] - frame[6] * frame[11])
        + frame[5] * (frame[6] * frame[10] - frame[7] * frame[9])
    )


def invert(frame: Annotated[list[float], FRAME], inverse: Annotated[list[float], 9]) -> None:
    """Put the inverse of J into ``inverse``; J is not singular."""
    determinant = volume(frame)
    for i in range(LINEAR):
        j = 3 + 3 * ((i + 1) % 3)
        k = 3 + 3 * ((i + 2) % 3)
        inverse[3 * i] = (frame[j + 1] * frame[k + 2] - frame[j + 2] * frame[k + 1]) / determinant
        inverse[3 * i + 1] = (frame[j + 2] * frame[k] - frame[j] * frame[k + 2]) / determinant
        inverse[3 * i + 2] = (frame[j] * frame[k + 1] - frame[j + 1] * frame[k]) / determinant
