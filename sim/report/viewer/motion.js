// SPDX-License-Identifier: BSD-3-Clause
// The run: joint values over time (s; mm and degrees), and which block is when.
'use strict';

class Run {
  constructor({scene, column}) {
    const {keys, steps, units, machine} = scene;
    this.times = column(keys.ticks, units.ticks_per_s);
    this.values = keys.values.map((c) => column(c, units.values_per_unit));
    this.rotary = keys.rotary;
    this.end = keys.end / units.ticks_per_s;
    this.axes = machine.axes;
    this.kinds = scene.kinds;
    this.begin = column(steps.begin, units.ticks_per_s);
    this.file = column(steps.file);
    this.line = column(steps.line);
    this.kind = column(steps.kind);
    this.tool = column(steps.tool);
    this.visits = new Map();  // 'file:line' -> steps
    for (let i = 0; i < this.line.length; ++i) {
      const key = this.file[i] + ':' + this.line[i];
      const known = this.visits.get(key);
      if (known) known.push(i); else this.visits.set(key, [i]);
    }
  }

  stepAt(time) { return lastAtMost(this.begin, time); }
  endOf(step) { return step + 1 < this.begin.length ? this.begin[step + 1] : this.end; }

  /** Joint values at a time. */
  poseAt(time, pose = new Float64Array(this.values.length)) {
    const i = lastAtMost(this.times, time);
    const whole = i + 1 < this.times.length ? this.times[i + 1] - this.times[i] : 0;
    const part = whole > 0 ? Math.min(1, Math.max(0, (time - this.times[i]) / whole)) : 0;
    for (let j = 0; j < pose.length; ++j) {
      const column = this.values[j];
      pose[j] = part > 0 ? column[i] + part * (column[i + 1] - column[i]) : column[i];
    }
    return pose;
  }

  /** The step of a line: the first after `time`, or else the first of all; -1 for none. */
  stepOfLine(file, line, time) {
    const steps = this.visits.get(file + ':' + line);
    if (!steps) return -1;
    const next = steps.find((step) => this.begin[step] > time + 1e-6);
    return next === undefined ? steps[0] : next;
  }

  /** The last step before a line that makes no motion. */
  stepBefore(file, line) {
    let best = -1;
    for (let i = 0; i < this.line.length; ++i) {
      if (this.file[i] === file && this.line[i] <= line) best = i;
    }
    return best;
  }
}

/** Forward kinematics of one link: `frame(pose)` is its place in the machine frame. */
class Chain {
  constructor(links, link) {
    this.steps = [];
    let fixed = new THREE.Matrix4();
    const way = [];
    for (let i = link; i >= 0; i = links[i].parent) way.unshift(links[i]);
    for (const item of way) {
      if (!item.place) continue;
      const place = new THREE.Matrix4().compose(new THREE.Vector3(...item.place),
          new THREE.Quaternion(...item.rotation), new THREE.Vector3(1, 1, 1));
      fixed = fixed.clone().multiply(place);
      if (item.joint < 0) continue;
      this.steps.push({fixed, joint: item.joint, turns: item.turns, axis: new THREE.Vector3(...item.axis)});
      fixed = new THREE.Matrix4();
    }
    this.last = fixed;
    this.moved = new THREE.Matrix4();
    this.result = new THREE.Matrix4();
  }

  frame(pose) {
    this.result.identity();
    for (const {fixed, joint, turns, axis} of this.steps) {
      if (turns) this.moved.makeRotationAxis(axis, pose[joint] * Math.PI / 180);
      else this.moved.makeTranslation(axis.x * pose[joint], axis.y * pose[joint], axis.z * pose[joint]);
      this.result.multiply(fixed).multiply(this.moved);
    }
    return this.result.multiply(this.last);
  }
}
