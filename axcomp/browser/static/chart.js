// Pictures of tables as SVG: lines and points that one can zoom and read values of, and maps.

/** @typedef {{name: string, unit: string, axis: string}} Quantity */
/** @typedef {{shape: "curve", label: string, note: string, over: Quantity, of: Quantity, x: number[], y: number[],
 *   period: number | null}} Curve */
/** @typedef {{shape: "grid", label: string, note: string, over: [Quantity, Quantity], of: Quantity, x: number[],
 *   y: number[], values: number[][]}} Grid */
/** @typedef {{shape: "scatter", label: string, note: string, over: [Quantity, Quantity], of: Quantity,
 *   places: [number, number][], values: number[]}} Scatter */
/** @typedef {{shape: "rows", label: string, note: string, columns: string[], rows: (string | number)[][]}} Rows */
/** @typedef {Curve | Grid | Scatter | Rows} Part */

const SVG = "http://www.w3.org/2000/svg";
const WIDTH = 560;
const HEIGHT = 260;
const EDGE = { left: 66, right: 14, top: 12, bottom: 42 };
const INSIDE = { width: WIDTH - EDGE.left - EDGE.right, height: HEIGHT - EDGE.top - EDGE.bottom };

/**
 * @param {string} name
 * @param {Record<string, string | number>} attributes
 * @param {...(Node | string)} children
 */
export function svg(name, attributes = {}, ...children) {
  const element = document.createElementNS(SVG, name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, String(value));
  element.append(...children);
  return element;
}

/**
 * @template {keyof HTMLElementTagNameMap} T
 * @param {T} name
 * @param {Record<string, string>} attributes
 * @param {...(Node | string)} children
 */
export function html(name, attributes = {}, ...children) {
  const element = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
  element.append(...children);
  return element;
}

/** @param {number} value */
export function figure(value) {
  if (value === 0) return "0";
  return Number(value.toPrecision(Math.abs(value) >= 1000 ? 6 : 4)).toString().replace("-", "−");
}

/** @param {Quantity} quantity */
function named(quantity) {
  return `${quantity.name}${quantity.axis ? ` of ${quantity.axis}` : ""} [${quantity.unit}]`;
}

/**
 * @param {number} low
 * @param {number} high
 */
function ticks(low, high) {
  const rough = (high - low) / 5;
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].map((one) => one * power).find((one) => one >= rough) ?? rough;
  const found = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; k++) found.push(k * step);
  return found;
}

/** @param {readonly number[]} values */
function span(values) {
  let low = Infinity;
  let high = -Infinity;
  for (const value of values) {
    low = Math.min(low, value);
    high = Math.max(high, value);
  }
  return high > low ? [low, high] : [low - 1, high + 1];
}

/**
 * Curves over one quantity: drag to zoom, click twice to see all again, point to read. `follow(x)` marks a place.
 * @param {Curve[]} curves
 */
export function curveChart(curves) {
  const whole = span(curves.flatMap((curve) => curve.x));
  let shown = whole;
  const frame = svg("svg", { viewBox: `0 0 ${WIDTH} ${HEIGHT}`, role: "img", class: "chart",
    "aria-label": `${named(curves[0].of)} over ${named(curves[0].over)}` });
  const readout = html("figcaption", {}, "");
  const clip = `clip${String(Math.random()).slice(2)}`;
  const inner = svg("g");
  const cursor = svg("line", { class: "cursor", y1: EDGE.top, y2: HEIGHT - EDGE.bottom, visibility: "hidden" });
  const place = svg("line", { class: "place", y1: EDGE.top, y2: HEIGHT - EDGE.bottom, visibility: "hidden" });
  const chosen = svg("rect", { class: "chosen", y: EDGE.top, height: INSIDE.height, visibility: "hidden" });
  frame.append(
    svg("clipPath", { id: clip }, svg("rect", { x: EDGE.left, y: 0, width: INSIDE.width, height: HEIGHT })),
    inner, place, cursor, chosen,
  );
  /** @param {number} x */
  const across = (x) => EDGE.left + (INSIDE.width * (x - shown[0])) / (shown[1] - shown[0]);
  /** @type {number | null} */
  let at = null;

  function draw() {
    const visible = curves.flatMap((curve) => curve.y.filter((_, k) => near(curve, k)));
    let [low, high] = span(visible.length ? visible : [0]);
    [low, high] = [Math.min(low, 0) - 0.06 * (high - low), Math.max(high, 0) + 0.06 * (high - low)];
    /** @param {number} y */
    const up = (y) => EDGE.top + INSIDE.height * (1 - (y - low) / (high - low));
    inner.replaceChildren();
    for (const y of ticks(low, high)) {
      inner.append(
        svg("line", { class: y === 0 ? "zero" : "rule", x1: EDGE.left, x2: WIDTH - EDGE.right, y1: up(y), y2: up(y) }),
        svg("text", { x: EDGE.left - 6, y: up(y) + 4, class: "tick end" }, figure(Number(y.toPrecision(6)))),
      );
    }
    for (const x of ticks(shown[0], shown[1])) {
      inner.append(
        svg("line", { class: "rule", x1: across(x), x2: across(x), y1: EDGE.top, y2: HEIGHT - EDGE.bottom }),
        svg("text", { x: across(x), y: HEIGHT - EDGE.bottom + 16, class: "tick" }, figure(Number(x.toPrecision(6)))),
      );
    }
    inner.append(
      svg("text", { x: EDGE.left + INSIDE.width / 2, y: HEIGHT - 6, class: "name" }, named(curves[0].over)),
    );
    const lines = svg("g", { "clip-path": `url(#${clip})` });
    for (const [k, curve] of curves.entries()) {
      const points = curve.x.map((x, n) => [across(x), up(curve.y[n])]);
      // Beyond its ends a curve that does not repeat holds its values.
      if (curve.period === null) {
        points.unshift([EDGE.left - 1, points[0][1]]);
        points.push([WIDTH, points[points.length - 1][1]]);
      }
      const path = points.map(([x, y], n) => `${n ? "L" : "M"}${x.toFixed(2)} ${y.toFixed(2)}`).join("");
      lines.append(svg("path", { d: path, class: `line line${k % 6}` }));
      const count = curve.x.filter((_, n) => near(curve, n)).length;
      if (count <= 80) {
        for (const [n, x] of curve.x.entries()) {
          if (near(curve, n)) {
            lines.append(svg("circle", { cx: across(x), cy: up(curve.y[n]), r: 2.2, class: `dot dot${k % 6}` }));
          }
        }
      }
    }
    inner.append(lines);
    follow(at);
  }

  /**
   * @param {Curve} curve
   * @param {number} k
   */
  function near(curve, k) {
    return curve.x[k] >= shown[0] && curve.x[k] <= shown[1];
  }

  /** @param {number | null} x */
  function follow(x) {
    at = x;
    const seen = x !== null && x >= shown[0] && x <= shown[1];
    place.setAttribute("visibility", seen ? "visible" : "hidden");
    if (seen) for (const name of ["x1", "x2"]) place.setAttribute(name, String(across(x)));
  }

  /** @param {PointerEvent} event */
  function pointed(event) {
    const box = frame.getBoundingClientRect();
    const x = ((event.clientX - box.left) / box.width) * WIDTH;
    const share = Math.min(Math.max((x - EDGE.left) / INSIDE.width, 0), 1);
    return shown[0] + share * (shown[1] - shown[0]);
  }

  /** @param {number} x */
  function tell(x) {
    for (const name of ["x1", "x2"]) cursor.setAttribute(name, String(across(x)));
    cursor.setAttribute("visibility", "visible");
    const { over, of } = curves[0];
    const values = curves.map((curve) => `${curve.label ? `${curve.label} ` : ""}${figure(valueAt(curve, x))}`);
    readout.textContent = `at ${figure(x)} ${over.unit}: ${values.join(" · ")} ${of.unit}`;
  }

  /** @type {number | null} */
  let from = null;
  frame.addEventListener("pointerdown", (event) => {
    from = pointed(event);
  });
  frame.addEventListener("pointermove", (event) => {
    const x = pointed(event);
    tell(x);
    if (from !== null && event.buttons !== 0) {
      const [left, right] = [across(Math.min(from, x)), across(Math.max(from, x))];
      chosen.setAttribute("x", String(left));
      chosen.setAttribute("width", String(right - left));
      chosen.setAttribute("visibility", "visible");
    }
  });
  frame.addEventListener("pointerup", (event) => {
    const x = pointed(event);
    chosen.setAttribute("visibility", "hidden");
    if (from !== null && Math.abs(across(x) - across(from)) > 8) {
      shown = [Math.min(from, x), Math.max(from, x)];
      draw();
    }
    from = null;
  });
  frame.addEventListener("dblclick", () => {
    shown = whole;
    draw();
  });
  frame.addEventListener("pointerleave", () => {
    cursor.setAttribute("visibility", "hidden");
    chosen.setAttribute("visibility", "hidden");
    readout.textContent = "";
    from = null;
  });
  draw();
  const several = curves.length > 1 || curves[0].label !== "";
  const legend = html("div", { class: "legend" }, html("span", {}, named({ ...curves[0].of, axis: "" })),
    ...(several ? curves.map((curve, k) => html("span", { class: `key key${k % 6}` }, curve.label)) : []));
  const notes = [...new Set(curves.map((curve) => curve.note))].filter((note) => note).join("; ");
  return { element: html("figure", {}, legend, frame, readout, notes ? html("small", {}, notes) : ""), follow };
}

/**
 * @param {Curve} curve
 * @param {number} x
 */
export function valueAt(curve, x) {
  const { x: points, y, period } = curve;
  if (period !== null) x -= period * Math.floor((x - points[0]) / period);
  let after = points.findIndex((point) => point > x);
  if (after === 0) return y[0];
  if (after < 0) return y[y.length - 1];
  return y[after - 1] + ((y[after] - y[after - 1]) * (x - points[after - 1])) / (points[after] - points[after - 1]);
}

/** @param {number} share −1 … 1 */
function colour(share) {
  const pale = 97 - 47 * Math.abs(share);
  return `hsl(${share < 0 ? 215 : 14} 75% ${pale.toFixed(1)}%)`;
}

/**
 * Values over two quantities: a map on a grid, or of places.
 * @param {Grid | Scatter} part
 */
export function mapChart(part) {
  const values = part.shape === "grid" ? part.values.flat() : part.values;
  const largest = Math.max(...values.map(Math.abs)) || 1;
  const places = part.shape === "grid" ? part.y.flatMap((y) => part.x.map((x) => [x, y])) : part.places;
  const [left, right] = span(places.map(([x]) => x));
  const [low, high] = span(places.map(([, y]) => y));
  const cell = part.shape === "grid"
    ? [INSIDE.width / part.x.length, INSIDE.height / part.y.length]
    : [62, 30];
  const room = [INSIDE.width - cell[0], INSIDE.height - cell[1]];
  /** @param {number} x */
  const across = (x) => EDGE.left + cell[0] / 2 + (room[0] * (x - left)) / (right - left);
  /** @param {number} y */
  const up = (y) => EDGE.top + cell[1] / 2 + room[1] * (1 - (y - low) / (high - low));
  const readout = html("figcaption", {}, "");
  const frame = svg("svg", { viewBox: `0 0 ${WIDTH} ${HEIGHT}`, role: "img", class: "chart",
    "aria-label": `${named(part.of)} over ${named(part.over[0])} and ${named(part.over[1])}` });
  for (const [k, [x, y]] of places.entries()) {
    const value = values[k];
    const rect = svg("rect", { x: across(x) - cell[0] / 2, y: up(y) - cell[1] / 2, width: cell[0] + 0.5,
      height: cell[1] + 0.5, fill: colour(value / largest) });
    const told = `${part.over[0].axis} = ${figure(x)} ${part.over[0].unit}, ${part.over[1].axis} = ${figure(y)} ${
      part.over[1].unit}: ${figure(value)} ${part.of.unit}`;
    rect.addEventListener("pointerenter", () => {
      readout.textContent = told;
    });
    frame.append(rect);
    if (cell[0] > 34 && cell[1] > 13) {
      frame.append(svg("text", { x: across(x), y: up(y) + 4, class: "value" }, figure(Number(value.toPrecision(3)))));
    }
  }
  for (const x of ticks(left, right)) {
    frame.append(svg("text", { x: across(x), y: HEIGHT - EDGE.bottom + 16, class: "tick" }, figure(x)));
  }
  for (const y of ticks(low, high)) {
    frame.append(svg("text", { x: EDGE.left - 6, y: up(y) + 4, class: "tick end" }, figure(y)));
  }
  frame.append(
    svg("text", { x: EDGE.left + INSIDE.width / 2, y: HEIGHT - 6, class: "name" }, named(part.over[0])),
    svg("text", { transform: `translate(13 ${EDGE.top + INSIDE.height / 2}) rotate(-90)`, class: "name" },
      named(part.over[1])),
  );
  const range = `${figure(Math.min(...values))} … ${figure(Math.max(...values))} ${part.of.unit}`;
  const label = part.label ? `${part.label}: ${range}` : range;
  return html("figure", {}, html("div", { class: "legend" }, html("span", {}, label)), frame, readout);
}

/**
 * @param {string[]} columns
 * @param {(string | number | Node)[][]} rows
 */
export function rowsTable(columns, rows) {
  const head = html("thead", {}, html("tr", {}, ...columns.map((name) => html("th", {}, name))));
  const cells = rows.map((row) =>
    html("tr", {}, ...row.map((cell) =>
      html("td", typeof cell === "number" ? { class: "number" } : {}, typeof cell === "number" ? figure(cell) : cell))));
  return html("div", { class: "wide" }, html("table", {}, head, html("tbody", {}, ...cells)));
}
