// The kernel as WebAssembly: a machine is made of an image, its variables are columns of numbers.

/**
 * @typedef {{
 *   memory: WebAssembly.Memory,
 *   _initialize: () => void,
 *   axcomp_allocate: (size: number) => number,
 *   axcomp_free: (at: number) => void,
 *   axcomp_open: (image: number, size: number) => number,
 *   axcomp_close: (machine: number) => void,
 *   axcomp_find: (machine: number, reference: number, field: number) => void,
 *   axcomp_run_rows: (machine: number, rows: number, inputs: number, inputCount: number, from: number,
 *     outputs: number, outputCount: number, to: number) => void,
 * }} Exports
 */

const FIELD = 8; // bytes: a pointer and a type

export class Kernel {
  /** @param {Exports} exports */
  constructor(exports) {
    this.exports = exports;
    exports._initialize();
  }

  /** @param {BufferSource} bytes */
  static async from(bytes) {
    const { instance } = await WebAssembly.instantiate(bytes);
    return new Kernel(/** @type {Exports} */ (/** @type {unknown} */ (instance.exports)));
  }

  /** @param {number} size */
  allocate(size) {
    const at = this.exports.axcomp_allocate(size);
    if (at === 0) throw new Error("there is no memory for the kernel");
    return at;
  }

  /**
   * Make a machine of an image; its inputs are the variables with some value references, its outputs others.
   * @param {Uint8Array} image
   * @param {readonly number[]} inputs
   * @param {readonly number[]} outputs
   */
  open(image, inputs, outputs) {
    const at = this.allocate(image.length);
    new Uint8Array(this.exports.memory.buffer).set(image, at);
    const machine = this.exports.axcomp_open(at, image.length);
    this.exports.axcomp_free(at);
    if (machine === 0) throw new Error("there is no memory for the machine");
    const complaint = new DataView(this.exports.memory.buffer).getUint32(machine, true);
    if (complaint !== 0) {
      const said = this.text(complaint);
      this.exports.axcomp_close(machine);
      throw new Error(`the image is refused: ${said}`);
    }
    return new Machine(this, machine, inputs, outputs);
  }

  /** @param {number} at */
  text(at) {
    const bytes = new Uint8Array(this.exports.memory.buffer, at);
    return new TextDecoder().decode(bytes.subarray(0, bytes.indexOf(0)).slice());
  }
}

export class Machine {
  /**
   * @param {Kernel} kernel
   * @param {number} at
   * @param {readonly number[]} inputs
   * @param {readonly number[]} outputs
   */
  constructor(kernel, at, inputs, outputs) {
    this.kernel = kernel;
    this.at = at;
    this.inputs = inputs.length;
    this.outputs = outputs.length;
    this.fields = [this.#find(inputs), this.#find(outputs)];
    this.rows = 0; // that the block has room for
    this.block = 0;
  }

  /** @param {readonly number[]} references */
  #find(references) {
    const { exports } = this.kernel;
    const fields = this.kernel.allocate(FIELD * (references.length + 1));
    for (const [k, reference] of references.entries()) {
      exports.axcomp_find(this.at, reference, fields + FIELD * k);
      if (new DataView(exports.memory.buffer).getUint32(fields + FIELD * k + 4, true) === 0) {
        throw new Error(`there is no variable with the value reference ${String(reference)}`);
      }
    }
    return fields;
  }

  /**
   * Run a cycle for each row of inputs; returns the rows of outputs.
   * @param {Float64Array} given
   */
  run(given) {
    const { exports } = this.kernel;
    const rows = given.length / this.inputs;
    if (rows > this.rows) {
      if (this.block !== 0) exports.axcomp_free(this.block);
      this.block = this.kernel.allocate(8 * rows * (this.inputs + this.outputs));
      this.rows = rows;
    }
    const to = this.block + 8 * given.length;
    new Float64Array(exports.memory.buffer, this.block, given.length).set(given);
    const [inputs, outputs] = this.fields;
    exports.axcomp_run_rows(this.at, rows, inputs, this.inputs, this.block, outputs, this.outputs, to);
    return new Float64Array(exports.memory.buffer, to, rows * this.outputs).slice();
  }

  close() {
    for (const at of [...this.fields, this.block]) if (at !== 0) this.kernel.exports.axcomp_free(at);
    this.kernel.exports.axcomp_close(this.at);
  }
}
