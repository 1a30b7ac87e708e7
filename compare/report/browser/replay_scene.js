// The scene of a replay: grains as shaded points of their true size, one vertex a grain; the tire's own surface.
'use strict';

soilbin.ramp = ['#30348a', '#2a7fb0', '#3fb58a', '#d9c94a', '#e8622c'];

soilbin.grainVertex = `
attribute vec3 now, next, first;
attribute float radius, pressed, pressedNext;
uniform vec3 origin;
uniform float size, step, share, pixels, limit, cutY;
uniform int mode;
varying float level, seen;
void main() {
  vec3 place = mix(now, next, share);
  vec3 moved = mode == 0 ? place - first : next - now;
  float share255 = mix(pressed, pressedNext, share);
  level = clamp(mode == 2 ? share255 / limit : length(moved) * step / limit, 0.0, 1.0);
  vec3 metres = origin + step * place;
  seen = metres.y < cutY ? 0.0 : 1.0;
  vec4 eye = viewMatrix * vec4(metres, 1.0);
  gl_Position = seen > 0.5 ? projectionMatrix * eye : vec4(2.0, 2.0, 2.0, 1.0);
  gl_PointSize = radius * size * pixels / -eye.z;
}`;

soilbin.grainFragment = `
uniform vec3 ramp[5];
varying float level, seen;
void main() {
  vec2 p = 2.0 * gl_PointCoord - 1.0;
  float away = dot(p, p);
  if (away > 1.0) discard;
  float facing = sqrt(1.0 - away);
  float light = 0.35 + 0.65 * clamp(dot(vec3(p.x, -p.y, facing), vec3(-0.35, 0.6, 0.72)), 0.0, 1.0);
  float at = 4.0 * level;
  vec3 colour = mix(ramp[0], ramp[1], clamp(at, 0.0, 1.0));
  colour = mix(colour, ramp[2], clamp(at - 1.0, 0.0, 1.0));
  colour = mix(colour, ramp[3], clamp(at - 2.0, 0.0, 1.0));
  colour = mix(colour, ramp[4], clamp(at - 3.0, 0.0, 1.0));
  gl_FragColor = vec4(colour * light, 1.0);
}`;

// Round values between two ends, about `count` of them.
soilbin.evenSteps = function (low, high, count) {
  const rough = (high - low) / count, power = Math.pow(10, Math.floor(Math.log10(rough || 1)));
  const step = [1, 2, 5, 10].map(s => s * power).find(s => s >= 0.999 * rough), values = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; ++k) values.push(Number((k * step).toPrecision(6)));
  return values;
};

soilbin.ReplayScene = class {
  constructor(canvas, replay) {
    this.replay = replay;
    this.canvas = canvas;
    this.renderer = new THREE.WebGLRenderer({canvas, alpha: true, antialias: false, preserveDrawingBuffer: true});
    this.renderer.localClippingEnabled = true;
    this.scene = new THREE.Scene();
    this.camera = new THREE.PerspectiveCamera(38, 1, 0.02, 60);
    this.camera.up.set(0, 0, 1);
    this.scene.add(new THREE.HemisphereLight(0xffffff, 0x606878, 0.75));
    const sun = new THREE.DirectionalLight(0xffffff, 0.6);
    sun.position.set(-1, -2, 3);
    this.scene.add(sun);
    this.addGrains();
    this.addTire();
    this.addBin();
    this.aim();
  }

  addGrains() {
    const {header, radii, frames} = this.replay, geometry = new THREE.BufferGeometry();
    // An attribute a frame: each goes to the graphics memory once, and playing only changes which are bound.
    this.attributes = frames.map(frame => new THREE.BufferAttribute(frame, 3));
    const none = new Uint8Array(this.replay.pressing ? 0 : radii.length);
    this.pressing = frames.map((_, f) => new THREE.BufferAttribute(this.replay.pressing ? this.replay.pressing[f] : none, 1));
    geometry.setAttribute('position', this.attributes[0]);  // three counts vertices by it
    geometry.setAttribute('first', this.attributes[0]);
    geometry.setAttribute('radius', new THREE.BufferAttribute(radii, 1));
    this.uniforms = {
      origin: {value: new THREE.Vector3(...header.origin)}, step: {value: header.step}, share: {value: 0},
      pixels: {value: 1}, size: {value: 2}, limit: {value: 1}, mode: {value: 0}, cutY: {value: -1e9},
      ramp: {value: soilbin.ramp.map(colour => new THREE.Color(colour))},
    };
    this.grains = new THREE.Points(geometry, new THREE.ShaderMaterial({
      uniforms: this.uniforms, vertexShader: soilbin.grainVertex, fragmentShader: soilbin.grainFragment}));
    this.grains.frustumCulled = false;
    this.scene.add(this.grains);
  }

  addTire() {
    const {vertices, triangles} = this.replay, geometry = new THREE.BufferGeometry();
    const corners = new Float32Array(3 * triangles.length);
    triangles.forEach((vertex, i) => corners.set(vertices.subarray(3 * vertex, 3 * vertex + 3), 3 * i));
    geometry.setAttribute('position', new THREE.BufferAttribute(corners, 3));
    geometry.computeVertexNormals();
    this.plane = new THREE.Plane(new THREE.Vector3(0, 1, 0), 1e9);
    this.tire = new THREE.Mesh(geometry, new THREE.MeshLambertMaterial(
      {color: 0x55595f, side: THREE.DoubleSide, clippingPlanes: [this.plane]}));
    this.scene.add(this.tire);
  }

  // The walls as edges, an axis along each side with ticks in metres, and the undisturbed surface. Without walls on file
  // the box is what the grains fill.
  addBin() {
    const {header, frames} = this.replay, axes = [0, 1, 2], first = frames[0];
    const grains = axes.map(a => {
      let [low, high] = [65535, 0];
      for (let i = a; i < first.length; i += 3) { low = Math.min(low, first[i]); high = Math.max(high, first[i]); }
      return [header.origin[a] + header.step * low, header.origin[a] + header.step * high];
    });
    // A domain's top, and a side that nothing bounds, lie far off.
    const near = (value, of) => Math.abs(value - of) < 1 + Math.abs(of) ? value : of;
    const walls = axes.map(a => header.bin ? [near(header.bin.lower[a], grains[a][0]), near(header.bin.upper[a], grains[a][1])] : grains[a]);
    walls[2] = [walls[2][0], Math.max(grains[2][1], header.surface)];
    const [[x0, x1], [y0, y1], [z0, z1]] = this.bin = walls, points = [], line = (...p) => points.push(...p);
    for (const z of [z0, z1]) {
      line(x0, y0, z, x1, y0, z); line(x0, y1, z, x1, y1, z); line(x0, y0, z, x0, y1, z); line(x1, y0, z, x1, y1, z);
    }
    for (const x of [x0, x1]) for (const y of [y0, y1]) line(x, y, z0, x, y, z1);
    this.marks = new THREE.Group();
    this.labels = [];
    const small = 0.03 * Math.max(x1 - x0, y1 - y0), label = (text, x, y, z) => this.labels.push(this.textAt(text, x, y, z, 1.1 * small));
    label('x [m], along travel', (x0 + x1) / 2, y0 - 4 * small, z0);
    label('y [m]', x0 - 4 * small, (y0 + y1) / 2, z0);
    label('z [m]', x0 - 4 * small, y0, (z0 + z1) / 2);
    for (const x of soilbin.evenSteps(x0, x1, 6)) { line(x, y0, z0, x, y0 - small, z0); label(soilbin.formatNumber(x), x, y0 - 2.2 * small, z0); }
    for (const y of soilbin.evenSteps(y0, y1, 3)) { line(x0, y, z0, x0 - small, y, z0); label(soilbin.formatNumber(y), x0 - 2.2 * small, y, z0); }
    for (const z of soilbin.evenSteps(z0, z1, 3)) { line(x0, y0, z, x0 - small, y0, z); label(soilbin.formatNumber(z), x0 - 2.2 * small, y0, z); }
    this.marks.add(...this.labels);
    const lines = new THREE.BufferGeometry();
    lines.setAttribute('position', new THREE.BufferAttribute(Float32Array.from(points), 3));
    this.marks.add(new THREE.LineSegments(lines, new THREE.LineBasicMaterial({color: 0x8a919c})));
    this.scene.add(this.marks);
  }

  // Of labels that would lie over each other from here, the first stays: the axes' names before their ticks.
  thinLabels() {
    this.camera.updateMatrixWorld();
    const [across, , , , , up] = this.camera.projectionMatrix.elements, kept = [];
    for (const label of this.labels) {
      const depth = -label.position.clone().applyMatrix4(this.camera.matrixWorldInverse).z;
      const {x, y} = label.position.clone().project(this.camera);
      const box = {x, y, width: label.scale.x * across / depth, height: label.scale.y * up / depth};
      label.visible = depth > 0 && !kept.some(other => Math.abs(other.x - x) < (other.width + box.width) / 2 &&
        Math.abs(other.y - y) < (other.height + box.height) / 2);
      if (label.visible) kept.push(box);
    }
  }

  // A text that faces the camera, `height` metres high.
  textAt(text, x, y, z, height) {
    const canvas = document.createElement('canvas'), pen = canvas.getContext('2d'), font = '44px system-ui, sans-serif';
    pen.font = font;
    canvas.width = Math.ceil(pen.measureText(text).width) + 8;
    canvas.height = 60;
    pen.font = font;
    pen.fillStyle = '#8a919c';
    pen.textBaseline = 'middle';
    pen.fillText(text, 4, 30);
    const texture = new THREE.CanvasTexture(canvas);
    texture.minFilter = THREE.LinearFilter;
    const sprite = new THREE.Sprite(new THREE.SpriteMaterial({map: texture, transparent: true}));
    sprite.position.set(x, y, z);
    sprite.scale.set(height * canvas.width / canvas.height, height, 1);
    return sprite;
  }

  // Looks at the wheel from the side and a little above, from a distance that holds it.
  aim() {
    const reach = 4.2 * this.reach(), wheel = new THREE.Vector3(...this.replay.header.wheel[0]);
    this.target = wheel.clone();
    this.camera.position.copy(wheel).add(new THREE.Vector3(0.35 * reach, -reach, 0.5 * reach));
    this.controls = new THREE.OrbitControls(this.camera, this.canvas);
    this.controls.enableKeys = false;
    this.controls.target.copy(wheel);
    this.controls.minDistance = 0.4 * this.reach();
    this.controls.maxDistance = 12 * this.reach();
    this.controls.update();
  }
  reach() {
    let most = 0.1;
    for (const x of this.replay.vertices) most = Math.max(most, Math.abs(x));
    return most;
  }

  // Sets the time, in frames: 3.25 is a quarter of the way from frame 3 to frame 4.
  set(at, follow) {
    const {header, frames} = this.replay, k = Math.min(Math.floor(at), Math.max(0, frames.length - 2));
    const next = Math.min(k + 1, frames.length - 1), share = at - k, geometry = this.grains.geometry;
    geometry.setAttribute('now', this.attributes[k]);
    geometry.setAttribute('next', this.attributes[next]);
    geometry.setAttribute('pressed', this.pressing[k]);
    geometry.setAttribute('pressedNext', this.pressing[next]);
    this.uniforms.share.value = share;
    this.interval = header.times[next] - header.times[k] || 1;
    const vector = list => new THREE.Vector3(...list), turn = ([w, x, y, z]) => new THREE.Quaternion(x, y, z, w);
    this.tire.position.copy(vector(header.wheel[k])).lerp(vector(header.wheel[next]), share);
    this.tire.quaternion.copy(turn(header.rotation[k])).slerp(turn(header.rotation[next]), share);
    if (follow) {
      const moved = this.tire.position.clone().sub(this.target);
      moved.z = 0;
      this.camera.position.add(moved);
      this.controls.target.add(moved);
    }
    this.target.copy(this.tire.position);
  }

  // mode: 'displacement' [m], 'speed' [m/s] or 'force' [N]; limit in its unit. cut: 'whole', 'tire', 'half'.
  look(mode, limit, cut, marks) {
    this.uniforms.mode.value = ['displacement', 'speed', 'force'].indexOf(mode);
    this.uniforms.limit.value = mode === 'speed' ? limit * this.interval
      : mode === 'force' ? 255 * Math.sqrt(limit / this.replay.header.pressing) : limit;
    this.marks.visible = marks;
    this.tire.visible = cut !== 'tire';
    const middle = this.replay.header.wheel[0][1];
    this.uniforms.cutY.value = cut === 'half' ? middle : -1e9;
    this.plane.constant = cut === 'half' ? -middle : 1e9;
  }

  draw() {
    const {clientWidth: width, clientHeight: height} = this.canvas, ratio = Math.min(window.devicePixelRatio || 1, 2);
    if (this.width !== width || this.height !== height || this.ratio !== ratio) {
      [this.width, this.height, this.ratio] = [width, height, ratio];
      this.renderer.setPixelRatio(ratio);
      this.renderer.setSize(width, height, false);
      this.camera.aspect = width / height;
      this.camera.updateProjectionMatrix();
      this.uniforms.pixels.value = ratio * height / (2 * Math.tan(this.camera.fov * Math.PI / 360));
    }
    this.thinLabels();
    this.renderer.render(this.scene, this.camera);
  }

  // Largest displacement and speed that a hundredth of the moving grains exceeds.
  limits() {
    const {header, frames} = this.replay, last = frames[frames.length - 1];
    const high = (a, b) => {
      const sizes = [];
      for (let i = 0; i < a.length; i += 3) {
        const d = Math.hypot(a[i] - b[i], a[i + 1] - b[i + 1], a[i + 2] - b[i + 2]);
        if (d > 2) sizes.push(d);
      }
      sizes.sort((x, y) => x - y);
      return (sizes.length ? sizes[Math.floor(0.98 * (sizes.length - 1))] : 1) * header.step;
    };
    const middle = Math.floor((frames.length - 1) / 2), pressing = this.replay.pressing, after = Math.min(middle + 1, frames.length - 1);
    const carried = pressing ? [...pressing[middle]].filter(p => p > 0).sort((a, b) => a - b) : [];
    const share = carried.length ? carried[Math.floor(0.99 * (carried.length - 1))] / 255 : 1;
    return {force: (header.pressing || 1) * share * share, displacement: high(last, frames[0]),
            speed: high(frames[after], frames[middle]) / (header.times[after] - header.times[middle] || 1)};
  }
};
