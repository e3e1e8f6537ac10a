#!/usr/bin/env node
// SPDX-License-Identifier: MIT
// Runs deliso.wasm, which lies beside this file, as the program: with its arguments, standard streams,
// environment, folder and exit status. It sees the files that the user sees.
import { readFileSync } from 'node:fs';
import { parse } from 'node:path';
import { setFlagsFromString } from 'node:v8';

// Node's functions for WASI are called by V8's fast way for host functions, on which no garbage may be
// collected. They allocate, so it is, and Node crashes at random: github.com/nodejs/node/issues/46777.
setFlagsFromString('--no-turbo-fast-api-calls');

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
// What a native program is ended with that breaks a rule of its own (SIGABRT).
const kAborted = 134;
try {
  const module = new WebAssembly.Module(readFileSync(new URL('deliso.wasm', import.meta.url)));
  process.exitCode = wasi.start(new WebAssembly.Instance(module, wasi.getImportObject()));
} catch (fault) {
  console.error(`deliso: ended by ${fault.name}: ${fault.message}`);
  process.exitCode = kAborted;
}
