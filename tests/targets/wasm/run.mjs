// Runs the module named on the command line, and prints what it prints.
import { readFile } from "node:fs/promises";

const bytes = [];
const host = { print: (byte) => bytes.push(byte) };
const { instance } = await WebAssembly.instantiate(await readFile(process.argv[2]), { host });
instance.exports.run();
process.stdout.write(Buffer.from(bytes));
