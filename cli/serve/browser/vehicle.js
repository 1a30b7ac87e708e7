// A drawing of a vehicle from the side on its slope, each wheel as deep as it sinks, what it carries as an arrow. Lengths
// are true to scale; forces have a scale of their own.
'use strict';

// `places`: where axles, centre of gravity and hitch are, and `state`, in SI and radians, as /vehicle and /drive have them: its
// slope, pull and wheels, each with its axle's number, load, slip (null: none), sinkage and, in time, how far it has `spun`;
// in time also how far it has `travelled`. One that does not go stands there faint, on hard ground. `width` [px].
soilbin.drawVehicle = function (places, state, width = 720) {
  const {svgOf, svgPath, formatNumber, formatForce} = soilbin, margin = 16, labels = 64;
  const axles = places.axles, {goes} = state, tread = axle => axle.radius + axle.lug_height, xs = axles.map(axle => axle.x);
  const largest = Math.max(...axles.map(tread)), roof = Math.max(1.3 * places.centre_of_gravity.z, 1.3 * largest);
  const rear = Math.min(...axles.map(a => a.x - tread(a)), places.hitch.x), front = Math.max(...axles.map(a => a.x + tread(a)));
  const middle = (rear + front) / 2, long = front - rear, slope = state.slope, c = Math.cos(slope), s = Math.sin(slope);
  const scale = Math.min((width - 2 * margin - 90) / (long * c + roof * Math.abs(s)), 230 / roof);
  const above = scale * (roof * c + long / 2 * Math.abs(s)), below = scale * long / 2 * Math.abs(s) + labels;
  const height = Math.round(margin + above + below), [cx, cy] = [width / 2, margin + above];
  // Along the ground and up from it, in metres, to the picture.
  const at = (x, z) => [cx + scale * ((x - middle) * c - z * s), cy - scale * ((x - middle) * s + z * c)];
  const svg = svgOf('svg', {class: goes ? 'plot ground vehicle' : 'plot ground vehicle ghost', viewBox: `0 0 ${width} ${height}`, role: 'img', 'font-size': 12});
  const add = (name, set, ...inside) => svg.appendChild(svgOf(name, set, ...inside));
  const arrow = (from, to, colour, thick) => svg.append(...soilbin.svgArrow(...from, ...to, colour, thick));
  const text = ([x, y], what, set = {}) => add('text', {class: 'ink', x: x.toFixed(1), y: y.toFixed(1), 'text-anchor': 'middle', ...set}, what);

  // Of each axle the wheel that is deepest, from the front to the rear.
  const wheels = state.wheels.map(wheel => ({...wheel, ...axles[wheel.axle], driven: axles[wheel.axle].driven}));
  const deepest = axles.map((axle, i) => wheels.filter(w => w.axle === i).reduce((a, b) => b.sinkage > a.sinkage ? b : a));
  const rows = [...deepest].sort((a, b) => b.x - a.x);
  // The ground: level before the front wheel, then along each wheel, and between two as deep as the shallower one leaves it.
  const far = 2 * long + width / scale, surface = [[front + far, 0]];
  let level = 0;
  rows.forEach((wheel, i) => {
    const after = -Math.min(wheel.sinkage, i + 1 < rows.length ? rows[i + 1].sinkage : wheel.sinkage), r = tread(wheel);
    const hub = r - wheel.sinkage, reach = z => Math.acos(Math.max(-1, Math.min(1, (hub - z) / r)));
    const [enters, leaves] = [reach(level), wheel.sinkage > 0 ? reach(after) : 0];
    for (let k = 0; k <= 16; ++k) {
      const angle = enters - k / 16 * (enters + leaves);
      surface.push([wheel.x + r * Math.sin(angle), hub - r * Math.cos(angle)]);
    }
    level = after;
  });
  surface.push([rear - far, level]);
  const ground = surface.map(p => at(...p));
  add('path', {class: 'soil', d: svgPath([...ground, at(rear - far, -far), at(front + far, -far)]) + 'Z'});
  add('path', {class: 'quiet-line', fill: 'none', d: svgPath(ground)});
  add('path', {class: 'quiet-line', fill: 'none', 'stroke-dasharray': '3 3', d: svgPath([at(front, 0), at(rear - far, 0)])});
  if (state.travelled !== undefined) {
    const step = soilbin.roundAbove(long / 4), from = state.travelled - middle;
    for (let k = Math.ceil((from + rear - long) / step); k * step <= from + front + long; ++k) {
      const x = k * step - from, depth = 26 / scale;
      add('path', {class: 'quiet-line', d: svgPath([at(x, -0.6 * depth), at(x, -depth)])});
      const place = at(x, -1.6 * depth), free = rows.every(wheel => Math.abs(wheel.x - x) * scale > 75);
      if (free && place[0] > 24 && place[0] < width - 24) text(place, `${formatNumber(k * step)} m`, {class: 'quiet'});
    }
  }

  // The body, through the wheels' hubs as they sink: by least squares.
  const mean = list => list.reduce((a, b) => a + b, 0) / list.length, x0 = mean(xs), z0 = mean(deepest.map(w => w.sinkage));
  const spread = xs.reduce((sum, x) => sum + (x - x0) ** 2, 0);
  const tilt = spread > 0 ? deepest.reduce((sum, w) => sum + (w.x - x0) * w.sinkage, 0) / spread : 0;
  const body = (x, z) => at(x, z - z0 - tilt * (x - x0));
  const [stern, bow] = [Math.min(...xs) - 0.55 * largest, Math.max(...xs) + 0.75 * largest], belly = 0.95 * largest, corner = 0.3 * (roof - belly);
  add('path', {class: 'body', d: svgPath([body(stern, belly), body(stern, roof - corner / 2), body(stern + corner / 2, roof),
    body(bow - 1.6 * corner, roof), body(bow - corner / 2, roof - corner), body(bow, roof - 1.6 * corner), body(bow, belly)]) + 'Z'});
  for (const wheel of wheels) {
    const hub = [wheel.x, tread(wheel) - wheel.sinkage], spokes = 5, lugs = wheel.lug_height > 0 ? wheel.lug_count || 24 : 0;
    const out = (angle, radius) => at(hub[0] + radius * Math.sin(angle), hub[1] + radius * Math.cos(angle));
    const seen = wheel === wheels.filter(w => w.axle === wheel.axle).at(-1);  // the one before hides behind it
    add('circle', {class: seen ? 'rim' : 'rim far', cx: at(...hub)[0].toFixed(1), cy: at(...hub)[1].toFixed(1), r: (scale * wheel.radius).toFixed(1)});
    if (!seen) continue;
    for (let k = 0; k < lugs; ++k) {
      const angle = (wheel.spun || 0) + 2 * Math.PI * k / lugs;
      add('path', {class: 'quiet-line', 'stroke-width': 3, d: svgPath([out(angle, wheel.radius), out(angle, tread(wheel))])});
    }
    for (let k = 0; k < spokes; ++k) {
      const angle = (wheel.spun || 0) + 2 * Math.PI * k / spokes;
      add('path', {class: 'quiet-line', d: svgPath([out(angle, 0.25 * wheel.radius), out(angle, 0.6 * wheel.radius)])});
    }
    const [x, y] = at(...hub);
    add('circle', {class: wheel.driven ? 'hub driven' : 'hub', cx: x.toFixed(1), cy: y.toFixed(1), r: Math.max(3, 0.12 * scale * wheel.radius).toFixed(1)});
  }

  // Forces: the length of a wheel's even share of the weight.
  const count = axles.reduce((sum, axle) => sum + axle.wheels, 0), newton = 0.85 * largest * count / places.weight, most = 2.4 * largest;
  const close = Math.min(...rows.slice(1).map((wheel, i) => scale * (rows[i].x - wheel.x)), width);
  const told = rows.filter((wheel, i) => close > 84 || i === 0 || i === rows.length - 1);
  for (const wheel of rows) {
    const pair = wheels.filter(w => w.axle === wheel.axle), seen = pair.at(-1), hub = tread(seen) - seen.sinkage;
    if (goes) arrow(at(seen.x, hub), at(seen.x, hub - Math.min(most, newton * seen.load)), 'c0', 2.4);
    if (!told.includes(wheel) || !goes) continue;
    const foot = at(wheel.x, -wheel.sinkage), alike = pair.every(w => Math.abs(w.load - seen.load) < 1e-3 * places.weight);
    const line = (k, what, set) => text([foot[0], Math.min(height - 34, foot[1]) + 18 + 14 * k], what, set);
    line(0, alike ? formatForce(seen.load) : pair.map(w => formatForce(w.load)).join(' | '), {'font-weight': 600});
    line(1, (seen.slip === null ? '' : `${formatNumber(100 * seen.slip)} %, `) + `${formatNumber(1000 * wheel.sinkage)} mm`);
  }
  const centre = body(places.centre_of_gravity.x, places.centre_of_gravity.z), down = Math.min(most, newton * places.weight / 2) * scale;
  arrow(centre, [centre[0], centre[1] + down], 'c5', 2.4);
  add('circle', {class: 'centre', cx: centre[0].toFixed(1), cy: centre[1].toFixed(1), r: 5});
  text([centre[0] + 8, centre[1] - 6], `W = ${formatForce(places.weight)}`, {'text-anchor': 'start'});
  if (Math.abs(state.pull) > 1e-6 * places.weight) {
    const {x, z, angle} = places.hitch, pulled = Math.sign(state.pull) * Math.min(most, 3 * newton * Math.abs(state.pull) / count);
    const [from, to] = [body(x, z), body(x - pulled * Math.cos(angle), z - pulled * Math.sin(angle))];
    arrow(from, to, 'c2', 2.4);
    text([Math.max(46, (from[0] + to[0]) / 2), Math.min(from[1], to[1]) - 8], `F = ${formatForce(state.pull)}`);
  }
  const degrees = `${formatNumber(Math.abs(slope) * 180 / Math.PI)}\u00b0`;
  text([8, 18], slope === 0 ? 'level' : `${degrees} ${slope > 0 ? 'up' : 'down'}`, {'text-anchor': 'start', 'font-weight': 600});
  svg.setAttribute('aria-label', `Vehicle from the side, ${slope === 0 ? 'level' : `${degrees} ${slope > 0 ? 'up' : 'down'}`}: ` +
    (goes ? rows.map(w => `${w.name} ${formatForce(w.load)}, sinkage ${formatNumber(1000 * w.sinkage)} mm`).join('; ') : 'it does not travel'));
  return svg;
};

// A drive in time, played: `drive` as /drive answers it. `show(state, sample)` draws what it is at a time; `ended()` is told
// that it has come to its end.
soilbin.DrivePlayer = class {
  constructor(drive, show, ended) {
    Object.assign(this, {drive, show, ended, pace: 1, playing: false});
    const {samples, axles, places} = drive, times = samples.time_s;
    this.last = times.at(-1);
    this.spun = axles.map(({axle, rim_speed_m_s}) => {
      const radius = places.axles.find(a => a.name === axle).radius, angles = [0];
      for (let i = 1; i < times.length; ++i)
        angles.push(angles[i - 1] + (rim_speed_m_s[i] + rim_speed_m_s[i - 1]) / 2 * (times[i] - times[i - 1]) / radius);
      return angles;
    });
    this.to(0);
  }

  // Shows it at a time [s].
  to(time) {
    this.time = Math.max(0, Math.min(this.last, time));
    const {samples, axles} = this.drive, times = samples.time_s;
    let i = 0;
    while (i + 2 < times.length && times[i + 1] <= this.time) ++i;
    const next = Math.min(i + 1, times.length - 1), gap = times[next] - times[i], share = gap > 0 ? (this.time - times[i]) / gap : 0;
    const between = list => list[i] === null || list[next] === null ? list[i] : list[i] + share * (list[next] - list[i]);
    const wheels = axles.map((axle, k) => ({axle: k, name: axle.axle, load: between(axle.normal_load_N), slip: between(axle.slip),
                                            sinkage: between(axle.sinkage_m), spun: between(this.spun[k])}));
    this.show({goes: true, slope: between(samples.slope_deg) * Math.PI / 180, pull: between(samples.pull_N), travelled: between(samples.travelled_m), wheels},
              {time: this.time, travelled: between(samples.travelled_m), speed: between(samples.speed_m_s), slip: between(samples.slip)});
  }

  play() {
    if (this.playing) return;
    if (this.time >= this.last) this.to(0);
    this.playing = true;
    let before = null;
    const step = now => {
      if (!this.playing) return;
      if (before !== null) this.to(this.time + this.pace * (now - before) / 1000);
      before = now;
      if (this.time < this.last) return void requestAnimationFrame(step);
      this.pause();
      this.ended();
    };
    requestAnimationFrame(step);
  }

  pause() { this.playing = false; }
};
