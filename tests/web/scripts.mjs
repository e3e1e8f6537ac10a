// SPDX-License-Identifier: MIT
// What the scripts of the browser's page compute. Usage: node scripts.mjs SOURCE_FOLDER
import assert from 'node:assert/strict';
import { join, resolve } from 'node:path';
import { pathToFileURL } from 'node:url';

const load = (name) => import(pathToFileURL(join(resolve(process.argv[2]), 'web/page', name)));
const { parse_expression, sample } = await load('expression.js');
const report = await load('report.js');

// Formulas, beside what JavaScript makes of the same.
const [x, y, z] = [0.3, -1.7, 2.5];
const r = Math.hypot(x, y, z);
for (const [text, value] of [
  ['x', x], ['-x^2', -(x ** 2)], ['(-x)^2', x ** 2], ['2^3^2', 512], ['2^-1', 0.5], ['1-2-3', -4], ['8/4/2', 1],
  ['x + 2y - -z', x + 2 * y + z], ['2 sin(pi/2) x(y+1)', 2 * x * (y + 1)], ['1.5e-3x', 1.5e-3 * x], ['.5 z', z / 2],
  ['max(x, y)^2/4', x ** 2 / 4], ['atan2(y, x)', Math.atan2(y, x)], ['x**2', x ** 2], ['SQRT(ABS(Y))', Math.sqrt(1.7)],
  ['e^x', Math.exp(x)], ['2(x)(y)', 2 * x * y],
]) {
  assert(Math.abs(parse_expression(text)(x, y, z) - value) < 1e-12, text);
}
assert(Math.abs(parse_expression('r')(x, y, z) - r) < 1e-12);
for (const [text, fault] of [
  ['', 'missing at the end'], ['x +', 'missing at the end'], ['x)', 'ends before ")"'], ['(x', 'a ")" is missing'],
  ['sin x', 'a "(" is missing before "x"'], ['min(x)', 'a "," is missing'], ['x $ y', '"$" is no part'],
  ['constructor', 'not known'], ['toString(x)', 'not known'], ['__proto__', 'is no part'],
  ['('.repeat(100000), 'too many brackets'], ['-'.repeat(100000), 'too many signs'],
]) {
  assert.throws(() => parse_expression(text), (error) => error.message.includes(fault), text.slice(0, 20));
}

// Samples: x runs first, and the corners of the cube are samples.
const file = Buffer.from(sample(parse_expression('x + 10y + 100z'), 3, 2));
const data = file.subarray(file.indexOf('\n\n') + 2);
assert.equal(data.length, 4 * 27);
for (const [n, value] of [[0, -222], [1, -220], [3, -202], [9, -22], [13, 0], [26, 222]]) {
  assert.equal(data.readFloatLE(4 * n), value);
}
assert.match(file.toString('latin1'), /space origin: \(-2,-2,-2\)\n/);
assert.throws(() => sample(parse_expression('1/x'), 3, 1), /no finite number at 0, -1, -1/);

// The program's answers.
const text = 'volume    v\n        from |bars                share\n       -1.5 |####     5.5908 %\n' +
  '           0 |         0.0000 %\n      2e+08 |########  94.4092 %\n\ntry       --iso 61.6\n';
const bars = report.histogram_of(text);
assert.deepEqual(bars, [{ from: -1.5, share: 5.5908 }, { from: 0, share: 0 }, { from: 2e8, share: 94.4092 }]);
const heights = report.heights_of(bars);
assert(heights[2] === 1 && heights[1] === 0 && 0.5 < heights[0] && heights[0] < 1);
assert.equal(report.rounded(61.6234567, [0, 255]), 61.6);
assert.equal(report.rounded(0.0012345678, [0, 0.01]), 0.00123);
assert.equal(report.rounded(1234.56, [-1000, 3000]), 1235);
assert.deepEqual(report.words_of(' --smooth  1 --label "a b",c '), ['--smooth', '1', '--label', 'a b,c']);
assert.equal(report.label_in(['--cap', '--label', 'all']), 'all');
assert.equal(report.label_in(['--cap']), null);
assert.equal(report.label_to_try('a\ntry       --label 12   952 samples\n'), '12');
assert.equal(report.label_to_try(text), null);
assert.equal(report.command_of(['my scan.nrrd', '--iso', '1']), "deliso 'my scan.nrrd' --iso 1");
for (const [paths, input] of [
  [['a.nrrd'], 'a.nrrd'], [['a.raw', 'a.nhdr'], 'a.nhdr'], [['scan/1.dcm', 'scan/2.dcm', 'scan/.hidden'], 'scan'],
  [['1.tif', '2.tif'], '.'], [['scan/a/1', 'scan/b/2'], 'scan'], [['a', 'DICOMDIR'], 'DICOMDIR'],
]) {
  assert.equal(report.input_of(paths), input, paths.join());
}
for (const [input, stem] of [['scan.nii.gz', 'scan'], ['a/b.c.tif', 'b.c'], ['.', 'mesh'], ['DICOMDIR', 'DICOMDIR']]) {
  assert.equal(report.stem_of(input), stem);
}
console.log('fine');
