// SPDX-License-Identifier: BSD-3-Clause
// The path of the tip, in the table's frame: it rides on the table.
'use strict';

const STRAIGHT = 0.08;  // mm

class TipPath {
  constructor(view, run, tools) {
    this.view = view;
    this.run = run;
    this.tools = tools;
    this.shown = true;
    this.group = new THREE.Group();
    view.links[view.machine.table].add(this.group);
    this.colors = [];   // a class a piece: 0 rapid, 1 feed, 2 finding
    this.times = [];    // where each piece ends
    this.points = [];   // six numbers a piece
    this.ready = false;
  }

  /** Instants between which all axes run evenly and one block is at work. */
  instants() {
    const {times, begin} = this.run, all = [];
    for (let i = 0, k = 0; i < times.length || k < begin.length;) {
      const next = k >= begin.length || times[i] <= begin[k] ? times[i++] : begin[k++];
      if (all.length === 0 || next > all[all.length - 1]) all.push(next);
    }
    return all;
  }

  /** Some thousand pieces at a time, so that the page stays awake. `faulty`: of each step. */
  async make(faulty) {
    const {run} = this, links = this.view.machine.links;
    const spindle = new Chain(links, this.view.machine.spindle), table = new Chain(links, this.view.machine.table);
    const inverse = new THREE.Matrix4(), tip = new THREE.Vector3(), pose = new Float64Array(run.values.length);
    const turns = run.rotary.map((rotary, j) => (rotary ? j : -1)).filter((j) => j >= 0);
    const tipAt = (time, tool) => {
      run.poseAt(time, pose);
      const known = this.tools.get(tool);
      tip.set(0, 0, known ? known.length : 0).applyMatrix4(spindle.frame(pose));
      return tip.applyMatrix4(inverse.getInverse(table.frame(pose)));
    };
    const instants = this.instants(), before = new Float64Array(pose.length);
    let last = null, lastTool = -1, lastColor = -1;
    const passed = [], way = new THREE.Line3(), foot = new THREE.Vector3();
    let passedAt = 0;
    const add = () => {
      if (!passed.length) return;
      const end = passed[passed.length - 1];
      this.points.push(last.x, last.y, last.z, end.x, end.y, end.z);
      this.times.push(passedAt);
      this.colors.push(lastColor);
      last.copy(end);
      passed.length = 0;
    };
    // Points that lie on the way to the next one need no line of their own.
    const goTo = (end, time) => {
      way.set(last, end);
      const straight = passed.length < 12 && passed.every((p) => way.closestPointToPoint(p, true, foot).distanceToSquared(p) < STRAIGHT * STRAIGHT);
      if (!straight) add();
      if (end.distanceToSquared(passed.length ? passed[passed.length - 1] : last) < 1e-8) return;
      passed.push(end.clone());
      passedAt = time;
    };
    for (let i = 0; i + 1 < instants.length; ++i) {
      if (i % 8000 === 7999) await new Promise((next) => setTimeout(next));
      const from = instants[i], to = instants[i + 1], step = run.stepAt((from + to) / 2), tool = run.tool[step];
      const kind = run.kinds[run.kind[step]];
      const color = faulty[step] ? 2 : kind === 'feed' || kind === 'arc' ? 1 : 0;
      before.set(run.poseAt(from, pose));
      run.poseAt(to, pose);
      let turn = 0;
      for (const j of turns) turn = Math.max(turn, Math.abs(pose[j] - before[j]));
      const pieces = Math.max(1, Math.ceil(turn / 4));
      if (last === null || tool !== lastTool) {
        add();
        last = tipAt(from, tool).clone();
      } else if (color !== lastColor) {
        add();
      }
      lastTool = tool;
      lastColor = color;
      for (let k = 1; k <= pieces; ++k) {
        const time = from + (to - from) * k / pieces;
        goTo(tipAt(time, tool), time);
      }
    }
    add();
    this.build();
  }

  build() {
    this.position = new THREE.BufferAttribute(new Float32Array(this.points), 3);
    this.points = null;
    this.color = new THREE.BufferAttribute(new Float32Array(this.position.count * 3), 3);
    const lines = (opacity, order) => {
      const geometry = new THREE.BufferGeometry();
      geometry.setAttribute('position', this.position);
      geometry.setAttribute('color', this.color);
      const material = new THREE.LineBasicMaterial({vertexColors: THREE.VertexColors, transparent: true, opacity});
      const object = new THREE.LineSegments(geometry, material);
      object.frustumCulled = false;
      object.renderOrder = order;
      this.group.add(object);
      return object;
    };
    this.ahead = lines(0.28, 1);
    this.done = lines(1, 2);
    this.ready = true;
    this.paint();
    this.upTo(this.time || 0);
  }

  paint(style = getComputedStyle(document.documentElement)) {
    if (!this.ready) return;
    const shades = ['--rapid', '--feed', '--error'].map((name) => new THREE.Color(style.getPropertyValue(name).trim()));
    shades[0].lerp(new THREE.Color(style.getPropertyValue('--sky').trim()), 0.45);  // Rapids cross everything.
    this.colors.forEach((which, i) => {
      const {r, g, b} = shades[which];
      this.color.setXYZ(2 * i, r, g, b);
      this.color.setXYZ(2 * i + 1, r, g, b);
    });
    this.color.needsUpdate = true;
    this.view.changed = true;
  }

  show(shown) { this.shown = this.group.visible = shown; this.view.changed = true; }

  upTo(time) {
    this.time = time;
    if (!this.ready) return;
    const done = this.times.length && this.times[0] <= time ? 2 * (lastAtMost(this.times, time) + 1) : 0;
    this.done.geometry.setDrawRange(0, done);
    this.ahead.geometry.setDrawRange(done, this.position.count - done);
  }
}
