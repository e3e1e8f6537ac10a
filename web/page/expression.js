// SPDX-License-Identifier: MIT
// A function of x, y, z from its formula, and its samples as a NRRD file. The formula is parsed, by recursive
// descent, into functions that call one another: nothing of it is run as a script.

const kFunctions = {
  sin: [Math.sin, 1], cos: [Math.cos, 1], tan: [Math.tan, 1], asin: [Math.asin, 1], acos: [Math.acos, 1],
  atan: [Math.atan, 1], sinh: [Math.sinh, 1], cosh: [Math.cosh, 1], tanh: [Math.tanh, 1], sqrt: [Math.sqrt, 1],
  cbrt: [Math.cbrt, 1], abs: [Math.abs, 1], exp: [Math.exp, 1], log: [Math.log, 1], floor: [Math.floor, 1],
  min: [Math.min, 2], max: [Math.max, 2], pow: [Math.pow, 2], atan2: [Math.atan2, 2], hypot: [Math.hypot, 2],
};
const kConstants = { pi: Math.PI, e: Math.E };
const kVariables = {
  x: (x) => x, y: (x, y) => y, z: (x, y, z) => z, r: (x, y, z) => Math.sqrt(x * x + y * y + z * z),
};
const kDeepest = 200;

// Numbers, names, and signs. ** is ^.
function tokens_of(text) {
  const pattern = /\s*(?:(\d+\.?\d*(?:[eE][+-]?\d+)?|\.\d+(?:[eE][+-]?\d+)?)|([A-Za-z]\w*)|(\*\*|[-+*/^(),]))/y;
  const tokens = [];
  while (pattern.lastIndex < text.trimEnd().length) {
    const at = pattern.lastIndex, found = pattern.exec(text);
    if (!found) throw new Error(`"${text.slice(at).trim()[0]}" is no part of a formula`);
    const [, number, name, sign] = found;
    tokens.push(number ? { number: Number(number) } : name ? { name } : { sign: sign === '**' ? '^' : sign });
  }
  return tokens;
}

class Parser {
  constructor(text) {
    this.tokens = tokens_of(text);
    this.at = 0;
    this.depth = 0;
  }
  is(sign) {
    return this.tokens[this.at]?.sign === sign;
  }
  take(sign) {
    if (!this.is(sign)) return false;
    ++this.at;
    return true;
  }
  need(sign) {
    if (!this.take(sign)) throw new Error(`a "${sign}" is missing${this.here()}`);
  }
  here() {
    const token = this.tokens[this.at];
    return token ? ` before "${token.number ?? token.name ?? token.sign}"` : ' at the end';
  }

  sum() {
    if (++this.depth > kDeepest) throw new Error('too many brackets');
    let left = this.product();
    for (;;) {
      const a = left;
      if (this.take('+')) {
        const b = this.product();
        left = (x, y, z) => a(x, y, z) + b(x, y, z);
      } else if (this.take('-')) {
        const b = this.product();
        left = (x, y, z) => a(x, y, z) - b(x, y, z);
      } else {
        --this.depth;
        return left;
      }
    }
  }
  // Side by side is a product, too: 2x, 3 sin(x).
  product() {
    let left = this.signed();
    for (;;) {
      const a = left, next = this.tokens[this.at];
      if (this.take('/')) {
        const b = this.signed();
        left = (x, y, z) => a(x, y, z) / b(x, y, z);
      } else if (this.take('*') || (next && (next.sign === undefined || next.sign === '('))) {
        const b = this.signed();
        left = (x, y, z) => a(x, y, z) * b(x, y, z);
      } else {
        return left;
      }
    }
  }
  signed() {
    if (++this.depth > kDeepest) throw new Error('too many signs');
    let result;
    if (this.take('-')) {
      const a = this.signed();
      result = (x, y, z) => -a(x, y, z);
    } else {
      result = this.take('+') ? this.signed() : this.power();
    }
    --this.depth;
    return result;
  }
  // Binds tighter than a sign before it, and from the right: -x^2^3 is -(x^(2^3)).
  power() {
    const a = this.primary();
    if (!this.take('^')) return a;
    const b = this.signed();
    return (x, y, z) => Math.pow(a(x, y, z), b(x, y, z));
  }
  primary() {
    if (this.take('(')) {
      const inside = this.sum();
      this.need(')');
      return inside;
    }
    const token = this.tokens[this.at];
    if (token?.number !== undefined) {
      ++this.at;
      return () => token.number;
    }
    if (token?.name === undefined) throw new Error(`a number, x, y, z or a function is missing${this.here()}`);
    ++this.at;
    const name = token.name.toLowerCase();
    if (Object.hasOwn(kVariables, name)) return kVariables[name];
    if (Object.hasOwn(kConstants, name)) return () => kConstants[name];
    if (Object.hasOwn(kFunctions, name)) return this.call(name);
    throw new Error(`"${token.name}" is not known: there are x, y, z, r, pi, e and ${Object.keys(kFunctions).join(', ')}`);
  }
  call(name) {
    const [f, count] = kFunctions[name];
    this.need('(');
    const a = this.sum();
    if (count === 1) {
      this.need(')');
      return (x, y, z) => f(a(x, y, z));
    }
    this.need(',');
    const b = this.sum();
    this.need(')');
    return (x, y, z) => f(a(x, y, z), b(x, y, z));
  }
}

// Returns the function (x, y, z) of a formula. Throws an Error that says what is wrong with it.
export function parse_expression(text) {
  const parser = new Parser(text);
  const f = parser.sum();
  if (parser.at < parser.tokens.length) throw new Error(`the formula ends${parser.here()}`);
  return f;
}

// Returns a NRRD file with size^3 samples of f in the cube from -half to half. Throws an Error if one is no
// finite number.
export function sample(f, size, half) {
  const step = 2 * half / (size - 1), samples = new Float32Array(size ** 3);
  const place = (n) => -half + step * n;
  let at = 0;
  for (let k = 0; k < size; ++k) {
    for (let j = 0; j < size; ++j) {
      for (let i = 0; i < size; ++i) {
        const value = Math.fround(f(place(i), place(j), place(k)));
        if (!Number.isFinite(value)) {
          const where = [i, j, k].map((n) => Number(place(n).toPrecision(4))).join(', ');
          throw new Error(`the function is no finite number at ${where}`);
        }
        samples[at++] = value;
      }
    }
  }
  const header = ['NRRD0004', 'type: float', 'dimension: 3', 'space dimension: 3', `sizes: ${size} ${size} ${size}`,
    `space directions: (${step},0,0) (0,${step},0) (0,0,${step})`, `space origin: (${-half},${-half},${-half})`,
    'endian: little', 'encoding: raw', '', ''].join('\n');
  const text = new TextEncoder().encode(header), file = new Uint8Array(text.length + samples.byteLength);
  file.set(text);
  file.set(new Uint8Array(samples.buffer), text.length);
  return file;
}
