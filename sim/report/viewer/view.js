// SPDX-License-Identifier: BSD-3-Clause
// The machine in three dimensions: mm, Z up. Drawn when something has changed.
'use strict';

const LIT = ['#ff4d4f', '#ffc53d'];
const CREASE = Math.cos(35 * Math.PI / 180);

/** Flat where faces meet sharply, smooth elsewhere; and the sharp edges. */
function creasedGeometry(x, y, z, triangles) {
  const count = triangles.length / 3, vertices = x.length;
  const face = new Float32Array(3 * count), unit = new Float32Array(3 * count);
  const first = new Int32Array(vertices + 1);
  for (let t = 0; t < count; ++t) {
    const [a, b, c] = [triangles[3 * t], triangles[3 * t + 1], triangles[3 * t + 2]];
    const ux = x[b] - x[a], uy = y[b] - y[a], uz = z[b] - z[a];
    const vx = x[c] - x[a], vy = y[c] - y[a], vz = z[c] - z[a];
    const n = [uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx];
    const length = Math.hypot(...n) || 1;
    for (let k = 0; k < 3; ++k) {
      face[3 * t + k] = n[k];
      unit[3 * t + k] = n[k] / length;
      ++first[triangles[3 * t + k] + 1];
    }
  }
  for (let v = 0; v < vertices; ++v) first[v + 1] += first[v];
  const around = new Int32Array(3 * count), filled = first.slice();
  for (let i = 0; i < 3 * count; ++i) around[filled[triangles[i]]++] = Math.floor(i / 3);
  const positions = new Float32Array(9 * count), normals = new Float32Array(9 * count);
  const edges = [];
  const along = (s, t) => unit[3 * s] * unit[3 * t] + unit[3 * s + 1] * unit[3 * t + 1] + unit[3 * s + 2] * unit[3 * t + 2];
  for (let i = 0; i < 3 * count; ++i) {
    const v = triangles[i], t = Math.floor(i / 3);
    positions.set([x[v], y[v], z[v]], 3 * i);
    let nx = face[3 * t], ny = face[3 * t + 1], nz = face[3 * t + 2];
    if (first[v + 1] - first[v] <= 400) {
      for (let k = first[v]; k < first[v + 1]; ++k) {
        const s = around[k];
        if (s === t || along(s, t) < CREASE) continue;
        nx += face[3 * s]; ny += face[3 * s + 1]; nz += face[3 * s + 2];
      }
    }
    const length = Math.hypot(nx, ny, nz) || 1;
    normals.set([nx / length, ny / length, nz / length], 3 * i);
    const w = triangles[i % 3 === 2 ? i - 2 : i + 1];
    if (v > w) continue;  // The neighbour's turn.
    let sharp = true;
    for (let k = first[v]; k < first[v + 1] && sharp; ++k) {
      const s = around[k];
      if (s === t) continue;
      const shares = triangles[3 * s] === w || triangles[3 * s + 1] === w || triangles[3 * s + 2] === w;
      if (shares && along(s, t) >= CREASE) sharp = false;
    }
    if (sharp) edges.push(x[v], y[v], z[v], x[w], y[w], z[w]);
  }
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute('position', new THREE.BufferAttribute(positions, 3));
  geometry.setAttribute('normal', new THREE.BufferAttribute(normals, 3));
  const lines = new THREE.BufferGeometry();
  lines.setAttribute('position', new THREE.BufferAttribute(new Float32Array(edges), 3));
  return {geometry, lines};
}

/** Is there no graphics hardware? Then edges are not smoothed: that costs most. */
function inSoftware() {
  const gl = document.createElement('canvas').getContext('webgl');
  const info = gl && gl.getExtension('WEBGL_debug_renderer_info');
  return Boolean(info) && /swiftshader|llvmpipe|software/i.test(gl.getParameter(info.UNMASKED_RENDERER_WEBGL));
}

/** A ring with a dot, for the place of a contact. */
function markerTexture() {
  const canvas = document.createElement('canvas');
  canvas.width = canvas.height = 128;
  const pen = canvas.getContext('2d');
  for (const [width, color] of [[16, '#ffffff'], [9, '#d11a2a']]) {
    pen.lineWidth = width;
    pen.strokeStyle = pen.fillStyle = color;
    pen.beginPath(); pen.arc(64, 64, 48, 0, 7); pen.stroke();
    pen.beginPath(); pen.arc(64, 64, width * 0.7, 0, 7); pen.fill();
  }
  return new THREE.CanvasTexture(canvas);
}

class View {
  constructor(canvas, {scene, column}, run) {
    this.canvas = canvas;
    this.run = run;
    this.machine = scene.machine;
    this.renderer = new THREE.WebGLRenderer({canvas, antialias: !inSoftware(), preserveDrawingBuffer: true});
    this.world = new THREE.Scene();
    this.camera = new THREE.PerspectiveCamera(35, 1, 5, 40000);
    this.camera.up.set(0, 0, 1);
    this.target = new THREE.Vector3();
    this.turn = {azimuth: -0.9, height: 0.45, distance: 3000};
    this.sky = new THREE.HemisphereLight(0xffffff, 0x8a8f98, 0.75);
    this.lamp = new THREE.DirectionalLight(0xffffff, 0.5);
    this.world.add(this.sky, this.lamp, this.lamp.target);
    this.tools = new Map(scene.tools.map((tool) => [tool.number, tool]));
    this.xray = true;
    this.lit = [];
    this.hidden = new Set();
    this.pose = new Float64Array(run.values.length);
    this.tool = 0;
    this.addLinks();
    this.addBodies(scene.bodies, scene.units, column);
    this.addMarkers();
    this.spindle = new Chain(this.machine.links, this.machine.spindle);
    this.setPose(run.poseAt(0), run.tool.length ? run.tool[0] : 0);
    this.hideEnclosures();
    this.plane = new THREE.Plane(new THREE.Vector3(0, -1, 0), 0);
    this.listen();
    this.changed = true;
  }

  addLinks() {
    this.links = this.machine.links.map((link) => {
      const group = new THREE.Group();
      if (link.place) {
        group.position.set(...link.place);
        group.quaternion.set(...link.rotation);
      }
      return group;
    });
    this.machine.links.forEach((link, i) => (link.parent < 0 ? this.world : this.links[link.parent]).add(this.links[i]));
    this.rest = this.links.map((group) => ({p: group.position.clone(), q: group.quaternion.clone()}));
  }

  addBodies(bodies, units, column) {
    this.bodies = bodies.map((body) => {
      const [x, y, z] = body.vertices.map((c) => column(c, units.vertices_per_mm));
      const {geometry, lines} = creasedGeometry(x, y, z, column(body.triangles));
      const color = new THREE.Color(...body.color.slice(0, 3));
      const opacity = body.color[3];
      const material = new THREE.MeshLambertMaterial({color, side: THREE.DoubleSide,
        transparent: opacity < 1, opacity, depthWrite: opacity === 1});
      const mesh = new THREE.Mesh(geometry, material);
      const edge = new THREE.LineSegments(lines, new THREE.LineBasicMaterial({color: 0x1a1f27, transparent: true, opacity: 0.4}));
      const group = new THREE.Group();
      group.add(mesh, edge);
      this.links[body.link].add(group);
      const link = this.machine.links[body.link].name;
      // A visual shape stands for all of its link.
      const key = body.kind === 'machine' ? link : body.name;
      return {...body, key, link, group, mesh, edge, material, color, opacity};
    });
  }

  addMarkers() {
    const map = markerTexture();
    this.markers = [0, 1].map(() => {
      const material = new THREE.SpriteMaterial({map, depthTest: false, sizeAttenuation: false, transparent: true});
      const marker = new THREE.Sprite(material);
      marker.scale.set(0.035, 0.035, 1);
      marker.renderOrder = 10;
      marker.visible = false;
      this.world.add(marker);
      return marker;
    });
  }

  /** What stands around table and spindle on all sides would hide them. */
  hideEnclosures() {
    const inside = [this.tip(), this.links[this.machine.table].getWorldPosition(new THREE.Vector3())];
    for (const key of new Set(this.bodies.filter((b) => b.kind === 'machine').map((b) => b.key))) {
      const box = new THREE.Box3();
      for (const body of this.bodies) if (body.key === key) box.expandByObject(body.group);
      if (inside.every((p) => box.containsPoint(p))) this.hidden.add(key);
    }
  }

  /** Joint values, mm and degrees. */
  setPose(pose, tool) {
    this.pose.set(pose);
    this.tool = tool;
    const axis = new THREE.Vector3(), turned = new THREE.Quaternion();
    this.machine.links.forEach((link, i) => {
      if (link.joint < 0) return;
      axis.set(...link.axis);
      if (link.turns) {
        turned.setFromAxisAngle(axis, pose[link.joint] * Math.PI / 180);
        this.links[i].quaternion.copy(this.rest[i].q).multiply(turned);
      } else {
        axis.applyQuaternion(this.rest[i].q).multiplyScalar(pose[link.joint]);
        this.links[i].position.copy(this.rest[i].p).add(axis);
      }
    });
    this.world.updateMatrixWorld(true);
    if (this.following) this.target.copy(this.tip());
    this.changed = true;
  }

  tip() {
    const tool = this.tools.get(this.tool);
    return this.links[this.machine.spindle].localToWorld(new THREE.Vector3(0, 0, tool ? tool.length : 0));
  }

  matches(body, name) { return body.name === name || (body.kind === 'machine' && body.key === name.split('/')[0]); }

  /** Lights two bodies by name; `points` of a contact in the machine frame. */
  light(names, points) {
    this.lit = names;
    this.markers.forEach((marker, i) => {
      marker.visible = i < Math.min(points.length, 1);
      if (marker.visible) marker.position.set(...points[i]);
    });
    this.changed = true;
  }

  dress() {
    const ghost = this.xray && this.lit.length > 0;
    for (const body of this.bodies) {
      const which = this.lit.findIndex((name) => this.matches(body, name));
      body.group.visible = (!this.hidden.has(body.key) || which >= 0) && (body.tool === 0 || body.tool === this.tool);
      const faint = ghost && which < 0 && body.kind !== 'part' && body.tool === 0;
      const {material, edge} = body;
      material.color.copy(which >= 0 ? new THREE.Color(LIT[which]) : body.color);
      material.emissive.set(which >= 0 ? LIT[which] : '#000000');
      material.emissiveIntensity = which >= 0 ? 0.12 : 0;
      material.opacity = faint ? Math.min(0.1, body.opacity) : which >= 0 ? 1 : body.opacity;
      const solid = material.opacity === 1;
      if (material.transparent === solid) material.needsUpdate = true;
      material.transparent = !solid;
      material.depthWrite = solid;
      edge.material.opacity = faint ? 0.18 : 0.45;
      edge.material.color.set(this.edgeColor);
    }
  }

  theme(style) {
    const color = (name) => style.getPropertyValue(name).trim();
    this.edgeColor = color('--edge');
    const canvas = document.createElement('canvas');
    canvas.width = 2; canvas.height = 256;
    const pen = canvas.getContext('2d');
    const fall = pen.createLinearGradient(0, 0, 0, 256);
    fall.addColorStop(0, color('--sky'));
    fall.addColorStop(1, color('--ground'));
    pen.fillStyle = fall;
    pen.fillRect(0, 0, 2, 256);
    this.world.background = new THREE.CanvasTexture(canvas);
    this.changed = true;
  }

  direction() {
    const {azimuth, height} = this.turn;
    return new THREE.Vector3(Math.cos(height) * Math.sin(azimuth + Math.PI), Math.cos(height) * -Math.cos(azimuth), Math.sin(height));
  }

  look(azimuth, height) { Object.assign(this.turn, {azimuth, height}); this.changed = true; }

  lookAt(point, distance) {
    this.target.copy(point);
    this.resize();
    // On a narrow page as much is to be seen.
    this.turn.distance = distance * Math.max(1, 1.1 / this.camera.aspect);
    this.changed = true;
  }

  box(filter) {
    const box = new THREE.Box3();
    for (const body of this.bodies) if (filter(body)) box.expandByObject(body.group);
    return box;
  }

  /** Where bodies are of which no point is told: at the tip, where one is of the tool; else where the smallest is. */
  middleOf(names) {
    const told = this.bodies.filter((body) => names.some((name) => this.matches(body, name)));
    if (!told.length || told.some((body) => body.tool > 0)) return {point: this.tip(), size: 0};
    const boxes = told.map((body) => new THREE.Box3().setFromObject(body.group));
    const size = (box) => box.getSize(new THREE.Vector3()).length();
    boxes.sort((a, b) => size(a) - size(b));
    return {point: boxes[0].getCenter(new THREE.Vector3()), size: size(boxes[0])};
  }

  fit() {
    const box = this.box((body) => !this.hidden.has(body.key) && (body.tool === 0 || body.tool === this.tool));
    this.lookAt(box.getCenter(new THREE.Vector3()), box.getSize(new THREE.Vector3()).length() * 1.45);
  }

  near(point = this.tip(), distance = 620) {
    this.lookAt(point, distance);
    this.clearSight(point);
  }

  /** Turns to where nothing that is not see-through stands before the point; from the front if it can be. */
  clearSight(point) {
    this.dress();
    this.resize();
    const solids = this.bodies.filter((b) => b.group.visible && b.material.opacity > 0.5 && !this.lit.some((n) => this.matches(b, n)));
    const ray = new THREE.Raycaster();
    let best = null;
    for (const height of [0.4, 0.75, 0.12]) {
      for (const azimuth of [-0.6, 0.6, -1.1, 1.1, 0, -1.7, 1.7, -2.4, 2.4, 3.1]) {
        Object.assign(this.turn, {azimuth, height});
        const towards = this.direction();
        ray.set(point.clone().addScaledVector(towards, this.turn.distance), towards.clone().negate());
        ray.far = this.turn.distance - 1;
        const blocked = ray.intersectObjects(solids.map((b) => b.mesh)).length;
        if (best === null || blocked < best.blocked) best = {blocked, azimuth, height};
        if (blocked === 0) break;
      }
      if (best.blocked === 0) break;
    }
    this.look(best.azimuth, best.height);
  }

  cut(axis, part, flip) {
    if (axis === null) {
      this.renderer.clippingPlanes = [];
    } else {
      const box = this.box((body) => body.group.visible);
      const at = box.min[axis] + part * (box.max[axis] - box.min[axis]);
      this.plane.normal.set(0, 0, 0);
      this.plane.normal[axis] = flip ? 1 : -1;
      this.plane.constant = flip ? -at : at;
      this.renderer.clippingPlanes = [this.plane];
    }
    this.changed = true;
  }

  /** Where along an axis of the scene a point is, 0 to 1. */
  partAt(axis, point) {
    const box = this.box((body) => body.group.visible);
    return (point[axis] - box.min[axis]) / (box.max[axis] - box.min[axis] || 1);
  }

  resize() {
    const {clientWidth, clientHeight} = this.canvas;
    if (this.width === clientWidth && this.height === clientHeight) return;
    this.width = clientWidth; this.height = clientHeight;
    this.renderer.setPixelRatio(Math.min(2, window.devicePixelRatio));
    this.renderer.setSize(clientWidth, clientHeight, false);
    this.camera.aspect = clientWidth / Math.max(1, clientHeight);
    this.camera.updateProjectionMatrix();
    this.changed = true;
  }

  draw() {
    this.resize();
    if (!this.changed) return false;
    this.changed = false;
    this.dress();
    const towards = this.direction();
    this.camera.position.copy(this.target).addScaledVector(towards, this.turn.distance);
    this.camera.near = Math.max(1, this.turn.distance / 200);
    this.camera.updateProjectionMatrix();
    this.camera.lookAt(this.target);
    this.lamp.position.copy(this.camera.position).add(new THREE.Vector3(0, 0, this.turn.distance * 0.6));
    this.lamp.target.position.copy(this.target);
    this.lamp.target.updateMatrixWorld();
    this.renderer.render(this.world, this.camera);
    return true;
  }

  listen() {
    const pointers = new Map();
    let spread = 0;
    const spreadOf = () => {
      const [a, b] = [...pointers.values()];
      return Math.hypot(a.x - b.x, a.y - b.y);
    };
    const move = (dx, dy) => {
      const scale = this.turn.distance * 0.63 / Math.max(1, this.canvas.clientHeight);
      const right = new THREE.Vector3().setFromMatrixColumn(this.camera.matrixWorld, 0);
      const up = new THREE.Vector3().setFromMatrixColumn(this.camera.matrixWorld, 1);
      this.target.addScaledVector(right, -dx * scale).addScaledVector(up, dy * scale);
    };
    this.canvas.addEventListener('pointerdown', (event) => {
      this.canvas.setPointerCapture(event.pointerId);
      pointers.set(event.pointerId, {x: event.clientX, y: event.clientY});
      if (pointers.size === 2) spread = spreadOf();
    });
    this.canvas.addEventListener('pointermove', (event) => {
      const last = pointers.get(event.pointerId);
      if (!last) return;
      const dx = event.clientX - last.x, dy = event.clientY - last.y;
      pointers.set(event.pointerId, {x: event.clientX, y: event.clientY});
      if (pointers.size === 2) {
        const now = spreadOf();
        this.zoom(spread / now);
        spread = now;
        move(dx / 2, dy / 2);
      } else if (event.buttons & 2 || event.shiftKey) {
        move(dx, dy);
      } else {
        this.turn.azimuth += dx * 0.008;
        this.turn.height = Math.max(-1.5, Math.min(1.5, this.turn.height + dy * 0.008));
      }
      this.changed = true;
    });
    for (const name of ['pointerup', 'pointercancel']) {
      this.canvas.addEventListener(name, (event) => pointers.delete(event.pointerId));
    }
    this.canvas.addEventListener('contextmenu', (event) => event.preventDefault());
    this.canvas.addEventListener('wheel', (event) => {
      event.preventDefault();
      this.zoom(Math.exp(event.deltaY * 0.001));
    }, {passive: false});
  }

  zoom(factor) {
    this.turn.distance = Math.max(20, Math.min(20000, this.turn.distance * factor));
    this.changed = true;
  }
}
