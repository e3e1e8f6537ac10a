// SPDX-License-Identifier: MIT
// The page in Chromium, by the keyboard where a person may: a volume from a file and from a formula, the
// isovalue, the mesh, its files, an error, the stop button, a narrow screen. A mesh that is saved has the bytes
// of the native program. Pictures go to a folder, if one is given.
// Usage: node page.mjs build-web/page NATIVE [PICTURES] [axe.min.js]
import { execFileSync, spawnSync } from 'node:child_process';
import { existsSync, mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { join, resolve } from 'node:path';
import { Browser, serve } from './browser.mjs';

const [folder, native, pictures, axe] = process.argv.slice(2);
const program = ['chromium', 'chromium-browser', 'google-chrome', 'google-chrome-stable']
  .find((name) => spawnSync('sh', ['-c', `command -v ${name}`]).status === 0);
if (!program) {
  console.log('no Chromium here');
  process.exit(77);
}
let faults = 0;
function holds(what, is_so) {
  console.log(`${is_so ? 'fine ' : 'FAULT'}  ${what}`);
  if (!is_so) ++faults;
}

const server = await serve(resolve(folder)), browser = new Browser(program);
const is_idle = "document.querySelector('#run').hidden";
const text_of = (id) => browser.value(`document.querySelector('#${id}').textContent`);
const focus = (id) => browser.value(`document.querySelector('#${id}').focus()`);
async function picture(name) {
  if (pictures) writeFileSync(join(pictures, `${name}.png`), await browser.picture());
}
async function scroll_to(id) {
  await browser.value(`document.querySelector('#${id}').scrollIntoView()`);
}
async function set_text(id, text) {
  await browser.value(`document.querySelector('#${id}').select()`);
  await browser.type(text);
}
// A gray image of bytes, as TIFF: a header, the samples, and nine fields that describe them.
function tiff(width, height, samples) {
  const fields = [[256, 4, width], [257, 4, height], [258, 3, 8], [259, 3, 1], [262, 3, 1], [273, 4, 8], [277, 3, 1],
    [278, 4, height], [279, 4, samples.length]];
  const end = Buffer.alloc(2 + 12 * fields.length + 4), begin = Buffer.from('II*\0\0\0\0\0', 'latin1');
  begin.writeUInt32LE(8 + samples.length, 4);
  end.writeUInt16LE(fields.length);
  fields.forEach(([tag, type, value], n) => {
    end.writeUInt16LE(tag, 2 + 12 * n);
    end.writeUInt16LE(type, 4 + 12 * n);
    end.writeUInt32LE(1, 6 + 12 * n);
    end.writeUInt32LE(value, 10 + 12 * n);
  });
  return Buffer.concat([begin, samples, end]);
}
// A slice of a CT with 16 bits, as DICOM: elements of a group, a number, a kind and a value.
function dicom(width, height, number, samples) {
  const short = (value) => Buffer.from(Uint16Array.of(value).buffer), text = (value) => Buffer.from(value);
  const element = (group, n, kind, value) => {
    const even = Buffer.concat([value, Buffer.alloc(value.length % 2, kind === 'UI' ? 0 : 0x20)]);
    const head = Buffer.alloc(kind === 'OW' ? 12 : 8);
    head.writeUInt16LE(group);
    head.writeUInt16LE(n, 2);
    head.write(kind, 4);
    if (kind === 'OW') head.writeUInt32LE(even.length, 8);
    else head.writeUInt16LE(even.length, 6);
    return Buffer.concat([head, even]);
  };
  return Buffer.concat([Buffer.alloc(128), text('DICM'),
    element(2, 0x10, 'UI', text('1.2.840.10008.1.2.1')), element(8, 0x60, 'CS', text('CT')),
    element(0x20, 0xe, 'UI', text('1.2.3')), element(0x20, 0x13, 'IS', text(`${number}`)),
    element(0x20, 0x32, 'DS', text(`0\\0\\${2 * number}`)), element(0x20, 0x37, 'DS', text('1\\0\\0\\0\\1\\0')),
    element(0x28, 2, 'US', short(1)), element(0x28, 4, 'CS', text('MONOCHROME2')), element(0x28, 0x10, 'US', short(height)),
    element(0x28, 0x11, 'US', short(width)), element(0x28, 0x30, 'DS', text('1\\1')), element(0x28, 0x100, 'US', short(16)),
    element(0x28, 0x101, 'US', short(16)), element(0x28, 0x102, 'US', short(15)), element(0x28, 0x103, 'US', short(0)),
    element(0x7fe0, 0x10, 'OW', Buffer.from(samples.buffer))]);
}
// A file that the page saves, as bytes.
async function saved(label, name) {
  await browser.value(`[...document.querySelectorAll('#downloads button')].find((b) => b.textContent === '${label}').click()`);
  const path = join(browser.folder, name);
  for (let n = 0; n < 600 && !existsSync(path); ++n) await new Promise((done) => setTimeout(done, 50));
  return readFileSync(path);
}
async function no_wider(width) {
  return browser.value(`document.documentElement.scrollWidth <= ${width}`);
}
async function violations() {
  if (!axe) return [];
  await browser.value(readFileSync(axe, 'utf8'));
  return browser.value("axe.run({ iframes: false }).then((r) => r.violations.map((v) => v.id + ': ' + v.nodes.map((n) => n.target).join(' ')))");
}

try {
  await browser.begin();
  await browser.size(1100, 900);
  await browser.open(`http://127.0.0.1:${server.address().port}/`);
  await browser.until("document.querySelector('#main')?.hidden === false");
  await picture('1-begin');

  // A formula: the keyboard alone, from the beginning of the page.
  for (let n = 0; n < 20 && await browser.value('document.activeElement.id') !== 'formula'; ++n) await browser.press('Tab');
  holds('Tab reaches the formula', await browser.value('document.activeElement.id') === 'formula');
  await set_text('formula', '0.1 - (sqrt(x^2 + y^2) - 0.6)^2 - z^2');
  await browser.press('Enter');
  await browser.until(`!document.querySelector('#slices').hidden && ${is_idle}`);
  holds('a torus has one component and Euler number 0', (await text_of('surface')).includes('1 component, Euler number 0'));
  await focus('slider');
  const before = await browser.value("document.querySelector('#isovalue').value");
  for (let n = 0; n < 3; ++n) await browser.press('ArrowRight');
  holds('an arrow key moves the isovalue', await browser.value("document.querySelector('#isovalue').value") !== before);
  await browser.until(`document.querySelector('#surface').textContent.includes('At ' + document.querySelector('#isovalue').value + ':') && ${is_idle}`);
  await picture('2-isovalue');
  await focus('mesh');
  await browser.press('Enter');
  await browser.until(`document.querySelector('#view').src !== '' && ${is_idle}`);
  holds('the report has a verdict', (await text_of('report')).includes('exact topology, no crossings'));
  holds('the focus is on the result', await browser.value("document.activeElement.id") === 'result-title');
  await browser.until("document.querySelector('#view').contentDocument.querySelector('#message')?.hidden");
  await scroll_to('result');
  await new Promise((done) => setTimeout(done, 500));
  await picture('3-mesh');
  holds('the STL has its length', ((stl) => stl.length === 84 + 50 * stl.readUInt32LE(80))(await saved('STL', 'function.stl')));
  holds('the 3MF is an archive', (await saved('3MF', 'function.3mf')).toString('latin1', 0, 2) === 'PK');
  holds('the GLB is one', (await saved('GLB', 'function.glb')).toString('latin1', 0, 4) === 'glTF');
  await picture('4-saved');

  // A volume from a file: the same bytes.
  const path = join(browser.folder, 'balls.nrrd'), n = 40;
  const samples = Float32Array.from({ length: n ** 3 }, (_, at) =>
    Math.cos(at % n / 4) + Math.cos(Math.floor(at / n) % n / 5) + Math.cos(Math.floor(at / n / n) / 6));
  writeFileSync(path, Buffer.concat([Buffer.from(`NRRD0004\ntype: float\ndimension: 3\nsizes: ${n} ${n} ${n}\nendian: little\nencoding: raw\n\n`),
                                     Buffer.from(samples.buffer)]));
  await browser.choose_files('#files', [path]);
  await browser.until(`document.querySelector('#loaded').textContent.includes('balls') && ${is_idle}`);
  await browser.value("Object.assign(document.querySelector('#isovalue'), { value: '0.7' }).dispatchEvent(new Event('input'))");
  for (const id of ['below', 'cap']) await browser.value(`document.querySelector('#${id}').click()`);
  holds('the command is shown', await text_of('command') === 'deliso balls.nrrd --iso 0.7 --inside below --cap -o mesh.ply');
  await browser.value("document.querySelector('#mesh').click()");
  await browser.until(`!document.querySelector('#result').hidden && ${is_idle}`);
  execFileSync(native, [path, '--iso', '0.7', '--inside', 'below', '--cap', '-q', '-o', join(browser.folder, 'native.ply')]);
  holds('a mesh from a file has the bytes of the native program',
        readFileSync(join(browser.folder, 'native.ply')).equals(await saved('PLY', 'balls.ply')));

  // Errors are one line; a run can be stopped.
  await set_text('options', '--nonsense');
  await browser.value("document.querySelector('#mesh').click()");
  await browser.until(`${is_idle} && !document.querySelector('#message').hidden`);
  holds('a bad option is one line', /^deliso: .*nonsense.*$/.test(await text_of('message')));
  await set_text('options', '--max-distance 0.002vox');
  await browser.value("document.querySelector('#mesh').click()");
  await browser.until("document.querySelector('#progress').value > 0");
  await picture('5-progress');
  await browser.value("document.querySelector('#stop').click()");
  holds('the stop button ends a run', await browser.value(is_idle) && await text_of('message') === 'Stopped.');
  await browser.choose_files('#files', [join(resolve(folder), 'style.css')]);
  await browser.until(`${is_idle} && document.querySelector('#message').textContent.startsWith('deliso: style.css')`);
  holds('a file that is no volume is one line', !(await text_of('message')).includes('\n'));

  // What is dropped: a header with its data, a folder of slices.
  const header = join(browser.folder, 'ramp.nhdr'), slices = join(browser.folder, 'slices'),
    scan = join(browser.folder, 'scan');
  writeFileSync(header, 'NRRD0004\ntype: uint8\ndimension: 3\nsizes: 8 8 8\nencoding: raw\ndata file: ramp.raw\n');
  writeFileSync(join(browser.folder, 'ramp.raw'), Buffer.from(Array.from({ length: 512 }, (_, at) => 20 * (at % 8) + 3 * (at >> 3 & 7) + (at >> 6))));
  mkdirSync(slices);
  mkdirSync(scan);
  for (let k = 0; k < 12; ++k) {
    const samples = Uint16Array.from({ length: 80 }, (_, at) => 90 * k + at % 10);
    writeFileSync(join(scan, `image${k}`), dicom(10, 8, k, samples));
    writeFileSync(join(slices, `${String(k).padStart(2, '0')}.tif`), tiff(10, 8, Buffer.from(Array.from({ length: 80 }, (_, at) => 18 * k + at % 10))));
  }
  const dropped = async (files, loaded) => {
    await browser.value('scrollTo(0, 0)');
    await browser.drop(files, 500, 260);
    await browser.until(`document.querySelector('#loaded').textContent.includes('${loaded}') && ${is_idle}`);
    await browser.until(`document.querySelector('#surface').textContent !== '' && ${is_idle}`);
    return (await text_of('surface')).includes(': 1 component');
  };
  holds('a header and its data are dropped',
        await dropped([header, join(browser.folder, 'ramp.raw')], '2 files: 8 × 8 × 8 uint8'));
  const three = ['00', '01', '02'].map((name) => join(slices, `${name}.tif`));
  holds('slices without their folder are dropped', await dropped(three, '3 files: 10 × 8 × 3 uint8'));
  holds('a folder of DICOM is dropped', await dropped([scan], 'scan: 10 × 8 × 12 uint16'));
  holds('a folder of slices is dropped', await dropped([slices], 'slices: 10 × 8 × 12 uint8'));

  // A segmentation: one label, then all of them as one mesh.
  const labels = join(browser.folder, 'labels.nrrd');
  writeFileSync(labels, 'NRRD0004\ntype: uint8\ndimension: 3\nsizes: 20 20 20\nencoding: ascii\n\n' +
    Array.from({ length: 8000 }, (_, at) => {
      const [i, j, k] = [at % 20, Math.floor(at / 20) % 20, Math.floor(at / 400)].map((n) => n - 9.5);
      return i * i + j * j + k * k > 60 ? 0 : i > 0 ? 1 : j > 0 ? 2 : 3;
    }).join(' '));
  await browser.value("document.querySelector('#options').value = ''");
  await browser.choose_files('#files', [labels]);
  await browser.until(`document.querySelector('#surface').textContent.startsWith('Label 1: 1 component') && ${is_idle}`);
  await browser.value("[...document.querySelectorAll('#suggestions button')].find((b) => b.textContent === 'all labels').click()");
  holds('all labels are one mesh', await text_of('command') === 'deliso labels.nrrd --cap --label all --shared mesh.ply');
  await browser.value("document.querySelector('#mesh').click()");
  await browser.until(`!document.querySelector('#result').hidden && ${is_idle}`);
  holds('which is saved as 3MF', (await saved('3MF', 'labels.3mf')).toString('latin1', 0, 2) === 'PK');

  // A telephone.
  await browser.choose_files('#files', [path]);
  await browser.until(`document.querySelector('#loaded').textContent.includes('balls') && ${is_idle}`);
  await set_text('options', '--max-distance 0.3vox');
  await browser.value("document.querySelector('#mesh').click()");
  await browser.until(`!document.querySelector('#result').hidden && ${is_idle}`);
  const wide = await violations();  // in light colors
  await browser.size(360, 740);
  holds('nothing is wider than a telephone', await no_wider(360));
  for (const id of ['volume-title', 'isovalue-title', 'mesh-title', 'result-title']) {
    await scroll_to(id);
    await new Promise((done) => setTimeout(done, 300));
    await picture(`6-narrow-${id.replace('-title', '')}`);
  }
  await browser.send('Emulation.setEmulatedMedia', { features: [{ name: 'prefers-color-scheme', value: 'dark' }] });
  await picture('7-dark');
  const found = [...wide, ...await violations()];
  if (axe) holds(`axe finds nothing, in light and dark ${found.join('; ')}`, found.length === 0);
  holds(`the console is empty ${browser.console.join('; ')}`, browser.console.length === 0);
} catch (fault) {
  holds(`${fault.message}; the page says "${await text_of('message').catch(() => '')}"; ${browser.console.join('; ')}`, false);
  await picture('fault').catch(() => {});
} finally {
  await browser.close();
  server.close();
}
process.exit(faults > 0 ? 1 : 0);
