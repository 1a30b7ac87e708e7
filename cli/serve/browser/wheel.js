// A drawing of the wheel in the ground: where soil meets it and lets go, the normal stress outside its rim, the shear
// stress inside, the load and the pull on its axle. Lengths are true to scale; stresses have a scale of their own.
'use strict';

// `wheel`: an element of `wheels` of /estimate; sizes in SI, angles in radians from the vertical, ahead positive.
soilbin.drawWheel = function (wheel) {
  const {svgOf, formatNumber, formatForce} = soilbin, width = 460, height = 420, r = wheel.radius, tread = r + wheel.lug_height;
  const middle = 0.4 * width, axle = 172, pixels = 146 / tread, tilt = -wheel.incline * 180 / Math.PI;
  // A tire that gives way is flat where its circle would reach below: there the radius ends at the chord.
  const chord = r - (wheel.deflection || 0);
  const flat = (theta, radius) => radius * Math.min(1, chord / (r * Math.max(Math.cos(theta), 1e-9)));
  const at = (theta, radius) => {
    const lower = Math.cos(theta) > 0 ? flat(theta, r) - r : 0;
    return [pixels * (radius + lower) * Math.sin(theta), pixels * (radius + lower) * Math.cos(theta)];
  };
  const path = soilbin.svgPath;
  const most = Math.max(...wheel.normal, 1e-9), top = soilbin.roundAbove(most), long = 0.5 * tread / top;
  const arc = wheel.theta.map(theta => at(theta, r)), far = 2.5 * width;
  const behind = arc.length ? arc[0][1] : pixels * r, ahead = arc.length ? arc[arc.length - 1][1] : pixels * r;
  const turned = svgOf('g', {transform: `translate(${middle} ${axle}) rotate(${tilt.toFixed(2)})`});
  const add = (name, set, ...inside) => turned.appendChild(svgOf(name, set, ...inside));
  const arrow = (...all) => turned.append(...soilbin.svgArrow(...all));
  const text = (x, y, what, set = {}) => add('text', {class: 'ink', x: x.toFixed(1), y: y.toFixed(1), ...set}, what);

  add('path', {class: 'soil', d: path([[-far, behind], ...arc, [far, ahead], [far, far], [-far, far]]) + 'Z'});
  add('path', {class: 'quiet-line', fill: 'none', d: path([[-far, behind], ...arc, [far, ahead]])});
  add('line', {class: 'quiet-line', 'stroke-dasharray': '3 3', x1: -far, x2: arc.length ? arc[arc.length - 1][0].toFixed(1) : 0,
               y1: ahead.toFixed(1), y2: ahead.toFixed(1)});
  for (let k = 0, count = wheel.lug_count || 24; wheel.lug_height > 0 && k < count; ++k) {
    const [[x1, y1], [x2, y2]] = [at(2 * Math.PI * k / count, r), at(2 * Math.PI * k / count, tread)];
    add('line', {class: 'quiet-line', 'stroke-width': 3, x1: x1.toFixed(1), y1: y1.toFixed(1), x2: x2.toFixed(1), y2: y2.toFixed(1)});
  }
  const outline = Array.from({length: 181}, (_, i) => at(i * Math.PI / 90, r));
  add('path', {class: 'rim', d: path(outline) + 'Z'});
  add('circle', {class: 'f c5', r: 3});
  const outer = wheel.theta.map((theta, i) => at(theta, r + long * wheel.normal[i]));
  const inner = wheel.theta.map((theta, i) => at(theta, r - long * wheel.shear[i]));
  if (arc.length) {
    add('path', {class: 'f c0 stress', d: path([...arc, ...outer.slice().reverse()]) + 'Z'});
    add('path', {class: 'f c1 stress', d: path([...arc, ...inner.slice().reverse()]) + 'Z'});
    add('path', {class: 's c0', fill: 'none', 'stroke-width': 1.6, d: path(outer)});
    add('path', {class: 's c1', fill: 'none', 'stroke-width': 1.6, d: path(inner)});
    for (let k = 1; k < 8; ++k) {
      const place = wheel.theta[0] + k / 8 * (wheel.theta[arc.length - 1] - wheel.theta[0]);
      const i = wheel.theta.findIndex(theta => theta >= place), theta = wheel.theta[i], shear = pixels * long * wheel.shear[i];
      arrow(...outer[i], ...arc[i], 'c0', 1);
      arrow(...arc[i], arc[i][0] + shear * Math.cos(theta), arc[i][1] - shear * Math.sin(theta), 'c1');
    }
    const degrees = theta => `${Math.round(theta * 180 / Math.PI)}\u00b0`;  // no "-0"
    for (const [theta, end, name] of [[wheel.entry, arc[arc.length - 1], '\u03b8\u2081 '], [wheel.exit, arc[0], '\u03b8\u2082 ']]) {
      add('line', {class: 'quiet-line', 'stroke-dasharray': '2 3', x1: 0, y1: 0, x2: end[0].toFixed(1), y2: end[1].toFixed(1)});
      text(0.55 * end[0] + (theta > 0.05 ? 6 : -6), 0.55 * end[1], name + degrees(theta),
           {class: 'quiet', 'text-anchor': theta > 0.05 ? 'start' : 'end'});
    }
  }
  const bottom = ahead + pixels * wheel.sinkage, right = pixels * tread + 26;
  for (const y of [ahead, bottom]) add('line', {class: 'quiet-line', x1: right - 6, x2: right + 6, y1: y.toFixed(1), y2: y.toFixed(1)});
  add('line', {class: 'quiet-line', x1: right, x2: right, y1: ahead.toFixed(1), y2: bottom.toFixed(1)});
  text(right + 10, (ahead + bottom) / 2 + 4, `z = ${formatNumber(1000 * wheel.sinkage)} mm`);
  const unit = 0.62 * pixels * r / wheel.load, pull = Math.max(-2, Math.min(2.4, wheel.drawbar_pull * unit / (pixels * r))) * pixels * r;
  const down = -tilt * Math.PI / 180;  // the load hangs down, however the ground lies
  arrow(0, 0, -Math.sin(down) * unit * wheel.load, Math.cos(down) * unit * wheel.load, 'c5', 2.4);
  text(-8 - Math.sin(down) * unit * wheel.load, 0.5 * unit * wheel.load, `W = ${formatForce(wheel.load)}`, {'text-anchor': 'end'});
  arrow(0, 0, pull, 0, 'c2', 2.4);
  text(Math.max(pull, 0) + 6, -8, `F = ${formatForce(wheel.drawbar_pull)}`);
  const turn = Math.sign(wheel.torque), [from, to] = [at(Math.PI - 0.5, 0.72 * r), at(Math.PI + 0.5, 0.72 * r)];
  const [first, last] = turn < 0 ? [from, to] : [to, from];
  add('path', {class: 's c3', fill: 'none', 'stroke-width': 2, d: `M${first.map(c => c.toFixed(1)).join(' ')}A${(0.72 * pixels * r).toFixed(1)} ` +
    `${(0.72 * pixels * r).toFixed(1)} 0 0 ${turn < 0 ? 0 : 1} ${last.map(c => c.toFixed(1)).join(' ')}`});
  arrow(last[0] - 8 * turn * 0.9, last[1] - 4, last[0] + 2 * turn, last[1] + 2, 'c3', 2);
  text(0, -0.72 * pixels * r - 8, `M = ${formatNumber(wheel.torque)} N m`, {'text-anchor': 'middle'});

  const spoken = `Wheel in the ground: sinkage ${formatNumber(1000 * wheel.sinkage)} mm, normal stress up to ` +
    `${formatNumber(most / 1000)} kPa, shear stress up to ${formatNumber(Math.max(...wheel.shear, 0) / 1000)} kPa`;
  const bar = pixels * long * top;
  return svgOf('svg', {class: 'plot ground', viewBox: `0 0 ${width} ${height}`, role: 'img', 'aria-label': spoken, 'font-size': 12}, turned,
    ...(wheel.label ? [svgOf('text', {class: 'ink', x: 4, y: 16, 'font-weight': 600}, wheel.label)] : []),
    svgOf('rect', {class: 'paper', 'fill-opacity': 0.75, x: 4, y: height - 40, width: 340, height: 36, rx: 4}),
    svgOf('rect', {class: 'f c0 stress', x: 10, y: height - 34, width: bar.toFixed(1), height: 8}),
    svgOf('text', {class: 'ink', x: (bar + 16).toFixed(1), y: height - 26}, `normal stress, ${formatNumber(top / 1000)} kPa to this length`),
    svgOf('rect', {class: 'f c1 stress', x: 10, y: height - 18, width: bar.toFixed(1), height: 8}),
    svgOf('text', {class: 'ink', x: (bar + 16).toFixed(1), y: height - 10}, 'shear stress, the same scale'));
};
