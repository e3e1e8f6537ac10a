// SPDX-License-Identifier: MIT
// Puts the scripts of a page, in the page's order, and the tests of them into one context, as the
// page does, and runs the tests. main.js is left out: it begins.
'use strict';
const assert = require('node:assert/strict');
const fs = require('node:fs');
const path = require('node:path');
const vm = require('node:vm');
const zlib = require('node:zlib');

const root = process.argv[2];
const web = path.join(root, 'view/page/web');
const page = fs.readFileSync(path.join(web, 'page.html'), 'utf8');
const scripts = [...page.matchAll(/^<script src="(.*)"><\/script>$/gm)].map((match) => match[1]);
const files = fs.readdirSync(web).filter((name) => name.endsWith('.js'));
assert.deepEqual([...scripts].sort(), files.sort(), 'page.html names every script once');

const tests = [];
for (const [name, value] of Object.entries({ assert, zlib, test: (what, run) => tests.push([what, run]) })) {
  globalThis[name] = value;
}
for (const script of scripts.filter((name) => name !== 'main.js')) {
  vm.runInThisContext(fs.readFileSync(path.join(web, script), 'utf8'), { filename: script });
}
const own = path.join(root, 'tests/view/page/test_web.js');
vm.runInThisContext(fs.readFileSync(own, 'utf8'), { filename: own });

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
  process.exit(failed > 0 || tests.length < 10 ? 1 : 0);
})();
