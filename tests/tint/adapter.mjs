// Whether Dawn starts on this machine and finds an adapter.
import process from "node:process";
import { create } from "webgpu";

globalThis.instance = create([]);
process.exit((await globalThis.instance.requestAdapter()) ? 0 : 1);
