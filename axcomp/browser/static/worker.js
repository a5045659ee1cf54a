// Pyodide with the package in it: looks at lists, and has the kernels compared.
import { digestOf, openCourse } from "./course.js";
import { Kernel } from "./kernel.js";
import { loadPyodide } from "./pyodide/pyodide.mjs";

/** @typedef {{path: string, data: Uint8Array}} ListFile */
/** @typedef {{by: string, cycles: number, machines: {name: string, digest: number,
 *   kernel: import("./course.js").KernelData}[]}} Proof */

const LISTS = "/lists";
const SETUP = `
import os, shutil
from axcomp.browser import digest_of, look, shown

def show(path):
    global found
    found = look(path)
    return shown(found, path)

def digest(number, cycles):
    return digest_of(found[number].machine, cycles)

def clear():
    os.chdir("/")
    shutil.rmtree("${LISTS}", ignore_errors=True)
    os.mkdir("${LISTS}")
    os.chdir("${LISTS}")
`;

/** @param {string} name */
async function fetched(name) {
  const answer = await fetch(name);
  if (!answer.ok) throw new Error(`${name} cannot be loaded: ${String(answer.status)} ${answer.statusText}`);
  return answer;
}

const kernel = fetched("kernel.wasm").then((answer) => answer.arrayBuffer()).then((bytes) => Kernel.from(bytes));

async function start() {
  const [python, archive] = await Promise.all([
    loadPyodide({ indexURL: new URL("pyodide/", location.href).href }),
    fetched("axcomp.zip").then((answer) => answer.arrayBuffer()),
  ]);
  python.unpackArchive(archive, "zip", { extractDir: "/package" });
  python.runPython("import sys; sys.path.insert(0, '/package')");
  python.runPython(SETUP);
  return python;
}
const starting = start();

const calls = {
  /** Compare the kernel with the one that made the proof. */
  async prove() {
    /** @type {Proof} */
    const proof = await (await fetched("proof.json")).json();
    const differing = [];
    for (const one of proof.machines) {
      const machine = openCourse(await kernel, one.kernel);
      if (digestOf(machine, one.kernel.course, proof.cycles) !== one.digest) differing.push(one.name);
      machine.close();
    }
    return { by: proof.by, cycles: proof.cycles, machines: proof.machines.length, differing };
  },

  async ready() {
    await starting;
  },

  /**
   * Look at lists; answers with the JSON of `shown`.
   * @param {{files: ListFile[], path: string}} given
   */
  async look({ files, path }) {
    const python = await starting;
    const { FS, globals } = python;
    globals.get("clear")();
    for (const file of files) {
      const place = `${LISTS}/${file.path}`;
      FS.mkdirTree(place.slice(0, place.lastIndexOf("/")));
      FS.writeFile(place, file.data);
    }
    return JSON.parse(globals.get("show")(path));
  },

  /**
   * Compare the kernel with the one in Python on a machine of the lists.
   * @param {{number: number, cycles: number, data: import("./course.js").KernelData}} given
   */
  async compare({ number, cycles, data }) {
    const python = await starting;
    const machine = openCourse(await kernel, data);
    const same = digestOf(machine, data.course, cycles) === python.globals.get("digest")(number, cycles);
    machine.close();
    return { same, cycles };
  },
};

onmessage = async (event) => {
  const { id, call, given } = event.data;
  try {
    postMessage({ id, answer: await calls[/** @type {keyof typeof calls} */ (call)](given) });
  } catch (error) {
    postMessage({ id, error: error instanceof Error ? error.message : String(error) });
  }
};
