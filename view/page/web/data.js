'use strict';
// The data of a page (view/page/page.h): a header, and flat arrays of numbers, compressed, in base64.

const kNone = 0xffffffff;  // an id that names nothing

const kBase64 = (() => {
  const values = new Uint8Array(128).fill(255);
  const digits = 'ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/';
  for (let n = 0; n < 64; ++n) values[digits.charCodeAt(n)] = n;
  return values;
})();

// Without white space in it. Stops at the padding.
function decode_base64(text) {
  let end = text.length;
  while (end > 0 && text.charCodeAt(end - 1) === 61) --end;
  const bytes = new Uint8Array(Math.floor(end * 3 / 4));
  let to = 0, group = 0;
  for (let n = 0; n < end; ++n) {
    group = group << 6 | kBase64[text.charCodeAt(n)];
    if ((n & 3) === 3) {
      bytes[to++] = group >> 16;
      bytes[to++] = group >> 8;
      bytes[to++] = group;
      group = 0;
    }
  }
  const left = end & 3;
  if (left > 1) bytes[to++] = group >> 6 * left - 8;
  if (left > 2) bytes[to++] = group >> 2;
  return bytes;
}

const kArrayTypes = { f32: Float32Array, u32: Uint32Array, u16: Uint16Array, u8: Uint8Array };

// Views on the bytes. What reaches beyond their end is left out, so that a page that was cut off
// shows what there is of it.
function arrays_of(directory, bytes) {
  const arrays = {};
  for (const [name, { type, offset, length }] of Object.entries(directory)) {
    const Type = kArrayTypes[type];
    const there = Math.floor((bytes.length - offset) / Type.BYTES_PER_ELEMENT);
    arrays[name] = there > 0 ? new Type(bytes.buffer, offset, Math.min(there, length)) : new Type(0);
  }
  return arrays;
}

// What zlib has compressed; of data that was cut off, what there is of it.
async function inflate(compressed) {
  const reader = new Blob([compressed]).stream().pipeThrough(new DecompressionStream('deflate'))
    .getReader();
  const pieces = [];
  try {
    for (let next = await reader.read(); !next.done; next = await reader.read()) {
      pieces.push(next.value);
    }
  } catch (fault) {
    console.info(`The page's data end early: ${fault.message}`);
  }
  return new Uint8Array(await new Blob(pieces).arrayBuffer());
}

// The page's own data. Gives up the text, which is not needed again.
async function read_page_data() {
  const text = (id) => document.getElementById(id)?.textContent ?? '';
  const header = JSON.parse(text('header') || '{}');
  const bytes = await inflate(decode_base64(text('bytes')));
  document.getElementById('bytes')?.remove();
  return { header, arrays: arrays_of(JSON.parse(text('arrays') || '{}'), bytes) };
}
