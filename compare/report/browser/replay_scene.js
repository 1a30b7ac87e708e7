// The scene of a replay: grains as shaded points of their true size, one vertex a grain; the tire's own surface.
'use strict';

soilbin.ramp = ['#30348a', '#2a7fb0', '#3fb58a', '#d9c94a', '#e8622c'];

soilbin.grainVertex = `
attribute vec3 now, next, first;
attribute float radius;
uniform vec3 origin;
uniform float size, step, share, pixels, limit, cutY;
uniform int mode;
varying float level, seen;
void main() {
  vec3 place = mix(now, next, share);
  vec3 moved = mode == 0 ? place - first : next - now;
  level = clamp(length(moved) * step / limit, 0.0, 1.0);
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
    this.aim();
  }

  addGrains() {
    const {header, radii, frames} = this.replay, geometry = new THREE.BufferGeometry();
    // An attribute a frame: each goes to the graphics memory once, and playing only changes which are bound.
    this.attributes = frames.map(frame => new THREE.BufferAttribute(frame, 3));
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

  // Looks at the wheel from the side and a little above, from a distance that holds it.
  aim() {
    const reach = 3.4 * this.reach(), wheel = new THREE.Vector3(...this.replay.header.wheel[0]);
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

  // mode: 'displacement' [m] or 'speed' [m/s]; limit in its unit. cut: 'whole', 'tire', 'half'.
  look(mode, limit, cut) {
    this.uniforms.mode.value = mode === 'speed' ? 1 : 0;
    this.uniforms.limit.value = mode === 'speed' ? limit * this.interval : limit;
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
    const middle = Math.floor((frames.length - 1) / 2), after = Math.min(middle + 1, frames.length - 1);
    return {displacement: high(last, frames[0]),
            speed: high(frames[after], frames[middle]) / (header.times[after] - header.times[middle] || 1)};
  }
};
