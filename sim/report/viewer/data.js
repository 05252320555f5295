// SPDX-License-Identifier: BSD-3-Clause
// What the page carries: gzip in base64, see PageData in sim/report/page.h.
'use strict';

async function unpack(id) {
  const element = document.getElementById(id);
  const text = atob(element.textContent);
  element.remove();
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('gzip'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/** {result, scene, column}: column([begin, count], scale) gives numbers. */
function readPage(bytes) {
  const length = new DataView(bytes.buffer).getUint32(0, true);
  const json = JSON.parse(new TextDecoder().decode(bytes.subarray(4, 4 + length)));
  const packed = bytes.subarray(4 + length);
  const column = ([begin, count], scale = 1) => {
    const values = new Float64Array(count);
    let at = begin, last = 0;
    for (let i = 0; i < count; ++i) {
      let bits = 0, place = 1, byte;
      do {
        byte = packed[at++];
        bits += (byte & 127) * place;
        place *= 128;
      } while (byte > 127);
      last += bits % 2 ? -(bits + 1) / 2 : bits / 2;
      values[i] = last / scale;
    }
    return values;
  };
  return {result: json.result, scene: json.scene, column};
}

/** The last i with sorted[i] <= value, at least 0. */
function lastAtMost(sorted, value) {
  let low = 0, high = sorted.length;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (sorted[middle] <= value) low = middle; else high = middle;
  }
  return low;
}

function timeText(seconds, decimals = 0) {
  const rounded = Number(Math.max(0, seconds).toFixed(decimals));
  const h = Math.floor(rounded / 3600), m = Math.floor(rounded / 60) % 60, s = rounded % 60;
  const tail = s.toFixed(decimals).padStart(decimals ? 3 + decimals : 2, '0');
  return h ? `${h}:${String(m).padStart(2, '0')}:${tail}` : `${m}:${tail}`;
}

function plural(count, noun) { return `${count.toLocaleString('en')} ${noun}${count === 1 ? '' : 's'}`; }
