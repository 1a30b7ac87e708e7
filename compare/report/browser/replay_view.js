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
    host.replaceChildren(this.canvas);
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
    this.colour = list('Colour', [['displacement', 'displacement'], ['speed', 'speed']]);
    this.cut = list('Show', [['whole', 'all'], ['tire', 'without the tire'], ['half', 'cut along the middle']]);
    this.pacing = list('Pace', [['1', 'true'], ['0.25', 'quarter'], ['4', 'four times']]);
    const follow = element('label', {});
    this.follow = element('input', {type: 'checkbox', checked: true});
    follow.append(this.follow, 'camera goes along');
    bar.append(follow);
    this.host.append(bar);
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
    const mode = this.colour.value, unit = mode === 'speed' ? 'm/s' : 'mm';
    this.slider.value = this.at;
    this.time.textContent = `${time.toFixed(2)} s of ${(times[times.length - 1] - times[0]).toFixed(2)} s`;
    this.slider.setAttribute('aria-valuetext', this.time.textContent);
    this.low.textContent = `${mode} 0`;
    this.high.textContent = `${soilbin.formatNumber(this.limits[mode] * (mode === 'speed' ? 1 : 1000))} ${unit} and more`;
    this.scene.look(mode, this.limits[mode], this.cut.value);
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
