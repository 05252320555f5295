// SPDX-License-Identifier: BSD-3-Clause
// Findings by rule and line; the program's text, of which only what is in sight is in the page.
'use strict';

const SEVERITIES = ['error', 'unproven', 'warning'];
const SHOWN_OF_A_RULE = 40;

function element(tag, className, text) {
  const made = document.createElement(tag);
  if (className) made.className = className;
  if (text !== undefined) made.textContent = text;
  return made;
}

/** As element(), for text with words like, which are not to be broken at the sign. */
function phrase(tag, className, text) {
  const made = element(tag, className);
  text.split(/([A-Z]+\d*=?-[\d.]+)/).forEach((part, i) => made.append(i % 2 ? element('span', 'whole', part) : part));
  return made;
}

class FindingList {
  constructor(result, findings, nearest, go) {
    this.box = document.getElementById('findings');
    this.items = new Map();
    this.go = go;
    const rules = new Map();
    for (const finding of findings) {
      const key = finding.severity + ' ' + finding.rule;
      if (!rules.has(key)) rules.set(key, []);
      rules.get(key).push(finding);
    }
    const order = [...rules.values()].sort((a, b) => SEVERITIES.indexOf(a[0].severity) - SEVERITIES.indexOf(b[0].severity));
    for (const group of order) this.addGroup(group);
    if (findings.length === 0) this.box.append(element('p', '', 'Nothing was found.'));
    if (nearest.length) this.addNearest(nearest);
    this.addRest(result);
  }

  addGroup(group) {
    const title = element('h2');
    title.append(element('span', 'dot ' + group[0].severity), element('span', '', group[0].rule), element('span', 'count', plural(group.length, group[0].severity)));
    this.box.append(title);
    this.addSome(group, 0);
  }

  addSome(group, from) {
    const end = this.box.querySelector('.rest') || null;
    for (const finding of group.slice(from, from + SHOWN_OF_A_RULE)) {
      const item = element('button', 'item');
      item.append(element('span', 'line', finding.line > 0 ? finding.line : ''), phrase('span', 'what', finding.message));
      item.addEventListener('click', () => this.go.finding(finding));
      this.items.set(finding, item);
      this.box.insertBefore(item, this.more && this.more.parentNode && from > 0 ? this.more : end);
    }
    if (from > 0 && this.more) this.more.remove();
    const left = group.length - from - SHOWN_OF_A_RULE;
    if (left <= 0) return;
    const more = element('button', 'item', `${left} more`);
    const after = [...this.items.values()].pop();
    after.after(more);
    more.addEventListener('click', () => { this.more = more; this.addSome(group, from + SHOWN_OF_A_RULE); });
  }

  addNearest(nearest) {
    const title = element('h2');
    title.append(element('span', 'dot'), element('span', '', 'least clearance'), element('span', 'count', plural(nearest.length, 'pair')));
    this.box.append(title);
    for (const pair of nearest.slice(0, 12)) {
      const item = element('button', 'item');
      item.append(element('span', 'line', pair.line), element('span', 'what', pair.message));
      item.addEventListener('click', () => this.go.finding(pair));
      this.items.set(pair, item);
      this.box.append(item);
    }
  }

  addRest(result) {
    if (result.assumptions.length) {
      const title = element('h2', 'rest');
      title.append(element('span', '', 'assumed'), element('span', 'count', result.assumptions.length));
      this.box.append(title);
      for (const one of result.assumptions) this.box.append(phrase('p', '', `${one.name}: ${one.text}`));
    }
    if (result.not_checked.length) this.box.append(element('p', 'fine', 'Not checked: ' + result.not_checked.join(', ')));
  }

  mark(finding) {
    for (const item of this.items.values()) item.removeAttribute('aria-current');
    const item = this.items.get(finding);
    if (!item) return;
    item.setAttribute('aria-current', 'true');
    item.scrollIntoView({block: 'nearest'});
  }
}

const ROW = 18;

class ProgramText {
  constructor(texts, findings, go) {
    this.texts = texts.map(({name, text}) => ({name, lines: text.split(/\r\n|\n|\r/)}));
    this.box = document.getElementById('nc');
    this.inner = document.getElementById('ncinner');
    this.select = document.getElementById('file');
    this.severity = new Map();
    for (const finding of [...findings].reverse()) {
      if (finding.line <= 0) continue;
      const key = finding.fileIndex + ':' + finding.line, known = this.severity.get(key);
      if (!known || SEVERITIES.indexOf(finding.severity) < SEVERITIES.indexOf(known)) this.severity.set(key, finding.severity);
    }
    this.texts.forEach(({name}, i) => this.select.append(new Option(name.split('/').pop(), i)));
    this.select.hidden = this.texts.length < 2;
    this.select.addEventListener('change', () => this.open(Number(this.select.value)));
    this.box.addEventListener('scroll', () => this.draw());
    this.inner.addEventListener('click', (event) => {
      const row = event.target.closest('.row');
      if (row) go.line(this.file, Number(row.dataset.line));
    });
    this.now = {file: 0, line: 0};
    this.open(0);
  }

  open(file) {
    this.file = file;
    this.select.value = file;
    this.inner.style.height = this.texts[file].lines.length * ROW + 'px';
    this.drawn = null;
    this.draw();
  }

  draw() {
    const {lines} = this.texts[this.file];
    const first = Math.max(0, Math.floor(this.box.scrollTop / ROW) - 5);
    const last = Math.min(lines.length, Math.ceil((this.box.scrollTop + this.box.clientHeight) / ROW) + 5);
    const key = [this.file, first, last, this.now.file, this.now.line].join();
    if (key === this.drawn) return;
    this.drawn = key;
    const rows = document.createDocumentFragment();
    for (let i = first; i < last; ++i) {
      const row = element('div', 'row ' + (this.severity.get(this.file + ':' + (i + 1)) || ''));
      if (this.now.file === this.file && this.now.line === i + 1) row.classList.add('now');
      row.style.top = i * ROW + 'px';
      row.dataset.line = i + 1;
      row.append(element('span', 'no', i + 1), lines[i].length > 400 ? lines[i].slice(0, 400) + '...' : lines[i]);
      rows.append(row);
    }
    this.inner.replaceChildren(rows);
  }

  /** The block at work; it is kept in sight. */
  at(file, line) {
    if (this.now.file === file && this.now.line === line) return;
    this.now = {file, line};
    if (file !== this.file && file < this.texts.length) this.open(file);
    this.reveal();
  }

  /** What is hidden does not scroll: on a narrow page this is asked for when the text comes up. */
  reveal() {
    const top = (this.now.line - 1) * ROW, {scrollTop, clientHeight} = this.box;
    const out = top < scrollTop + ROW || top > scrollTop + clientHeight - 3 * ROW;
    if (this.now.file === this.file && out) this.box.scrollTop = Math.max(0, top - clientHeight / 2);
    this.draw();
  }
}
