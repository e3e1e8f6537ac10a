'use strict';
// The graphics card: programs, and textures as growing arrays. The card can lose all of it at any
// time, as when a driver starts anew or a laptop wakes. So each object keeps its content in memory. It
// makes its part on the card again if that belongs to an earlier context.

// Whether WebGL is there, but by the processor.
function draws_by_software() {
  const gl = document.createElement('canvas').getContext('webgl2');
  const info = gl?.getExtension('WEBGL_debug_renderer_info');
  const name = info ? gl.getParameter(info.UNMASKED_RENDERER_WEBGL) : '';
  gl?.getExtension('WEBGL_lose_context')?.loseContext();
  return /SwiftShader|llvmpipe|softpipe|Basic Render/i.test(name);
}

class Program {
  constructor(vertex, fragment) {
    this.sources = [vertex, fragment];
    this.gl = null;
  }

  use(gl) {
    if (this.gl !== gl.generation) this.compile(gl);
    gl.useProgram(this.program);
  }

  compile(gl) {
    const program = gl.createProgram();
    [gl.VERTEX_SHADER, gl.FRAGMENT_SHADER].forEach((type, n) => {
      const shader = gl.createShader(type);
      gl.shaderSource(shader, this.sources[n]);
      gl.compileShader(shader);
      gl.attachShader(program, shader);
      if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS) && !gl.isContextLost()) {
        throw new Error('shader: ' + gl.getShaderInfoLog(shader));
      }
    });
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS) && !gl.isContextLost()) {
      throw new Error('program: ' + gl.getProgramInfoLog(program));
    }
    this.program = program;
    this.uniforms = {};
    const count = gl.getProgramParameter(program, gl.ACTIVE_UNIFORMS) ?? 0;
    for (let n = 0; n < count; ++n) {
      const name = gl.getActiveUniform(program, n).name.replace('[0]', '');
      this.uniforms[name] = gl.getUniformLocation(program, name);
    }
    this.gl = gl.generation;
  }
}

const kRowBits = 10, kRow = 1 << kRowBits;  // texels in a row of a texture

// An array of texels, each of four floats or four words. Rows that were touched are sent before the
// next picture, and no others.
class Texels {
  constructor(floats) {
    this.floats = floats;
    this.data = floats ? new Float32Array(4 * kRow) : new Uint32Array(4 * kRow);
    this.changed = new Uint8Array(1).fill(1);  // per row
    this.any_changed = true;
    this.gl = null;
  }

  get capacity() { return this.data.length / 4; }

  // Room for so many; keeps what is there.
  reserve(count) {
    if (count <= this.capacity) return;
    const rows = Math.max(2 * this.changed.length, Math.ceil(count / kRow));
    const grown = this.floats ? new Float32Array(4 * kRow * rows) : new Uint32Array(4 * kRow * rows);
    grown.set(this.data);
    this.data = grown;
    this.changed = new Uint8Array(rows);
    this.gl = null;
  }

  touch(texel) {
    this.changed[texel >> kRowBits] = 1;
    this.any_changed = true;
  }
  touch_all() {
    this.changed.fill(1);
    this.any_changed = true;
  }

  bind(gl, unit) {
    gl.activeTexture(gl.TEXTURE0 + unit);
    if (this.gl !== gl.generation) this.make(gl);
    gl.bindTexture(gl.TEXTURE_2D, this.texture);
    if (this.any_changed) this.send(gl);
  }

  make(gl) {
    if (this.changed.length > gl.getParameter(gl.MAX_TEXTURE_SIZE)) {
      throw new Error('this is more than the graphics card can take');
    }
    if (this.texture && this.made_in === gl.generation) gl.deleteTexture(this.texture);
    this.texture = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, this.texture);
    gl.texStorage2D(gl.TEXTURE_2D, 1, this.floats ? gl.RGBA32F : gl.RGBA32UI, kRow,
                    this.changed.length);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
    this.gl = this.made_in = gl.generation;
    this.touch_all();
  }

  send(gl) {
    const format = this.floats ? gl.RGBA : gl.RGBA_INTEGER;
    const type = this.floats ? gl.FLOAT : gl.UNSIGNED_INT;
    for (let row = 0; row < this.changed.length; ++row) {
      if (!this.changed[row]) continue;
      let end = row + 1;
      while (end < this.changed.length && this.changed[end]) ++end;
      gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, row, kRow, end - row, format, type, this.data,
                       4 * kRow * row);
      row = end;
    }
    this.changed.fill(0);
    this.any_changed = false;
  }
}

// Of a flat array of coordinates.
function texels_of_points(points) {
  const texels = new Texels(true);
  const count = points.length / 3;
  texels.reserve(count);
  for (let n = 0; n < count; ++n) {
    texels.data[4 * n] = points[3 * n];
    texels.data[4 * n + 1] = points[3 * n + 1];
    texels.data[4 * n + 2] = points[3 * n + 2];
  }
  return texels;
}
