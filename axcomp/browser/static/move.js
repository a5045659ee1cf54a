// Axes moved by hand: sliders are targets, setpoints go there within a feed, and the kernel corrects every cycle.
import { bytesOf } from "./course.js";
import { figure, html } from "./chart.js";

/** @typedef {{name: string, number: number, type: string, unit: string, modulo: [number, number] | null,
 *   kinds: string[]}} Axis */

const SHOWN = /** @type {Record<string, [number, string]>} */ ({ mm: [1e3, "µm"], "°": [3600, "″"], deg: [3600, "″"] });
const ACCELERATION = 2000; // mm/s² or °/s²
const ROUNDING = 1e-6; // mm or °
const CYCLES = 100; // in a frame at most
const TRACE = 300; // frames in the picture

/**
 * One step of a setpoint towards its target, within feed and acceleration, never beyond it.
 * @param {{s: number, v: number, a: number}} motion
 * @param {number} target
 * @param {number} feed
 * @param {number} dt
 */
export function step(motion, target, feed, dt) {
  const way = target - motion.s;
  const most = ACCELERATION * dt;
  // As fast as it can still be stopped from, after this step.
  const stoppable = Math.sqrt(most * most + 2 * ACCELERATION * Math.abs(way)) - most;
  const wanted = Math.sign(way) * Math.min(feed, stoppable);
  const v = motion.v + Math.min(Math.max(wanted - motion.v, -most), most);
  motion.a = (v - motion.v) / dt;
  motion.v = v;
  motion.s = Math.abs(way - v * dt) < ROUNDING ? target : motion.s + v * dt;
}

/**
 * @param {import("./kernel.js").Kernel} kernel
 * @param {import("./course.js").KernelData} data
 * @param {Axis[]} axes
 * @param {[number, number][]} ranges
 * @param {(positions: number[]) => void} moved
 */
export function moveSection(kernel, data, axes, ranges, moved) {
  const inputs = data.variables.filter((one) => one.causality === "input");
  const outputs = data.variables.filter((one) => one.causality === "output");
  const machine = kernel.open(bytesOf(data.image), inputs.map((v) => v.reference), outputs.map((v) => v.reference));
  const row = new Float64Array(inputs.length);
  /**
   * @param {import("./course.js").Variable[]} variables
   * @param {number | null} axis
   * @param {string} quantity
   */
  const place = (variables, axis, quantity) => variables.findIndex((v) => v.axis === axis && v.quantity === quantity);
  /**
   * @param {string} name
   * @param {number} n place of its input
   */
  function switchOf(name, n) {
    const box = html("select", { "aria-label": name });
    for (const [value, text] of [["0", "as the lists say"], ["1", "on"], ["-1", "off"]]) {
      box.append(html("option", { value }, text));
    }
    box.addEventListener("change", () => {
      row[n] = Number(box.value);
    });
    return box;
  }
  /** @type {((values: Float64Array) => void)[]} */
  const states = [];
  const dt = data.cycleTime;
  let feed = 50;

  const cards = axes.map((axis, k) => {
    const [low, high] = ranges[k];
    const start = Math.min(Math.max(0, low), high);
    const motion = { s: start, v: 0, a: 0 };
    const [factor, unit] = SHOWN[axis.unit] ?? [1, axis.unit];
    const slider = html("input", { type: "range", min: String(low), max: String(high), step: "any",
      value: String(start), "aria-label": `Target of ${axis.name}` });
    const setpoint = html("output");
    const corrected = html("output");
    /** @type {{show: (values: Float64Array) => void, element: Element}[]} */
    const lines = [];
    for (const [n, variable] of outputs.entries()) {
      if (variable.axis !== k || !/correction$|^current$|^setpoint_shift$/.test(variable.quantity)) continue;
      const small = SHOWN[variable.unit];
      const value = html("output");
      const bar = html("span", { class: "bar" });
      const kind = variable.quantity.split(".")[0];
      const active = place(outputs, k, `${kind}.active`);
      const name = { correction: "sum", setpoint_shift: "shift" }[variable.quantity] ?? kind;
      const label = html("span", { class: "kind" }, name);
      const line = html("div", { class: variable.quantity === "correction" ? "value sum" : "value" },
        label, html("span", { class: "track" }, bar), value);
      let largest = 1e-9;
      lines.push({ element: line, show: (values) => {
        const shown = values[n] * (small ? small[0] : 1);
        largest = Math.max(largest, Math.abs(shown));
        value.textContent = `${shown.toFixed(2).replace("-", "−")} ${small ? small[1] : variable.unit}`.trim();
        bar.style.width = `${String((50 * Math.abs(shown)) / largest)}%`;
        bar.style.left = shown < 0 ? `${String(50 - (50 * Math.abs(shown)) / largest)}%` : "50%";
        if (active >= 0) line.classList.toggle("off", values[active] === 0);
      } });
    }
    const switches = inputs.flatMap((variable, n) => {
      if (variable.axis !== k || !variable.quantity.endsWith(".switch")) return [];
      return [html("label", {}, `${variable.quantity.split(".")[0]} `, switchOf(variable.name, n))];
    });
    const unreferenced = html("input", { type: "checkbox" });
    const referenced = place(inputs, k, "unreferenced");
    unreferenced.addEventListener("change", () => {
      row[referenced] = unreferenced.checked ? 1 : 0;
    });
    const order = [...lines.filter((one) => !one.element.classList.contains("sum")),
      ...lines.filter((one) => one.element.classList.contains("sum"))];
    const element = html("article", { class: "axis" },
      html("h4", {}, axis.name, html("small", {}, ` ${axis.type}, axis ${String(axis.number)}`)), slider,
      html("div", { class: "positions" }, html("span", {}, "setpoint ", setpoint),
        html("span", {}, "corrected ", corrected)),
      ...order.map((one) => one.element),
      html("details", {}, html("summary", {}, "switches"), ...switches,
        html("label", {}, unreferenced, " without its reference")));
    const names = ["setpoint", "velocity", "acceleration", "actual_position"];
    const [s, v, a, p] = names.map((name) => place(inputs, k, name));
    const sum = place(outputs, k, "correction");
    const out = place(outputs, k, "corrected_setpoint");
    return {
      element, slider, motion, factor, unit,
      /** @param {number} at */
      fill(at) {
        step(motion, Number(slider.value), feed, dt);
        [row[s], row[v], row[a], row[p]] = [motion.s, motion.v, motion.a, motion.s];
        given.set(row, at);
      },
      /** @param {Float64Array} values */
      show(values) {
        setpoint.textContent = `${motion.s.toFixed(3).replace("-", "−")} ${axis.unit}`;
        corrected.textContent = `${values[out].toFixed(5).replace("-", "−")} ${axis.unit}`;
        for (const line of lines) line.show(values);
        return values[sum] * factor;
      },
    };
  });

  const machineInputs = inputs.flatMap((variable, n) => {
    if (variable.quantity === "tool_length") {
      const box = html("input", { type: "number", value: "0", step: "1" });
      box.addEventListener("input", () => {
        row[n] = Number(box.value) || 0;
      });
      return [html("label", {}, "Tool length ", box, " mm")];
    }
    if (variable.volumetric === null || variable.quantity !== "switch") return [];
    const active = outputs.findIndex((v) => v.volumetric === variable.volumetric && v.quantity === "active");
    const state = html("output");
    states.push((values) => {
      state.textContent = values[active] === 0 ? " (off)" : " (on)";
    });
    return [html("label", {}, `Volumetric ${String(variable.volumetric)} `, switchOf(variable.name, n), state)];
  });

  let given = new Float64Array(0);
  const drawing = html("canvas", { class: "trace", "aria-label": "Sum of the corrections of each axis over the last seconds" });
  /** @type {number[][]} */
  const trace = [];
  let before = 0;
  let cycles = 0;
  let stopped = false;
  const count = html("output");

  /** @param {number} now ms */
  function frame(now) {
    if (stopped) return;
    const due = before === 0 ? 1 : Math.min(Math.round((now - before) / 1000 / dt), CYCLES);
    before = now;
    if (due > 0) run(due);
    requestAnimationFrame(frame);
  }

  /** @param {number} due */
  function run(due) {
    given = new Float64Array(due * row.length);
    for (let n = 0; n < due; n++) for (const card of cards) card.fill(n * row.length);
    const last = machine.run(given).subarray((due - 1) * outputs.length);
    cycles += due;
    trace.push(cards.map((card) => card.show(last)));
    for (const show of states) show(last);
    if (trace.length > TRACE) trace.shift();
    count.textContent = cycles.toLocaleString("en");
    draw();
    moved(cards.map((card) => card.motion.s));
  }

  function draw() {
    const scale = devicePixelRatio;
    const [width, height] = [drawing.clientWidth, drawing.clientHeight];
    if (drawing.width !== width * scale) [drawing.width, drawing.height] = [width * scale, height * scale];
    const pen = drawing.getContext("2d");
    if (pen === null || width === 0) return;
    const style = getComputedStyle(drawing);
    const all = trace.flat();
    let [low, high] = [Math.min(0, ...all), Math.max(0, ...all)];
    if (high - low < 0.5) [low, high] = [low - 0.25, high + 0.25];
    const edge = 0.08 * (high - low);
    [low, high] = [low - edge, high + edge];
    /** @param {number} y */
    const up = (y) => height * (1 - (y - low) / (high - low));
    pen.setTransform(scale, 0, 0, scale, 0, 0);
    pen.clearRect(0, 0, width, height);
    pen.font = "12px system-ui, sans-serif";
    pen.fillStyle = pen.strokeStyle = style.getPropertyValue("--faint");
    pen.beginPath();
    pen.moveTo(0, up(0));
    pen.lineTo(width, up(0));
    pen.stroke();
    const units = [...new Set(cards.map((card) => card.unit))].join(", ");
    pen.fillText(`${figure(high)} ${units}`, 6, 14);
    pen.fillText(`${figure(low)} ${units}`, 6, height - 6);
    pen.lineWidth = 1.8;
    for (const k of cards.keys()) {
      pen.strokeStyle = style.getPropertyValue(`--line${String(k % 6)}`);
      pen.beginPath();
      for (const [n, values] of trace.entries()) {
        const x = width - ((trace.length - 1 - n) * width) / TRACE;
        pen[n === 0 ? "moveTo" : "lineTo"](x, up(values[k]));
      }
      pen.stroke();
    }
  }

  const speed = html("select", { "aria-label": "Feed" });
  for (const value of [1, 10, 50, 200, 500]) speed.append(html("option", { value: String(value) }, `${String(value * 60)} /min`));
  speed.value = String(feed);
  speed.addEventListener("change", () => {
    feed = Number(speed.value);
  });
  const shake = html("button", { type: "button" }, "Move to and fro");
  shake.addEventListener("click", () => {
    for (const [k, card] of cards.entries()) {
      const [low, high] = ranges[k];
      card.slider.value = String(Math.abs(Number(card.slider.value) - high) < 1e-9 ? low : high);
    }
  });
  const legend = html("div", { class: "legend" },
    ...axes.map((axis, k) => html("span", { class: `key key${String(k % 6)}` }, axis.name)));
  const element = html("div", {},
    html("div", { class: "controls" }, html("label", {}, "Feed ", speed), shake, ...machineInputs,
      html("span", {}, "Cycles: ", count)),
    legend, drawing, html("div", { class: "axes" }, ...cards.map((card) => card.element)));
  requestAnimationFrame(frame);
  return {
    element,
    stop() {
      stopped = true;
      machine.close();
    },
  };
}
