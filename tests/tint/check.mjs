// Compiles every .wgsl file of a folder with Tint, for a driver that is there, and says which it refuses.
import { readFile, readdir } from "node:fs/promises";
import { join } from "node:path";
import process from "node:process";
import { create } from "webgpu";

const [folder] = process.argv.slice(2);
const names = (await readdir(folder)).filter((name) => name.endsWith(".wgsl")).sort();
// Dawn ends with the instance, which the collector would take although its device is in use.
globalThis.instance = create([]);
const adapter = await globalThis.instance.requestAdapter();
if (!adapter) throw new Error("Dawn finds no adapter");
const device = await adapter.requestDevice();

if (names.length === 0) throw new Error(`${folder} has no kernels`);

let refused = 0;
for (const name of names) {
  device.pushErrorScope("validation");
  const code = await readFile(join(folder, name), "utf8");
  const module = device.createShaderModule({ label: name, code });
  const { messages } = await module.getCompilationInfo();
  const entry = code.match(/@compute[^{]*?fn\s+(\w+)/)?.[1];
  // The pipeline, too, so that Tint writes what the driver takes.
  if (entry) device.createComputePipeline({ label: name, layout: "auto", compute: { module, entryPoint: entry } });
  const error = await device.popErrorScope();
  for (const { type, lineNum, linePos, message } of messages) {
    console.error(`${name}:${lineNum}:${linePos}: ${type}: ${message}`);
  }
  if (error) {
    refused += 1;
    if (messages.length === 0) console.error(`${name}: ${error.message}`);
  }
}
console.log(`Tint on ${adapter.info.description || adapter.info.device || adapter.info.vendor} takes ${names.length - refused} of ${names.length} files`);
process.exit(refused === 0 ? 0 : 1);
