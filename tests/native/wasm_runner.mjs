// Runs machines in the WebAssembly kernel under Node: `node wasm_runner.mjs KERNEL_JS_FOLDER WASM JOB.json`.
// A job is {kernel, cycles} (inputs by chance; prints the digest) or {kernel, inputs, from, to} (files of doubles).
import { readFileSync, writeFileSync } from "node:fs";
import { pathToFileURL } from "node:url";

const [folder, wasm, job] = process.argv.slice(2);
const { Kernel } = await import(pathToFileURL(`${folder}/kernel.js`));
const { bytesOf, digestOf, openCourse } = await import(pathToFileURL(`${folder}/course.js`));
const kernel = await Kernel.from(readFileSync(wasm));
for (const one of JSON.parse(readFileSync(job, "utf8"))) {
  if (one.cycles !== undefined) {
    console.log(digestOf(openCourse(kernel, one.kernel), one.kernel.course, one.cycles));
    continue;
  }
  try {
    const machine = kernel.open(bytesOf(one.image), one.inputs, one.outputs);
    const data = readFileSync(one.from);
    const rows = new Float64Array(data.buffer.slice(data.byteOffset, data.byteOffset + data.byteLength));
    writeFileSync(one.to, Buffer.from(machine.run(rows).buffer));
    machine.close();
  } catch (error) {
    console.log(error.message);
  }
}
