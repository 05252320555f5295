// SPDX-License-Identifier: BSD-3-Clause
// Rows over one time axis: tools, findings, least clearance, each axis against its limits.
'use strict';

class Charts {
  constructor(page, run, seen, findings, go) {
    this.run = run;
    this.findings = findings;
    this.go = go;
    this.canvas = document.getElementById('plot');
    this.head = document.getElementById('playhead');
    this.tipBox = document.getElementById('tip');
    this.seen = seen;
    this.tools = new Map(page.scene.tools.map((tool) => [tool.number, tool]));
    this.range = [0, Math.max(run.end, 1e-3)];
    this.rows = [{name: 'Tool', height: 18, draw: this.drawTools}, {name: 'Findings', height: 18, draw: this.drawFindings}];
    if (this.seen.times.length) this.rows.push({name: 'Clearance', height: 40, draw: this.drawClearance});
    for (const axis of run.axes) this.rows.push({name: axis.letter, height: 21, axis, draw: this.drawAxis});
    const box = document.getElementById('rows');
    for (const row of this.rows) {
      const line = document.createElement('div');
      line.innerHTML = '<span class="name"></span><span class="value"></span>';
      line.firstChild.textContent = row.name;
      line.style.height = line.style.lineHeight = row.height + 'px';
      row.value = line.lastChild;
      box.append(line);
    }
    this.height = this.rows.reduce((sum, row) => sum + row.height, 18);
    this.canvas.style.height = this.height + 'px';
    this.listen();
  }

  x(time) { return (time - this.range[0]) / (this.range[1] - this.range[0]) * this.width; }
  timeAt(x) { return this.range[0] + x / this.width * (this.range[1] - this.range[0]); }

  draw() {
    const ratio = Math.min(2, window.devicePixelRatio);
    this.width = this.canvas.clientWidth;
    if (!this.width) return;
    this.canvas.width = this.width * ratio;
    this.canvas.height = this.height * ratio;
    const pen = this.pen = this.canvas.getContext('2d');
    pen.scale(ratio, ratio);
    const style = getComputedStyle(document.documentElement);
    this.color = (name) => style.getPropertyValue('--' + name).trim();
    pen.font = '11px system-ui, sans-serif';
    pen.lineJoin = 'bevel';
    pen.textBaseline = 'middle';
    let top = 0;
    for (const row of this.rows) {
      pen.fillStyle = this.color('line');
      pen.fillRect(0, top + row.height - 1, this.width, 1);
      row.top = top;
      row.draw.call(this, top, row.height - 1, row);
      top += row.height;
    }
    this.drawTimes(top);
    this.playhead(this.now || 0);
  }

  drawTimes(top) {
    const span = this.range[1] - this.range[0];
    const step = [0.01, 0.05, 0.1, 0.5, 1, 2, 5, 10, 30, 60, 120, 300, 600, 1800, 3600, 7200, 18000].find((s) => s > span / this.width * 80) || 36000;
    this.pen.fillStyle = this.color('faint');
    for (let t = Math.ceil(this.range[0] / step) * step; t < this.range[1]; t += step) {
      this.pen.fillRect(this.x(t), top, 1, 4);
      this.pen.fillText(timeText(t, step < 1 ? 2 : 0), this.x(t) + 3, top + 9);
    }
  }

  drawTools(top, height) {
    const {run, pen} = this;
    let i = run.stepAt(this.range[0]);
    while (i < run.begin.length && run.begin[i] < this.range[1]) {
      let k = i;
      while (k + 1 < run.begin.length && run.tool[k + 1] === run.tool[i]) ++k;
      const x0 = Math.max(0, this.x(run.begin[i])), x1 = this.x(run.endOf(k));
      if (run.tool[i] > 0) {
        pen.fillStyle = this.color(run.tool[i] % 2 ? 'raised' : 'sky');
        pen.fillRect(x0, top + 1, Math.max(1, x1 - x0 - 1), height - 2);
        pen.fillStyle = this.color('text');
        const tool = this.tools.get(run.tool[i]), label = 'T' + run.tool[i], long = tool && tool.name ? `${label} ${tool.name}` : label;
        const fits = [long, label].find((text) => pen.measureText(text).width < Math.min(x1, this.width) - x0 - 6);
        if (fits) pen.fillText(fits, x0 + 4, top + height / 2 + 1);
      }
      i = k + 1;
    }
  }

  drawFindings(top, height) {
    const order = {warning: 0, unproven: 1, error: 2};
    for (const finding of [...this.findings].sort((a, b) => order[a.severity] - order[b.severity])) {
      if (finding.time === null || finding.time < this.range[0] || finding.time > this.range[1]) continue;
      const x = this.x(finding.time), error = finding.severity === 'error';
      this.pen.fillStyle = this.color(finding.severity === 'warning' ? 'warn' : finding.severity);
      this.pen.beginPath();
      this.pen.arc(Math.min(this.width - 6, Math.max(6, x)), top + height / 2, error ? 5.5 : 3.5, 0, 7);
      this.pen.fill();
    }
  }

  /** Logarithmic from 0.1 to 1000 mm; a contact stands on the ground. */
  drawClearance(top, height) {
    const {pen, seen} = this;
    const y = (mm) => top + height - 2 - Math.min(1, Math.max(0, (Math.log10(Math.max(mm, 0.1)) + 1) / 4)) * (height - 6);
    pen.fillStyle = this.color('faint');
    for (const mm of [1, 10, 100]) {
      pen.globalAlpha = 0.35;
      pen.fillRect(0, y(mm), this.width, 1);
      pen.globalAlpha = 1;
      if (mm !== 10) pen.fillText(mm + ' mm', 4, y(mm) - 6);
    }
    pen.strokeStyle = this.color('accent');
    pen.lineWidth = 1.5;
    pen.beginPath();
    const first = Math.max(0, lastAtMost(seen.times, this.range[0]) - 1);
    for (let i = first; i < seen.times.length && (i === first || seen.times[i - 1] <= this.range[1]); ++i) {
      if (i === first) pen.moveTo(this.x(seen.times[i]), y(seen.values[i])); else pen.lineTo(this.x(seen.times[i]), y(seen.values[i]));
    }
    pen.stroke();
    pen.fillStyle = this.color('error');
    seen.values.forEach((mm, i) => { if (mm <= 0) pen.fillRect(this.x(seen.times[i]) - 1, top + height - 6, 3, 6); });
  }

  drawAxis(top, height, {axis}) {
    const {run, pen} = this, values = run.values[axis.joint], times = run.times;
    let {lower, upper} = axis;
    if (lower === null || upper === null) {
      lower = values.reduce((a, b) => Math.min(a, b), Infinity);
      upper = values.reduce((a, b) => Math.max(a, b), -Infinity);
    }
    const span = upper - lower || 1;
    const y = (value) => top + height - 3 - (value - lower) / span * (height - 6);
    pen.fillStyle = this.color('faint');
    pen.globalAlpha = axis.lower === null ? 0 : 0.5;
    pen.fillRect(0, y(lower), this.width, 1);
    pen.fillRect(0, y(upper), this.width, 1);
    pen.globalAlpha = 1;
    pen.strokeStyle = this.color('accent');
    pen.lineWidth = 1.2;
    pen.beginPath();
    const out = [];
    let column = -1, low = 0, high = 0;
    const point = (time, value) => {
      const x = this.x(time), c = Math.floor(x);
      if (c === column) { low = Math.min(low, value); high = Math.max(high, value); return; }
      if (column >= 0) { pen.lineTo(column, y(low)); pen.lineTo(column, y(high)); }
      column = c; low = high = value;
      pen.lineTo(x, y(value));
      if (value < lower - 1e-3 || value > upper + 1e-3) out.push([x, value]);
    };
    let i = lastAtMost(times, this.range[0]);
    point(this.range[0], run.poseAt(this.range[0])[axis.joint]);
    for (; i < times.length && times[i] <= this.range[1]; ++i) if (times[i] > this.range[0]) point(times[i], values[i]);
    point(this.range[1], run.poseAt(this.range[1])[axis.joint]);
    if (column >= 0) { pen.lineTo(column, y(low)); pen.lineTo(column, y(high)); }
    pen.stroke();
    pen.fillStyle = this.color('error');
    for (const [x, value] of out) pen.fillRect(x - 1.5, y(value) - 1.5, 4, 4);
  }

  playhead(time) {
    this.now = time;
    if (time > this.range[1] || time < this.range[0]) {
      const span = this.range[1] - this.range[0], begin = Math.max(0, Math.min(this.run.end - span, time - span / 10));
      this.range = [begin, begin + span];
      this.draw();
      return;
    }
    if (this.width) this.head.style.left = this.canvas.offsetLeft + this.x(time) + 'px';
  }

  /** Values at the playhead, left of the rows. */
  values(pose, tool) {
    for (const row of this.rows) {
      if (row.axis) {
        row.value.textContent = pose[row.axis.joint].toFixed(3) + (row.axis.rotary ? '°' : '');
        const {lower, upper} = row.axis, value = pose[row.axis.joint];
        row.value.style.color = lower !== null && (value < lower - 1e-3 || value > upper + 1e-3) ? 'var(--error)' : '';
      } else if (row.name === 'Tool') {
        row.value.textContent = tool > 0 ? 'T' + tool : 'none';
      } else if (row.name === 'Clearance') {
        const i = lastAtMost(this.seen.times, this.now + 1e-4), mm = this.seen.values[i];
        row.value.textContent = mm <= 0 ? 'contact' : mm.toFixed(mm < 10 ? 2 : 0) + ' mm';
      } else {
        row.value.textContent = this.findings.length;
      }
    }
  }

  hover(event) {
    const x = event.clientX - this.canvas.getBoundingClientRect().left, y = event.clientY - this.canvas.getBoundingClientRect().top;
    const time = this.timeAt(x), row = this.rows.find((r) => y >= r.top && y < r.top + r.height);
    let text = timeText(time, 1);
    if (row && row.name === 'Clearance') {
      const i = lastAtMost(this.seen.times, time);
      text += `: ${this.seen.values[i].toFixed(2)} mm, ${this.seen.pairs[this.seen.pair[i]].join(' and ')}`;
    } else if (row && row.axis) {
      text += `: ${row.axis.letter} ${this.run.poseAt(time)[row.axis.joint].toFixed(3)}`;
      if (row.axis.lower !== null) text += ` (${row.axis.lower.toFixed(1)} to ${row.axis.upper.toFixed(1)})`;
    }
    this.tipBox.textContent = text;
    this.tipBox.hidden = false;
    this.tipBox.style.left = Math.min(this.canvas.offsetLeft + x + 12, this.canvas.offsetLeft + this.width - this.tipBox.offsetWidth) + 'px';
    this.tipBox.style.top = Math.max(0, y - 28) + 'px';
  }

  listen() {
    let held = false;
    const at = (event) => Math.max(0, Math.min(this.run.end, this.timeAt(event.clientX - this.canvas.getBoundingClientRect().left)));
    this.canvas.addEventListener('pointerdown', (event) => {
      held = true;
      this.canvas.setPointerCapture(event.pointerId);
      const y = event.clientY - this.canvas.getBoundingClientRect().top, row = this.rows[1];
      const near = y >= row.top && y < row.top + row.height
        ? this.findings.filter((f) => f.time !== null).sort((a, b) => Math.abs(a.time - at(event)) - Math.abs(b.time - at(event)))[0] : null;
      if (near && Math.abs(this.x(near.time) - this.x(at(event))) < 12) { held = false; this.go.finding(near); } else this.go.time(at(event));
    });
    this.canvas.addEventListener('pointermove', (event) => { this.hover(event); if (held) this.go.time(at(event)); });
    this.canvas.addEventListener('pointerup', () => { held = false; });
    this.canvas.addEventListener('pointerleave', () => { this.tipBox.hidden = true; });
    this.canvas.addEventListener('dblclick', () => { this.range = [0, this.run.end]; this.draw(); });
    this.canvas.addEventListener('wheel', (event) => {
      event.preventDefault();
      const here = at(event), factor = Math.exp(event.deltaY * 0.002);
      const begin = Math.max(0, here - (here - this.range[0]) * factor), end = Math.min(this.run.end, here + (this.range[1] - here) * factor);
      if (end - begin > 0.02) this.range = [begin, end];
      this.draw();
    }, {passive: false});
  }
}
