// SPDX-License-Identifier: MIT
// What the page reads out of the program's answers.

// The histogram of `deliso info`: [{from, share}], share in percent. Lines "   16 |#### ...  4.5902 %".
export function histogram_of(text) {
  const bars = [];
  for (const line of text.split('\n')) {
    const found = /^ *(-?[\d.]+(?:e[+-]?\d+)?) \|#* +([\d.]+) %$/.exec(line);
    if (found) bars.push({ from: Number(found[1]), share: Number(found[2]) });
  }
  return bars;
}

// Heights in [0, 1] that grow with the logarithm of the share, as the program's own bars do.
export function heights_of(bars) {
  const most = Math.max(...bars.map((bar) => bar.share)), kLeast = 1e-4;
  return bars.map(({ share }) => share > 0
    ? Math.max(0.02, Math.log(Math.max(share, kLeast) / kLeast) / Math.log(most / kLeast)) : 0);
}

// An isovalue as one types it: as many digits as a thousandth of the range needs.
export function rounded(value, [low, high]) {
  const digits = Math.max(0, 3 - Math.floor(Math.log10(Math.max(high - low, Number.MIN_VALUE))));
  return Number(value.toFixed(Math.min(digits, 20)));
}

// Splits further options as a shell does, without variables: blanks part words, quotes keep them.
export function words_of(text) {
  const words = [];
  for (const found of text.matchAll(/(?:"[^"]*"|'[^']*'|[^\s"'])+/g)) words.push(found[0].replace(/["']/g, ''));
  return words;
}

// The labels of a segmentation that the options name: 'all', numbers, or null.
export function label_in(words) {
  const at = words.indexOf('--label');
  return at < 0 ? null : words[at + 1] ?? '';
}
// The label that `deliso info` says to try, or null.
export function label_to_try(text) {
  return /^try +--label (\S+)/m.exec(text)?.[1] ?? null;
}

// The command that does the same at a terminal.
export function command_of(args) {
  return ['deliso', ...args].map((word) => /^[\w./:=,%+-]+$/.test(word) ? word : `'${word.replaceAll("'", `'\\''`)}'`)
    .join(' ');
}

// Which of the given files the program is to open: a header, else the only file, else the folder of all.
export function input_of(paths) {
  const names = paths.filter((path) => !path.split('/').at(-1).startsWith('.'));
  if (names.length === 1) return names[0];
  const header = names.find((path) => /(\.(nhdr|mhd|hdr)|^dicomdir|\/dicomdir)$/i.test(path));
  if (header) return header;
  const folders = new Set(names.map((path) => path.slice(0, Math.max(0, path.indexOf('/')))));
  return folders.size === 1 && !folders.has('') ? [...folders][0] : '.';
}

// What files that are made of an input are called.
export function stem_of(input) {
  return input.split('/').at(-1).replace(/\.(nii\.gz|\w+)$/i, '').replace(/^\.$/, '') || 'mesh';
}
