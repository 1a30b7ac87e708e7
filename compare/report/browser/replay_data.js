// Unpacks a replay (soilbin-replay/1, compare/replay/replay.hpp) into frames of 16-bit positions.
'use strict';

soilbin.inflate = async function (bytes) {
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
};

soilbin.bytesOf = function (base64) {
  const text = atob(base64), bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  return bytes;
};

// Frame by frame, x, y, z of each grain in turn. A frame is stored as three axes, each a plane of low bytes and one of
// high bytes of the zigzag-coded changes since the frame before.
soilbin.readFrames = function (raw, start, grains, count) {
  const frames = [], sum = new Uint16Array(3 * grains);
  let at = start;
  for (let f = 0; f < count; ++f) {
    for (let axis = 0; axis < 3; ++axis, at += 2 * grains)
      for (let k = 0; k < grains; ++k) {
        const z = raw[at + k] | raw[at + grains + k] << 8;
        sum[3 * k + axis] += (z >>> 1) ^ -(z & 1);
      }
    frames.push(sum.slice());
  }
  return frames;
};

soilbin.readReplay = async function (base64) {
  const bytes = soilbin.bytesOf(base64), end = bytes.indexOf(10);
  const header = JSON.parse(new TextDecoder().decode(bytes.subarray(0, end)));
  const raw = await soilbin.inflate(bytes.subarray(end + 1)), n = header.grains;
  const view = new DataView(raw.buffer);
  let at = 0;
  const floats = count => Float32Array.from({length: count}, () => view.getFloat32((at += 4) - 4, true));
  const radii = floats(n), vertices = floats(3 * header.vertices);
  const triangles = Uint32Array.from({length: 3 * header.triangles}, () => view.getUint32((at += 4) - 4, true));
  const frames = soilbin.readFrames(raw, at, n, header.frames), behind = at + 6 * n * header.frames;
  // A byte a grain and frame: 255 sqrt(F/pressing), F the largest normal force of its contacts.
  const pressing = header.pressing ? frames.map((_, f) => raw.subarray(behind + f * n, behind + (f + 1) * n)) : null;
  return {header, radii, vertices, triangles, frames, pressing};
};

soilbin.crcTable = Uint32Array.from({length: 256}, (_, n) => {
  for (let k = 0; k < 8; ++k) n = n & 1 ? 0xedb88320 ^ (n >>> 1) : n >>> 1;
  return n >>> 0;
});
soilbin.crcOf = function (bytes) {
  let crc = 0xffffffff;
  for (const byte of bytes) crc = soilbin.crcTable[(crc ^ byte) & 255] ^ (crc >>> 8);
  return (crc ^ 0xffffffff) >>> 0;
};

// A ZIP file that holds files as they are (PNG is compressed already): [[name, bytes], ...].
soilbin.zipOf = function (files) {
  const parts = [], directory = [];
  let offset = 0;
  const record = (signature, fields) => {  // fields: [bytes, value], little-endian
    const size = 4 + fields.reduce((sum, [bytes]) => sum + bytes, 0), view = new DataView(new ArrayBuffer(size));
    view.setUint32(0, signature, true);
    let at = 4;
    for (const [bytes, value] of fields) {
      if (bytes === 2) view.setUint16(at, value, true);
      else view.setUint32(at, value, true);
      at += bytes;
    }
    return new Uint8Array(view.buffer);
  };
  for (const [name, bytes] of files) {
    const label = new TextEncoder().encode(name), day = 0x21;  // 1 January 1980
    const same = [[2, 0], [2, 0], [2, 0], [2, day], [4, soilbin.crcOf(bytes)], [4, bytes.length], [4, bytes.length], [2, label.length], [2, 0]];
    const local = record(0x04034b50, [[2, 20], ...same]);
    directory.push(record(0x02014b50, [[2, 20], [2, 20], ...same, [2, 0], [2, 0], [2, 0], [4, 0], [4, offset]]), label);
    parts.push(local, label, bytes);
    offset += local.length + label.length + bytes.length;
  }
  const size = directory.reduce((sum, part) => sum + part.length, 0);
  return new Blob([...parts, ...directory, record(0x06054b50, [[2, 0], [2, 0], [2, files.length], [2, files.length], [4, size], [4, offset], [2, 0]])],
                  {type: 'application/zip'});
};
