// SPDX-License-Identifier: MIT
// Chromium for a test: a server of a folder's files, and one tab, which is told what to do by the DevTools
// protocol over a pipe. Nothing has to be installed for it.
import { spawn } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { createServer } from 'node:http';
import { tmpdir } from 'node:os';
import { extname, join } from 'node:path';

const kKinds = { '.html': 'text/html', '.js': 'text/javascript', '.css': 'text/css', '.svg': 'image/svg+xml',
  '.wasm': 'application/wasm' };
const kPatience = 60000;  // milliseconds

export function serve(folder) {
  const server = createServer((request, response) => {
    const name = request.url === '/' ? '/index.html' : decodeURI(request.url.split('?')[0]);
    try {
      const bytes = readFileSync(join(folder, name));
      response.writeHead(200, { 'Content-Type': kKinds[extname(name)] ?? 'application/octet-stream' }).end(bytes);
    } catch {
      response.writeHead(404).end();
    }
  });
  return new Promise((resolve) => server.listen(0, '127.0.0.1', () => resolve(server)));
}

export class Browser {
  constructor(program) {
    this.folder = mkdtempSync(join(tmpdir(), 'browser-'));
    this.process = spawn(program, ['--headless=new', '--no-sandbox', '--remote-debugging-pipe', '--use-angle=swiftshader',
      '--enable-unsafe-swiftshader', '--hide-scrollbars', `--user-data-dir=${this.folder}`, 'about:blank'],
      { stdio: ['ignore', 'ignore', 'ignore', 'pipe', 'pipe'] });
    this.calls = new Map();
    this.console = [];
    this.last = 0;
    let rest = '';
    this.process.stdio[4].on('data', (data) => {
      const messages = (rest + data).split('\0');
      rest = messages.pop();
      for (const text of messages) this.receive(JSON.parse(text));
    });
  }
  receive({ id, result, error, method, params }) {
    if (id !== undefined) {
      const { resolve, reject } = this.calls.get(id);
      return error ? reject(new Error(error.message)) : resolve(result);
    }
    if (method === 'Runtime.exceptionThrown') this.console.push(params.exceptionDetails.exception?.description);
    if (method === 'Runtime.consoleAPICalled') this.console.push(params.args.map((one) => one.value).join(' '));
    if (method === 'Log.entryAdded') this.console.push(`${params.entry.text} ${params.entry.url ?? ''}`);
  }
  send(method, params = {}) {
    const id = ++this.last;
    this.process.stdio[3].write(`${JSON.stringify({ id, method, params, sessionId: this.session })}\0`);
    return new Promise((resolve, reject) => this.calls.set(id, { resolve, reject }));
  }
  async begin() {
    const { targetInfos } = await this.send('Target.getTargets');
    const { targetId } = targetInfos.find((target) => target.type === 'page');
    this.session = (await this.send('Target.attachToTarget', { targetId, flatten: true })).sessionId;
    for (const domain of ['Page', 'Runtime', 'Log', 'DOM']) await this.send(`${domain}.enable`);
    await this.send('Browser.setDownloadBehavior', { behavior: 'allow', downloadPath: this.folder });
  }
  async open(address) {
    await this.send('Page.navigate', { url: address });
  }
  // The value of an expression in the page; a promise is awaited.
  async value(expression) {
    const answer = await this.send('Runtime.evaluate', { expression, awaitPromise: true, returnByValue: true });
    if (answer.exceptionDetails) throw new Error(answer.exceptionDetails.exception.description);
    return answer.result.value;
  }
  async until(expression) {
    for (const begun = Date.now(); Date.now() - begun < kPatience;) {
      if (await this.value(expression)) return;
      await new Promise((resolve) => setTimeout(resolve, 50));
    }
    throw new Error(`in vain waited until ${expression}`);
  }
  async size(width, height) {
    await this.send('Emulation.setDeviceMetricsOverride', { width, height, deviceScaleFactor: 1, mobile: width < 600 });
    await this.send('Emulation.setTouchEmulationEnabled', { enabled: width < 600 });
  }
  // A key as a keyboard sends it; letters are typed by type().
  async press(key) {
    const codes = { Tab: 9, Enter: 13, ' ': 32, ArrowLeft: 37, ArrowRight: 39 };
    const text = { Enter: '\r', ' ': ' ' }[key];
    const fields = { key, code: key === ' ' ? 'Space' : key, windowsVirtualKeyCode: codes[key] };
    await this.send('Input.dispatchKeyEvent', { type: text ? 'keyDown' : 'rawKeyDown', text, ...fields });
    await this.send('Input.dispatchKeyEvent', { type: 'keyUp', ...fields });
  }
  // A finger goes from a place to another in steps, and is lifted. It may go nowhere: a tap.
  async swipe([x, y], [dx, dy], steps = 4) {
    const touch = (type, points) => this.send('Input.dispatchTouchEvent', { type, touchPoints: points });
    await touch('touchStart', [{ x, y }]);
    for (let k = 1; k <= steps && (dx || dy); ++k) {
      await touch('touchMove', [{ x: x + dx * k / steps, y: y + dy * k / steps }]);
    }
    await touch('touchEnd', []);
  }
  // Until the page has been drawn.
  async frame() {
    await this.value('new Promise((done) => requestAnimationFrame(done))');
  }
  async type(text) {
    await this.send('Input.insertText', { text });
  }
  async choose_files(selector, files) {
    const { root } = await this.send('DOM.getDocument');
    const { nodeId } = await this.send('DOM.querySelector', { nodeId: root.nodeId, selector });
    await this.send('DOM.setFileInputFiles', { nodeId, files });
  }
  // Files and folders, as a file manager drops them.
  async drop(files, x, y) {
    const data = { items: [], files, dragOperationsMask: 1 };
    for (const type of ['dragEnter', 'dragOver', 'drop']) await this.send('Input.dispatchDragEvent', { type, x, y, data });
  }
  async picture() {
    const { data } = await this.send('Page.captureScreenshot', { format: 'png' });
    return Buffer.from(data, 'base64');
  }
  async close() {
    this.process.kill();
    await new Promise((resolve) => this.process.on('exit', resolve));
    rmSync(this.folder, { recursive: true, force: true, maxRetries: 5 });
  }
}
