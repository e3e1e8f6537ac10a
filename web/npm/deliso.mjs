#!/usr/bin/env node
// SPDX-License-Identifier: MIT
// Runs deliso.wasm, which lies beside this file, as the program: with its arguments, standard streams,
// environment, folder and exit status. It sees the files that the user sees.
import { readFileSync } from 'node:fs';
import { parse } from 'node:path';

// node:wasi says on standard error that it may change. A run's errors are all that belongs there.
process.emitWarning = () => {};
const { WASI } = await import('node:wasi');

const folder = process.cwd(), { root } = parse(folder);
const wasi = new WASI({
  version: 'preview1',
  args: ['deliso', ...process.argv.slice(2)],
  env: { ...process.env, PWD: `/${folder.slice(root.length).replaceAll('\\', '/')}` },
  preopens: { '/': root },
});
// Node forgets the object while the program runs, and with it the open files, unless something holds it.
globalThis.wasi = wasi;
// What a native program is ended with that breaks a rule of its own (SIGABRT).
const kAborted = 134;
try {
  const module = new WebAssembly.Module(readFileSync(new URL('deliso.wasm', import.meta.url)));
  process.exitCode = wasi.start(new WebAssembly.Instance(module, wasi.getImportObject()));
} catch (fault) {
  console.error(`deliso: ended by ${fault.name}: ${fault.message}`);
  process.exitCode = kAborted;
}
