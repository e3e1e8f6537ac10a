// SPDX-License-Identifier: MIT
// Runs the program, or samples a formula, beside the page, which stays alive and may end the worker. Every
// message is one job; its answer is the last message of several: {progress}, then {done} or {fault}.
import { parse_expression, sample } from './expression.js';
import { Process } from './wasi.js';

// The program's bar: "[###...]  42 %  coarsen  0:07" after a carriage return and an escape sequence.
const kBar = /\r\x1b\[K/;
const kShare = /(\d+) % +(\S[^,]*?)(?: {2}|$)/;

function run({ module, args, files, wanted }) {
  let said = '', errors = '';
  const process = new Process({
    args: ['deliso', ...args], files, environment: { TERM: 'page', NO_COLOR: '1' },
    say: (descriptor, text) => {
      if (descriptor === 1) {
        said += text;
        return;
      }
      const pieces = text.split(kBar), share = kShare.exec(pieces.at(-1));
      if (pieces.length > 1 && share) postMessage({ progress: Number(share[1]) / 100, stage: share[2] });
      else errors += pieces.join('');
    },
  });
  const status = process.run(module);
  const outputs = Object.fromEntries(wanted.map((name) => [name, process.written(name)]));
  postMessage({ done: { status, said, errors, outputs } },
              Object.values(outputs).filter(Boolean).map((bytes) => bytes.buffer));
}

onmessage = ({ data }) => {
  try {
    if (data.formula === undefined) {
      run(data);
    } else {
      const file = sample(parse_expression(data.formula), data.size, data.half);
      postMessage({ done: { file } }, [file.buffer]);
    }
  } catch (fault) {
    // Memory that cannot grow, a stack that is too deep, a formula with a fault.
    postMessage({ fault: fault.message });
  }
};
