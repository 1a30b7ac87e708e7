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
  return {header, radii, vertices, triangles, frames: soilbin.readFrames(raw, at, n, header.frames)};
};
