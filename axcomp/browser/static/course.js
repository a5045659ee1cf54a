// Inputs by chance and a digest of what comes out, as ../course.py has them: the same bits.

/** @typedef {{reference: number, type: string, low: number, high: number}} Column */

const STRETCH = 64;
const RARE = 16;
const ROWS = 1000; // at once

/** @param {number} number */
export function mixed(number) {
  number = Math.imul(number ^ (number >>> 16), 0x7feb352d);
  number = Math.imul(number ^ (number >>> 15), 0x846ca68b);
  return (number ^ (number >>> 16)) >>> 0;
}

/**
 * @param {Column} column
 * @param {number} number
 * @param {number} row
 */
export function drawn(column, number, row) {
  const stretch = Math.floor(row / STRETCH);
  const own = mixed(number);
  const before = mixed((own + stretch) >>> 0);
  const share = before / 2 ** 32;
  if (column.type === "b") return share * RARE < 1 ? 1 : 0;
  if (column.type === "i") return Math.floor(share * 3) - 1;
  const moves = (before & 3) !== 0 ? 1 : 0;
  const after = mixed((own + stretch + 1) >>> 0);
  const way = (after / 2 ** 32 - share) * moves * ((row % STRETCH) / STRETCH);
  return column.low + (column.high - column.low) * (share + way);
}

const CRCS = Uint32Array.from({ length: 256 }, (_, byte) => {
  for (let bit = 0; bit < 8; bit++) byte = (byte >>> 1) ^ (byte & 1 ? 0xedb88320 : 0);
  return byte;
});

/**
 * CRC-32 of some doubles, going on from that of those before.
 * @param {Float64Array} values
 * @param {number} before
 */
export function digest(values, before) {
  let crc = ~before;
  for (const byte of new Uint8Array(values.buffer, values.byteOffset, values.byteLength)) {
    crc = (crc >>> 8) ^ CRCS[(crc ^ byte) & 255];
  }
  return ~crc >>> 0;
}

/**
 * Run a machine over inputs by chance; returns the digest of its outputs.
 * @param {import("./kernel.js").Machine} machine
 * @param {readonly Column[]} columns its inputs
 * @param {number} cycles
 */
export function digestOf(machine, columns, cycles) {
  let crc = 0;
  for (let first = 0; first < cycles; first += ROWS) {
    const rows = Math.min(ROWS, cycles - first);
    const given = new Float64Array(rows * columns.length);
    for (let row = 0, at = 0; row < rows; row++) {
      for (let k = 0; k < columns.length; k++) given[at++] = drawn(columns[k], k, first + row);
    }
    crc = digest(machine.run(given), crc);
  }
  return crc;
}

/** @typedef {{name: string, reference: number, causality: string, unit: string, axis: number | null,
 *   quantity: string, volumetric: number | null, description: string}} Variable */
/** @typedef {{image: string, cycleTime: number, course: Column[], variables: Variable[]}} KernelData */

/**
 * Open a machine of the page's JSON for inputs by chance.
 * @param {import("./kernel.js").Kernel} kernel
 * @param {KernelData} data
 */
export function openCourse(kernel, data) {
  const outputs = data.variables.filter((one) => one.causality === "output").map((one) => one.reference);
  const inputs = data.course.map((column) => column.reference);
  return kernel.open(bytesOf(data.image), inputs, outputs);
}

/** @param {string} base64 */
export function bytesOf(base64) {
  return Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0));
}
