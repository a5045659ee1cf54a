// The page: lists are dropped or chosen, looked at in a worker, and shown.
import { curveChart, figure, html, mapChart, rowsTable } from "./chart.js";
import { bytesOf } from "./course.js";
import { Kernel } from "./kernel.js";
import { moveSection } from "./move.js";

/** @typedef {import("./worker.js").ListFile} ListFile */
/** @typedef {{severity: "error" | "warning" | "info", file: string, line: number, column: number, code: string,
 *   parameter: string, message: string}} Finding */
/** @typedef {{title: string, kind: string, axis: string, parts: import("./chart.js").Part[]}} Table */
/** @typedef {{volumetric: number, axis: string, correction: number, limit: number | null,
 *   position: Record<string, number>}} Limit */
/** @typedef {{name: string, path: string, axes: import("./move.js").Axis[], tables: Table[], judged: string[],
 *   limits: Limit[], kernel: import("./course.js").KernelData | null, complaint: string}} Machine */
/** @typedef {{check: {findings: Finding[], counts: Record<string, number>}, text: string,
 *   codes: Record<string, {meaning: string, why: string, mend: string}>, machines: Machine[]}} Looked */

const ROWS = 300; // findings that are shown at once
const COMPARED = 1000; // cycles on a machine of the lists
const SIZE_MAX = 200_000_000;

/** @param {string} id */
const byId = (id) => /** @type {HTMLElement} */ (document.getElementById(id));
const [status, drop, result, examples] = ["status", "drop", "result", "examples"].map(byId);
const proofs = { native: byId("native"), python: byId("python") };

const worker = new Worker("worker.js", { type: "module" });
/** @type {Map<number, {resolve: (answer: any) => void, reject: (error: Error) => void}>} */
const waiting = new Map();
let calls = 0;
worker.onmessage = (/** @type {MessageEvent} */ event) => {
  const { id, answer, error } = event.data;
  const one = waiting.get(id);
  waiting.delete(id);
  if (error === undefined) one?.resolve(answer);
  else one?.reject(new Error(error));
};
worker.onerror = (/** @type {ErrorEvent} */ event) => {
  say(`The worker has failed: ${event.message}`, true);
};

/**
 * @param {string} call
 * @param {unknown} [given]
 * @returns {Promise<any>}
 */
function ask(call, given) {
  const id = ++calls;
  return new Promise((resolve, reject) => {
    waiting.set(id, { resolve, reject });
    worker.postMessage({ id, call, given });
  });
}

const kernel = fetch("kernel.wasm").then((answer) => answer.arrayBuffer()).then((bytes) => Kernel.from(bytes));

/**
 * @param {string} sentence
 * @param {boolean} [wrong]
 */
function say(sentence, wrong = false) {
  status.textContent = sentence;
  status.className = wrong ? "wrong" : "";
}

/**
 * @param {HTMLElement} badge
 * @param {boolean} good
 * @param {string} text
 */
function badge(badge, good, text) {
  badge.className = good ? "badge good" : "badge bad";
  badge.textContent = `${good ? "✓" : "✗"} ${text}`;
}

/** @type {ReturnType<typeof moveSection> | null} */
let moving = null;
/** @type {{axis: string, follow: (x: number | null) => void}[]} */
let followers = [];
let looks = 0;

/**
 * @param {ListFile[]} files
 * @param {string} path
 */
async function look(files, path) {
  const own = ++looks;
  if (files.length === 0) {
    say("There is no file in what was given.", true);
    return;
  }
  say(`Reading ${String(files.length)} file${files.length === 1 ? "" : "s"} …`);
  document.body.classList.add("busy");
  try {
    /** @type {Looked} */
    const looked = await ask("look", { files, path });
    if (own !== looks) return;
    await show(looked);
    say("");
  } catch (error) {
    say(error instanceof Error ? error.message : String(error), true);
  } finally {
    document.body.classList.remove("busy");
  }
}

/** @param {Looked} looked */
async function show(looked) {
  const summary = looked.text.trim().split("\n").pop() ?? "";
  const choice = html("select", { "aria-label": "Machine" });
  for (const [k, machine] of looked.machines.entries()) choice.append(html("option", { value: String(k) }, machine.path));
  const body = html("div");
  const one = looked.machines.length > 1 ? html("label", { class: "choice" }, "Machine ", choice) : "";
  result.replaceChildren(section("findings", "Findings", html("p", { class: "lead" }, summary), findings(looked)), one, body);
  choice.addEventListener("change", () => {
    void showMachine(body, looked.machines, Number(choice.value));
  });
  await showMachine(body, looked.machines, 0);
  result.scrollIntoView({ behavior: "smooth", block: "start" });
}

/**
 * @param {string} id
 * @param {string} title
 * @param {...(Node | string)} children
 */
function section(id, title, ...children) {
  return html("section", { id }, html("h2", {}, title), ...children);
}

/** @param {Looked} looked */
function findings(looked) {
  const all = looked.check.findings;
  if (all.length === 0) return html("p", { class: "fine" }, "Nothing was found in the lists.");
  const hidden = new Set();
  const table = html("div");
  let most = ROWS;
  const filter = html("div", { class: "controls" });
  for (const [severity, count] of Object.entries(looked.check.counts)) {
    if (count === 0) continue;
    const box = html("input", { type: "checkbox", checked: "" });
    box.addEventListener("change", () => {
      if (box.checked) hidden.delete(severity);
      else hidden.add(severity);
      draw();
    });
    filter.append(html("label", { class: severity }, box, ` ${String(count)} ${severity}${count === 1 ? "" : "s"}`));
  }
  function draw() {
    const chosen = all.filter((one) => !hidden.has(one.severity));
    const rows = chosen.slice(0, most).map((one) => [
      html("span", { class: `severity ${one.severity}` }, one.severity),
      html("span", { class: "where" }, ...place(one).split(/(?<=\/)/).flatMap((part) => [part, html("wbr")])),
      explained(one.code, looked.codes[one.code]),
      one.message,
    ]);
    table.replaceChildren(rowsTable(["severity", "place", "code", "finding"], rows));
    table.firstElementChild?.classList.add("findings");
    if (chosen.length > most) {
      const more = html("button", { type: "button" }, `Show all ${String(chosen.length)}`);
      more.addEventListener("click", () => {
        most = Infinity;
        draw();
      });
      table.append(more);
    }
  }
  draw();
  return html("div", {}, filter, table);
}

/** @param {Finding} one */
function place(one) {
  const line = one.line ? `:${String(one.line)}${one.column ? `:${String(one.column)}` : ""}` : "";
  return `${one.file}${line}`;
}

/**
 * @param {string} code
 * @param {{meaning: string, why: string, mend: string}} told
 */
function explained(code, told) {
  return html("details", {}, html("summary", {}, code), html("p", {}, html("b", {}, told.meaning)),
    html("p", {}, told.why), html("p", {}, told.mend));
}

/**
 * @param {HTMLElement} body
 * @param {Machine[]} machines
 * @param {number} number
 */
async function showMachine(body, machines, number) {
  moving?.stop();
  moving = null;
  followers = [];
  const machine = machines[number];
  const parts = machine.axes.length ? [section("machine", `Machine ${machine.name}`, axesTable(machine))] : [];
  if (machine.kernel !== null) {
    const ranges = machine.axes.map((axis) => rangeOf(axis, machine.tables));
    moving = moveSection(await kernel, machine.kernel, machine.axes, ranges, (positions) => {
      for (const { axis, follow } of followers) follow(positions[machine.axes.findIndex((one) => one.name === axis)] ?? null);
    });
    parts.push(section("move", "Moved by hand", moving.element));
    void compare(number, machine.kernel);
  } else if (machine.complaint) {
    parts.push(section("move", "Moved by hand", html("p", {}, `The kernel cannot run these lists: ${machine.complaint}.`)));
  }
  if (machine.axes.length) parts.push(judgement(machine));
  if (machine.tables.length) parts.push(section("tables", "Tables", ...machine.tables.map(tableCard)));
  body.replaceChildren(...parts);
}

/**
 * @param {number} number
 * @param {import("./course.js").KernelData} data
 */
async function compare(number, data) {
  proofs.python.className = "badge";
  proofs.python.textContent = "comparing the kernels on this machine …";
  const { same, cycles } = await ask("compare", { number, cycles: COMPARED, data });
  badge(proofs.python, same, `${same ? "same bits as" : "NOT the bits of"} the kernel in Python over ${String(cycles)} cycles of this machine`);
}

/** @param {Machine} machine */
function axesTable(machine) {
  return rowsTable(["axis", "number", "type", "modulo range", "compensations in force"], machine.axes.map((axis) => [
    axis.name, String(axis.number), axis.type,
    axis.modulo ? `${figure(axis.modulo[0])} … ${figure(axis.modulo[1])} ${axis.unit}` : "–",
    axis.kinds.join(", ") || "none",
  ]));
}

/** @param {Machine} machine */
function judgement(machine) {
  const said = machine.judged.length
    ? html("ul", {}, ...machine.judged.map((one) => html("li", {}, one)))
    : html("p", { class: "fine" }, "No value is off its neighbours, round tables close, and no volumetric correction comes near its limit.");
  const rows = machine.limits.map((one) => [
    one.axis, String(one.volumetric), `${figure(1000 * one.correction)} µm`,
    one.limit === null ? "none" : `${figure(one.limit)} mm`,
    one.limit ? `${String(Math.round((100 * Math.abs(one.correction)) / one.limit))} %` : "–",
    Object.entries(one.position).map(([name, x]) => `${name} = ${figure(x)}`).join(", "),
  ]);
  const columns = ["axis", "compensation", "largest correction", "s_limit", "share", "at"];
  return section("judgement", "Judgement", said, ...(rows.length ? [rowsTable(columns, rows)] : []));
}

/** @param {Table} table */
function tableCard(table) {
  const curves = table.parts.filter((part) => part.shape === "curve");
  const card = html("article", { class: "table" }, html("h3", {}, table.title));
  if (curves.length) {
    const { element, follow } = curveChart(curves);
    card.append(element);
    const { over } = curves[0];
    if (over.name === "position") followers.push({ axis: over.axis, follow });
    const points = [...new Set(curves.flatMap((curve) => curve.x))].sort((a, b) => a - b);
    const columns = [`${over.name} [${over.unit}]`, ...curves.map((curve) => `${curve.label || curve.of.name} [${curve.of.unit}]`)];
    const details = html("details", {}, html("summary", {}, `${String(points.length)} points`));
    details.addEventListener("toggle", () => {
      if (details.childElementCount > 1) return;
      details.append(rowsTable(columns, points.map((x) => [x, ...curves.map((curve) => {
        const k = curve.x.indexOf(x);
        return k < 0 ? "" : curve.y[k];
      })])));
    });
    card.append(details);
  }
  const maps = [];
  for (const part of table.parts) {
    if (part.shape === "rows") card.append(rowsTable(part.columns, part.rows));
    else if (part.shape !== "curve") maps.push(mapChart(part));
  }
  if (maps.length) card.append(html("div", { class: maps.length > 1 ? "maps" : "" }, ...maps));
  return card;
}

/**
 * From where to where an axis is moved: over all tables that have it.
 * @param {import("./move.js").Axis} axis
 * @param {Table[]} tables
 * @returns {[number, number]}
 */
function rangeOf(axis, tables) {
  let [low, high] = [Infinity, -Infinity];
  for (const part of tables.flatMap((table) => table.parts)) {
    if (part.shape === "rows") continue;
    const over = part.shape === "curve" ? [part.over] : part.over;
    for (const [k, quantity] of over.entries()) {
      if (quantity.axis !== axis.name || quantity.name !== "position") continue;
      const values = part.shape === "curve" ? part.x : part.shape === "scatter" ? part.places.map((one) => one[k])
        : k === 0 ? part.x : part.y;
      low = Math.min(low, ...values);
      high = Math.max(high, ...values);
    }
  }
  return low < high ? [low, high] : axis.modulo ?? [-100, 100];
}

// What is dropped or chosen

/** @param {FileSystemEntry} entry @param {ListFile[]} files */
async function taken(entry, files) {
  if (entry.name.startsWith(".") || entry.name === "node_modules") return;
  const path = entry.fullPath.replace(/^\/+/, "");
  if (entry.isFile) {
    /** @type {File} */
    const file = await new Promise((resolve, reject) => {
      /** @type {FileSystemFileEntry} */ (entry).file(resolve, reject);
    });
    await read(file, path, files);
    return;
  }
  const reader = /** @type {FileSystemDirectoryEntry} */ (entry).createReader();
  for (;;) {
    /** @type {FileSystemEntry[]} */
    const batch = await new Promise((resolve, reject) => {
      reader.readEntries(resolve, reject);
    });
    if (batch.length === 0) return;
    for (const child of batch) await taken(child, files);
  }
}

/** @param {File} file @param {string} path @param {ListFile[]} files */
async function read(file, path, files) {
  if (file.size <= SIZE_MAX) files.push({ path, data: new Uint8Array(await file.arrayBuffer()) });
}

/** @param {ListFile[]} files */
function lookAt(files) {
  const folders = new Set(files.map((file) => (file.path.includes("/") ? file.path.split("/")[0] : ".")));
  const [folder] = folders;
  const path = folders.size === 1 ? (folder === "." && files.length === 1 ? files[0].path : folder) : ".";
  return look(files, path);
}

drop.addEventListener("dragover", (event) => {
  event.preventDefault();
  drop.classList.add("over");
});
drop.addEventListener("dragleave", () => {
  drop.classList.remove("over");
});
drop.addEventListener("drop", (event) => {
  event.preventDefault();
  drop.classList.remove("over");
  const entries = [...(event.dataTransfer?.items ?? [])].map((item) => item.webkitGetAsEntry());
  void (async () => {
    /** @type {ListFile[]} */
    const files = [];
    for (const entry of entries) if (entry !== null) await taken(entry, files);
    await lookAt(files);
  })();
});
for (const id of ["folder", "files"]) {
  const input = /** @type {HTMLInputElement} */ (byId(id));
  input.addEventListener("change", () => {
    void (async () => {
      /** @type {ListFile[]} */
      const files = [];
      for (const file of input.files ?? []) {
        const path = file.webkitRelativePath || file.name;
        if (!path.split("/").some((part) => part.startsWith(".") || part === "node_modules")) await read(file, path, files);
      }
      input.value = "";
      await lookAt(files);
    })();
  });
}

async function start() {
  /** @type {Record<string, Record<string, string>>} */
  const machines = await (await fetch("examples.json")).json();
  for (const [name, lists] of Object.entries(machines)) {
    const button = html("button", { type: "button" }, name.replace("_", " "));
    button.addEventListener("click", () => {
      void look(Object.entries(lists).map(([path, data]) => ({ path, data: bytesOf(data) })), name);
    });
    examples.append(button);
  }
  const proof = await ask("prove");
  const total = (proof.cycles * proof.machines).toLocaleString("en");
  const good = proof.differing.length === 0;
  badge(proofs.native, good, good ? `same bits as ${proof.by} over ${total} cycles of ${String(proof.machines)} machines`
    : `NOT the bits of ${proof.by}: ${proof.differing.join(", ")}`);
  await ask("ready");
  document.body.classList.add("ready");
  if (status.textContent?.startsWith("Loading")) say("");
}
start().catch((error) => {
  say(`The page cannot start: ${error instanceof Error ? error.message : String(error)}`, true);
});
