// SPDX-License-Identifier: MIT
// What deliso.wasm asks of its host (WASI, preview 1), with files in memory: one process, from its arguments
// to its exit status. Files that are given are read where the browser has them; files that the process
// writes are arrays. All paths lie in one folder, the root.

const kFine = 0, kBadDescriptor = 8, kExists = 20, kInvalid = 28, kIsFolder = 31, kMissing = 44,
  kNotSupported = 58, kNoSeeking = 70;
const kTerminal = 2, kFolder = 3, kRegular = 4;
const kCreate = 1, kOnlyFolder = 2, kExclusive = 4, kTruncate = 8;
const kRoot = 3, kFirstFree = 4;
const kAllRights = (1n << 30n) - 1n, kSeekAndTell = 0x24n;
// A browser reads a part of a file at a time, which must fit into its memory beside the program's.
const kMostRead = 1 << 26;

class Exit extends Error {
  constructor(status) {
    super(`exit ${status}`);
    this.status = status;
  }
}

// Bytes that grow at their end.
class WrittenFile {
  constructor() {
    this.buffer = new Uint8Array(1 << 12);
    this.size = 0;
  }
  write(at, bytes) {
    const end = at + bytes.length;
    if (end > this.buffer.length) {
      const grown = new Uint8Array(Math.max(end, 2 * this.buffer.length));
      grown.set(this.buffer.subarray(0, this.size));
      this.buffer = grown;
    }
    this.buffer.set(bytes, at);
    this.size = Math.max(this.size, end);
  }
  read(at, count) {
    return this.buffer.subarray(at, Math.min(at + count, this.size));
  }
  bytes() {
    return this.buffer.slice(0, this.size);
  }
}

// A file of the browser. It cannot be written.
class GivenFile {
  constructor(blob) {
    this.blob = blob;
    this.size = blob.size;
  }
  read(at, count) {
    const part = this.blob.slice(at, at + Math.min(count, kMostRead));
    return new Uint8Array(new FileReaderSync().readAsArrayBuffer(part));
  }
}

export class Process {
  // files: {path: Blob}. say(descriptor, text) is called with what is written to the standard streams.
  constructor({ args, files = {}, environment = {}, say }) {
    this.args = args;
    this.environment = Object.entries(environment).map(([name, value]) => `${name}=${value}`);
    this.files = new Map(Object.entries(files).map(([path, blob]) => [path, new GivenFile(blob)]));
    this.open = new Map();
    this.decoders = [1, 2].map(() => new TextDecoder());
    this.say = say;
  }

  // Runs the program to its end and returns its exit status.
  run(module) {
    const names = WebAssembly.Module.imports(module).map((wanted) => wanted.name);
    const functions = Object.fromEntries(names.map((name) => [name, (...all) => this[name](...all)]));
    const instance = new WebAssembly.Instance(module, { wasi_snapshot_preview1: functions });
    this.memory = instance.exports.memory;
    try {
      instance.exports._start();
    } catch (thrown) {
      if (thrown instanceof Exit) return thrown.status;
      throw thrown;
    }
    return 0;
  }

  // The bytes of a file that the process wrote, or null.
  written(path) {
    const file = this.files.get(path);
    return file instanceof WrittenFile ? file.bytes() : null;
  }

  // Memory moves when it grows, so views of it do not last. Addresses come as signed numbers.
  get view() {
    return new DataView(this.memory.buffer);
  }
  bytes_at(address, size) {
    return new Uint8Array(this.memory.buffer, address >>> 0, size >>> 0);
  }
  text_at(address, size) {
    return new TextDecoder().decode(this.bytes_at(address, size).slice());
  }
  set_number(address, value) {
    this.view.setUint32(address >>> 0, value, true);
  }
  set_large(address, value) {
    this.view.setBigUint64(address >>> 0, BigInt(value), true);
  }
  // The buffers of a read or a write.
  pieces(list, count) {
    return Array.from({ length: count }, (_, n) => {
      const at = (list >>> 0) + 8 * n;
      return this.bytes_at(this.view.getUint32(at, true), this.view.getUint32(at + 4, true));
    });
  }

  strings_sizes(strings, count_to, size_to) {
    this.set_number(count_to, strings.length);
    this.set_number(size_to, strings.reduce((sum, text) => sum + new TextEncoder().encode(text).length + 1, 0));
    return kFine;
  }
  strings(strings, pointers_to, to) {
    let at = to >>> 0;
    strings.forEach((text, n) => {
      const bytes = new TextEncoder().encode(`${text}\0`);
      this.set_number((pointers_to >>> 0) + 4 * n, at);
      this.bytes_at(at, bytes.length).set(bytes);
      at += bytes.length;
    });
    return kFine;
  }
  args_sizes_get(count_to, size_to) { return this.strings_sizes(this.args, count_to, size_to); }
  args_get(pointers_to, to) { return this.strings(this.args, pointers_to, to); }
  environ_sizes_get(count_to, size_to) { return this.strings_sizes(this.environment, count_to, size_to); }
  environ_get(pointers_to, to) { return this.strings(this.environment, pointers_to, to); }

  // 0: the time of day, in nanoseconds; all others begin anywhere.
  clock_time_get(clock, precision, to) {
    const milliseconds = clock === 0 ? Date.now() : performance.now();
    this.set_large(to, Math.round(milliseconds * 1e6));
    return kFine;
  }
  proc_exit(status) { throw new Exit(status); }
  poll_oneoff() { return kNotSupported; }

  // Descriptors. The three standard streams are a terminal's.
  kind_of(descriptor) {
    if (descriptor < kRoot) return kTerminal;
    return descriptor === kRoot ? kFolder : this.open.has(descriptor) ? kRegular : null;
  }
  fd_fdstat_get(descriptor, to) {
    const kind = this.kind_of(descriptor);
    if (kind === null) return kBadDescriptor;
    const rights = kind === kTerminal ? kAllRights & ~kSeekAndTell : kAllRights;
    this.set_large(to, kind);
    this.set_large(to + 8, rights);
    this.set_large(to + 16, rights);
    return kFine;
  }
  fd_fdstat_set_flags() { return kFine; }
  fd_close(descriptor) {
    return this.open.delete(descriptor) || descriptor <= kRoot ? kFine : kBadDescriptor;
  }
  fd_prestat_get(descriptor, to) {
    if (descriptor !== kRoot) return kBadDescriptor;
    this.set_large(to, 1n << 32n);  // a folder, and the length of its name
    return kFine;
  }
  fd_prestat_dir_name(descriptor, to) {
    this.bytes_at(to, 1).set([0x2f]);
    return kFine;
  }
  fd_seek(descriptor, offset, whence, to) {
    const open = this.open.get(descriptor);
    if (!open) return descriptor < kRoot ? kNoSeeking : kBadDescriptor;
    const at = [0, open.at, open.file.size][whence] + Number(offset);
    if (at < 0) return kInvalid;
    open.at = at;
    this.set_large(to, at);
    return kFine;
  }
  // Reads into the buffers; a short read is no end of the file.
  read_into(file, at, list, count, size_to) {
    let size = 0;
    for (const piece of this.pieces(list, count)) {
      const read = file.read(at + size, piece.length);
      piece.set(read);
      size += read.length;
      if (read.length < piece.length) break;
    }
    this.set_number(size_to, size);
    return size;
  }
  fd_pread(descriptor, list, count, offset, size_to) {
    const open = this.open.get(descriptor);
    if (!open) return kBadDescriptor;
    this.read_into(open.file, Number(offset), list, count, size_to);
    return kFine;
  }
  fd_read(descriptor, list, count, size_to) {
    const open = this.open.get(descriptor);
    if (!open && descriptor !== 0) return kBadDescriptor;
    if (open) open.at += this.read_into(open.file, open.at, list, count, size_to);
    else this.set_number(size_to, 0);
    return kFine;
  }
  fd_write(descriptor, list, count, size_to) {
    const open = this.open.get(descriptor);
    if (!open && descriptor !== 1 && descriptor !== 2) return kBadDescriptor;
    let size = 0;
    for (const piece of this.pieces(list, count)) {
      if (open) {
        open.file.write(open.at, piece);
        open.at += piece.length;
      } else {
        this.say(descriptor, this.decoders[descriptor - 1].decode(piece.slice(), { stream: true }));
      }
      size += piece.length;
    }
    this.set_number(size_to, size);
    return kFine;
  }

  // Paths. A folder is there if files lie in it; the root always is.
  path_of(address, size) {
    return this.text_at(address, size).split('/').filter((name) => name && name !== '.').join('/');
  }
  is_folder(path) {
    return path === '' || [...this.files.keys()].some((name) => name.startsWith(`${path}/`));
  }
  path_open(folder, follow, address, size, flags, rights, inherited, flags_of_file, to) {
    const path = this.path_of(address, size);
    const is_there = this.files.has(path);
    if (!is_there && this.is_folder(path)) {
      this.open.set(this.free_descriptor(to), { folder: path, at: 0, file: new WrittenFile() });
      return kFine;
    }
    if (flags & kOnlyFolder) return is_there ? kInvalid : kMissing;
    if (is_there && flags & kCreate && flags & kExclusive) return kExists;
    if (!is_there && !(flags & kCreate)) return kMissing;
    if (!is_there || flags & kTruncate) this.files.set(path, new WrittenFile());
    this.open.set(this.free_descriptor(to), { file: this.files.get(path), at: 0 });
    return kFine;
  }
  free_descriptor(to) {
    let free = kFirstFree;
    while (this.open.has(free)) ++free;
    this.set_number(to, free);
    return free;
  }
  path_rename(folder, from, from_size, other, to, to_size) {
    const path = this.path_of(from, from_size);
    if (!this.files.has(path)) return kMissing;
    this.files.set(this.path_of(to, to_size), this.files.get(path));
    this.files.delete(path);
    return kFine;
  }
  path_unlink_file(folder, address, size) {
    return this.files.delete(this.path_of(address, size)) ? kFine : kMissing;
  }
  path_link() { return kNotSupported; }
  path_readlink() { return kInvalid; }  // no link

  // Two files are the same if their numbers are. They do not change while the process runs.
  set_status(to, kind, file) {
    this.bytes_at(to, 64).fill(0);
    const number = [...this.files.values()].indexOf(file) + 1;
    this.set_large(to + 8, number);
    this.set_large(to + 16, kind);
    this.set_large(to + 24, 1);
    this.set_large(to + 32, file?.size ?? 0);
    return kFine;
  }
  path_filestat_get(folder, follow, address, size, to) {
    const path = this.path_of(address, size);
    if (this.files.has(path)) return this.set_status(to, kRegular, this.files.get(path));
    return this.is_folder(path) ? this.set_status(to, kFolder) : kMissing;
  }
  fd_filestat_get(descriptor, to) {
    const open = this.open.get(descriptor), kind = this.kind_of(descriptor);
    if (kind === null) return kBadDescriptor;
    const is_folder = open?.folder !== undefined;
    return this.set_status(to, is_folder ? kFolder : kind, is_folder ? undefined : open?.file);
  }
  fd_readdir(descriptor, to, room, cookie, size_to) {
    const folder = descriptor === kRoot ? '' : this.open.get(descriptor)?.folder;
    if (folder === undefined) return kBadDescriptor;
    const prefix = folder === '' ? '' : `${folder}/`;
    const names = new Map();
    for (const path of this.files.keys()) {
      if (!path.startsWith(prefix)) continue;
      const [name, ...rest] = path.slice(prefix.length).split('/');
      names.set(name, rest.length > 0 ? kFolder : kRegular);
    }
    const out = this.bytes_at(to, room);
    let used = 0;
    [...names].slice(Number(cookie)).forEach(([name, kind], n) => {
      const text = new TextEncoder().encode(name), entry = new Uint8Array(24 + text.length);
      const fields = new DataView(entry.buffer);
      fields.setBigUint64(0, cookie + BigInt(n + 1), true);
      fields.setUint32(16, text.length, true);
      fields.setUint8(20, kind);
      entry.set(text, 24);
      // The last entry may be cut: then the next call begins with it.
      const fits = entry.subarray(0, Math.max(0, out.length - used));
      out.set(fits, used);
      used += fits.length;
    });
    this.set_number(size_to, used);
    return kFine;
  }
}
