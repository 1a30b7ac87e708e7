// What drawings are made of: elements of SVG, paths, arrows.
'use strict';

soilbin.svgOf = function (name, set, ...inside) {
  const element = document.createElementNS('http://www.w3.org/2000/svg', name);
  for (const [key, value] of Object.entries(set)) element.setAttribute(key, value);
  element.append(...inside);
  return element;
};

// 1, 2 or 5 times a power of ten, the next above x.
soilbin.roundAbove = function (x) {
  const power = Math.pow(10, Math.floor(Math.log10(x)));
  return [1, 2, 5, 10].map(step => step * power).find(step => step >= 0.9999 * x);
};

// A path through points [x, y].
soilbin.svgPath = points => 'M' + points.map(p => p.map(c => c.toFixed(1)).join(' ')).join('L');

// An arrow, a line and its head; nothing where it is too short to be seen.
soilbin.svgArrow = function (x1, y1, x2, y2, colour, thick = 1.4) {
  const {svgOf} = soilbin, length = Math.hypot(x2 - x1, y2 - y1);
  if (length < 2) return [];
  const [ux, uy] = [(x2 - x1) / length, (y2 - y1) / length], head = Math.min(7, length);
  const [bx, by] = [x2 - head * ux, y2 - head * uy];
  return [svgOf('line', {class: `s ${colour}`, 'stroke-width': thick, x1: x1.toFixed(1), y1: y1.toFixed(1), x2: bx.toFixed(1), y2: by.toFixed(1)}),
          svgOf('path', {class: `f ${colour}`, d: soilbin.svgPath([[x2, y2], [bx - 0.45 * head * uy, by + 0.45 * head * ux],
                                                                  [bx + 0.45 * head * uy, by - 0.45 * head * ux]]) + 'Z'})];
};
