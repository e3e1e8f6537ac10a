// SPDX-License-Identifier: MIT
// Puts the scripts of a page, in the page's order, and the tests of them into one context, as the
// page does, and runs the tests. The last script is left out: it begins.
// Usage: node run_web_tests.js PROJECT PAGE.html TESTS.js LEAST, page and tests by their paths in the
// project, of which there are at least LEAST. A script lies beside its page, or with those of every page.
'use strict';
const assert = require('node:assert/strict');
const fs = require('node:fs');
const path = require('node:path');
const vm = require('node:vm');
const zlib = require('node:zlib');

const [root, markup, own, least] = process.argv.slice(2);
const web = path.dirname(path.join(root, markup));
const page = fs.readFileSync(path.join(root, markup), 'utf8');
const scripts = [...page.matchAll(/^<script src="(.*)"><\/script>$/gm)].map((match) => match[1]);
const files = fs.readdirSync(web).filter((name) => name.endsWith('.js'));
const is_beside = (name) => files.includes(name);
assert.deepEqual(scripts.filter(is_beside).sort(), files.sort(), 'the page names every script once');
const file_of = (name) => path.join(is_beside(name) ? web : path.join(root, 'view/page/web'), name);

const tests = [];
for (const [name, value] of Object.entries({ assert, fs, path, root, zlib, test: (what, run) => tests.push([what, run]) })) {
  globalThis[name] = value;
}
for (const script of scripts.slice(0, -1)) {
  vm.runInThisContext(fs.readFileSync(file_of(script), 'utf8'), { filename: script });
}
vm.runInThisContext(fs.readFileSync(path.join(root, own), 'utf8'), { filename: own });

(async () => {
  let failed = 0;
  for (const [what, run] of tests) {
    try {
      await run();
    } catch (fault) {
      ++failed;
      console.log(`FAILED: ${what}\n${fault.stack}`);
    }
  }
  console.log(`${tests.length} tests, ${failed} failed`);
  process.exit(failed > 0 || tests.length < Number(least) ? 1 : 0);
})();
