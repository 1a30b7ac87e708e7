// The replay's player: buttons, time, what colours mean, the camera by keys.
'use strict';

soilbin.ReplayView = class {
  constructor(host, replay) {
    this.host = host;
    this.replay = replay;
    this.at = 0;
    this.pace = 1;
    this.canvas = document.createElement('canvas');
    this.canvas.tabIndex = 0;
    this.canvas.setAttribute('role', 'img');
    this.canvas.setAttribute('aria-label', `Tire and ${replay.header.grains} grains in 3D. Arrow keys turn the view, plus and ` +
      'minus change the distance, space plays.');
    const stage = document.createElement('div');
    stage.className = 'stage';
    stage.append(this.canvas);
    host.replaceChildren(stage);
    this.addForces(stage);
    this.scene = new soilbin.ReplayScene(this.canvas, replay);
    this.limits = this.scene.limits();
    this.addBar();
    this.addScale();
    this.addKeys();
    this.scene.controls.addEventListener('change', () => this.refresh());
    new ResizeObserver(() => this.refresh()).observe(this.canvas);
    // The page scrolls by the wheel; with Ctrl the wheel changes the distance.
    this.canvas.addEventListener('wheel', event => { if (!event.ctrlKey && !event.metaKey) event.stopImmediatePropagation(); },
      {capture: true});
    this.go(Math.floor((replay.frames.length - 1) / 2));
  }

  addBar() {
    const bar = document.createElement('div'), element = (tag, set) => Object.assign(document.createElement(tag), set);
    bar.className = 'bar';
    this.button = element('button', {type: 'button', textContent: '\u25b6 Play'});
    this.button.addEventListener('click', () => this.toggle());
    this.slider = element('input', {type: 'range', min: 0, max: this.replay.frames.length - 1, step: 0.01});
    this.slider.setAttribute('aria-label', 'Time');
    this.slider.addEventListener('input', () => this.go(Number(this.slider.value)));
    this.time = element('output', {});
    bar.append(this.button, this.slider, this.time);
    const list = (name, options) => {
      const label = element('label', {textContent: name + ' '}), select = document.createElement('select');
      for (const [value, text] of options) select.add(new Option(text, value));
      select.addEventListener('change', () => this.refresh());
      label.append(select);
      bar.append(label);
      return select;
    };
    this.colour = list('Colour', [['displacement', 'displacement'], ['speed', 'speed'],
                                  ...(this.replay.pressing ? [['force', 'contact force']] : [])]);
    this.cut = list('Show', [['whole', 'all'], ['tire', 'without the tire'], ['half', 'cut along the middle']]);
    this.pacing = list('Pace', [['1', 'true'], ['0.25', 'quarter'], ['4', 'four times']]);
    const follow = element('label', {});
    this.follow = element('input', {type: 'checkbox', checked: true});
    follow.append(this.follow, 'camera goes along');
    const marks = element('label', {});
    this.marks = element('input', {type: 'checkbox', checked: true});
    this.marks.addEventListener('change', () => this.refresh());
    marks.append(this.marks, 'axes and walls');
    this.series = element('button', {type: 'button', textContent: 'Save as PNG series'});
    this.series.addEventListener('click', () => this.saveSeries());
    bar.append(follow, marks, this.series);
    this.host.prepend(bar);  // above the drawing, so that a small screen shows it
  }

  // What the grains do to the wheel, and the torque that drives it against them (positive drives), frame by frame, with a cursor at the present time; a click goes there.
  addForces(stage) {
    const {force, torque, times} = this.replay.header;
    if (!force || typeof d3 === 'undefined') return;
    const host = stage.appendChild(document.createElement('div')), x = times.map(t => t - times[0]);
    const series = (label, color, y) => ({label, x, y, error: [], base: [], mark: 'line', color, dash: 0});
    const axis = title => ({title, lower: null, upper: null}), of = (list, a) => list.map(v => Number(v[a].toPrecision(6)));
    this.sheet = {title: 'Forces of the soil on the wheel, torque that drives it', plots: [
      {title: 'Force on the wheel [N]', x: axis('time [s]'), y: axis(''), identity_line: false,
       series: [series('along travel', 'c0', of(force, 0)), series('to the left', 'c2', of(force, 1)), series('upward', 'c1', of(force, 2))]},
      {title: 'Torque [N m]', x: axis('time [s]'), y: axis(''), identity_line: false,
       series: [series('', 'c3', of(torque, 1).map(v => -v))]}]};
    host.className = 'forces';
    const legend = host.appendChild(document.createElement('ul'));
    legend.className = 'legend';
    for (const {label, color} of this.sheet.plots[0].series) {
      const item = legend.appendChild(document.createElement('li'));
      item.innerHTML = `<svg viewBox="0 0 12 12" width="12" height="12" aria-hidden="true"><circle class="f ${color}" cx="6" cy="6" r="5"/></svg>`;
      item.append(label);
    }
    this.charts = this.sheet.plots.map(plot => new soilbin.Chart(host.appendChild(document.createElement('div')), plot, new Set()));
    for (const chart of this.charts)
      chart.svg.on('click', () => this.go(this.frameAt(times[0] + chart.frame.x.invert(d3.mouse(chart.svg.node())[0]))));
    soilbin.addTakeAlong(host, 'forces-on-the-wheel', this.sheet.title, () => this.sheet);
  }

  // The time of a run as a place among its frames.
  frameAt(time) {
    const {times} = this.replay.header, last = times.length - 1;
    if (time <= times[0]) return 0;
    for (let k = 0; k < last; ++k) if (time < times[k + 1]) return k + (time - times[k]) / (times[k + 1] - times[k]);
    return last;
  }

  // Each frame as the canvas shows it, frame-000.png and on, in one ZIP file.
  async saveSeries() {
    const {frames} = this.replay, at = this.at, files = [];
    this.series.disabled = true;
    for (let k = 0; k < frames.length; ++k) {
      this.go(k);
      this.series.textContent = `Frame ${k + 1} of ${frames.length}`;
      const blob = await new Promise(done => this.canvas.toBlob(done, 'image/png'));
      files.push([`frame-${String(k).padStart(3, '0')}.png`, new Uint8Array(await blob.arrayBuffer())]);
    }
    soilbin.saveFile('replay.zip', soilbin.zipOf(files), 'application/zip');
    this.series.textContent = 'Save as PNG series';
    this.series.disabled = false;
    this.go(at);
  }

  addScale() {
    const scale = document.createElement('div'), bar = document.createElement('i');
    scale.className = 'scale';
    bar.style.background = `linear-gradient(90deg, ${soilbin.ramp.join(', ')})`;
    this.low = document.createElement('span');
    this.high = document.createElement('span');
    scale.append(this.low, bar, this.high);
    this.host.append(scale);
  }

  addKeys() {
    this.canvas.addEventListener('keydown', event => {
      const {camera, controls} = this.scene, offset = camera.position.clone().sub(controls.target);
      const place = new THREE.Spherical().setFromVector3(new THREE.Vector3(offset.x, offset.z, -offset.y));
      const turn = 0.12;
      if (event.key === ' ') this.toggle();
      else if (event.key === 'ArrowLeft') place.theta -= turn;
      else if (event.key === 'ArrowRight') place.theta += turn;
      else if (event.key === 'ArrowUp') place.phi = Math.max(0.1, place.phi - turn);
      else if (event.key === 'ArrowDown') place.phi = Math.min(1.6, place.phi + turn);
      else if (event.key === '+' || event.key === '=') place.radius = Math.max(controls.minDistance, place.radius / 1.15);
      else if (event.key === '-') place.radius = Math.min(controls.maxDistance, place.radius * 1.15);
      else return;
      event.preventDefault();
      const to = new THREE.Vector3().setFromSpherical(place);
      camera.position.copy(controls.target).add(new THREE.Vector3(to.x, -to.z, to.y));
      controls.update();
      this.refresh();
    });
  }

  toggle() {
    this.playing = !this.playing;
    this.button.textContent = this.playing ? '\u23f8 Pause' : '\u25b6 Play';
    if (!this.playing) return;
    if (this.at >= this.replay.frames.length - 1.001) this.at = 0;
    this.before = performance.now();
    this.drawn = {since: this.before, count: 0};
    requestAnimationFrame(now => this.tick(now));
  }

  // Frames are even in travel, not always in time; the pace is that of the run's own clock.
  tick(now) {
    if (!this.playing) return;
    const {times} = this.replay.header, last = times.length - 1, k = Math.min(Math.floor(this.at), last - 1);
    // A frame's time may lie before the click that came within it: then nothing has passed yet.
    const passed = Math.max(0, Math.min(0.2, (now - this.before) / 1000)) * Number(this.pacing.value);
    this.before = now;
    const at = this.at + passed / (times[k + 1] - times[k]);
    this.go(Math.min(at, last));
    this.countFrame(now);
    if (at >= last) this.toggle();
    else requestAnimationFrame(next => this.tick(next));
  }

  // Frames per second while playing, for whoever measures: data-fps.
  countFrame(now) {
    this.drawn.count += 1;
    if (now - this.drawn.since < 1000) return;
    this.host.dataset.fps = (1000 * this.drawn.count / (now - this.drawn.since)).toFixed(1);
    this.drawn = {since: now, count: 0};
  }

  go(at) {
    this.at = at;
    this.scene.set(at, this.follow.checked);
    this.refresh();
  }

  refresh() {
    const {times} = this.replay.header, k = Math.min(Math.floor(this.at), times.length - 1);
    const next = Math.min(k + 1, times.length - 1), time = times[k] + (this.at - k) * (times[next] - times[k]) - times[0];
    const mode = this.colour.value, [unit, per] = {displacement: ['mm', 1000], speed: ['m/s', 1], force: ['N', 1]}[mode];
    this.slider.value = this.at;
    this.time.textContent = `${time.toFixed(2)} s of ${(times[times.length - 1] - times[0]).toFixed(2)} s`;
    this.slider.setAttribute('aria-valuetext', this.time.textContent);
    this.low.textContent = `${mode === 'force' ? 'largest contact force, square-root scale: ' : mode} 0`;
    this.high.textContent = `${soilbin.formatNumber(this.limits[mode] * per)} ${unit} and more`;
    for (const chart of this.charts || []) chart.mark(time);
    this.scene.look(mode, this.limits[mode], this.cut.value, this.marks.checked);
    this.scene.draw();
  }
};

soilbin.startReplay = async function (host) {
  const data = document.getElementById('replay-data'), note = host.querySelector('.replay-note');
  if (!data || typeof THREE === 'undefined') return;
  try {
    if (typeof DecompressionStream === 'undefined') throw new Error('this browser is too old to unpack it (no DecompressionStream)');
    note.textContent = 'Unpacking the replay ...';
    soilbin.replayView = new soilbin.ReplayView(host, await soilbin.readReplay(data.textContent.trim()));
    host.dataset.ready = 'yes';
  } catch (error) {
    note.textContent = `The replay can't be shown: ${error.message}. Everything else on this page stands without it.`;
    host.replaceChildren(note);
  }
};
