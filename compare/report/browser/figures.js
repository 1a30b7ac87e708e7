// Figures of the page come to life: charts in place of drawings, legends as switches, pictures and data to take along.
'use strict';

// A button for each label of the legend that shows and hides its series in all panels; pointed at, it shows their errors.
soilbin.enlivenLegend = function (figure, hidden, redraw) {
  for (const item of figure.querySelectorAll('.legend li')) {
    const label = item.textContent, button = document.createElement('button');
    button.type = 'button';
    button.setAttribute('aria-pressed', 'true');
    button.title = 'Show or hide';
    button.append(...item.childNodes);
    item.append(button);
    button.addEventListener('click', () => {
      if (!hidden.delete(label)) hidden.add(label);
      button.setAttribute('aria-pressed', String(!hidden.has(label)));
      redraw();
    });
    const point = at => { hidden.pointed = at; redraw(); };
    for (const [event, at] of [['mouseenter', label], ['focus', label], ['mouseleave', null], ['blur', null]])
      button.addEventListener(event, () => point(at));
  }
};

// The rows behind a figure, a header first: points of its sheet, or the marks of a drawing that tell their value.
soilbin.rowsOf = function (figure, sheet) {
  if (!sheet) {
    const marks = [...figure.querySelectorAll('[data-value]')];
    return [['plot', 'x', 'y', 'value']].concat(marks.map(mark =>
      [mark.closest('svg').getAttribute('aria-label'), mark.dataset.x, mark.dataset.y, mark.dataset.value]));
  }
  const rows = [['plot', 'series', 'x', 'y', 'error']];
  for (const plot of sheet.plots)
    for (const series of plot.series)
      series.x.forEach((x, i) => rows.push([plot.title, series.label, x, soilbin.valueAt(series, i), series.error[i]]));
  return rows.map(row => row.map(value => value === null || value === undefined ? '' : value));
};

soilbin.csvOf = function (rows) {
  const cell = text => /[",\n]/.test(text) ? `"${text.replace(/"/g, '""')}"` : text;
  return rows.map(row => row.map(value => cell(String(value))).join(',')).join('\n') + '\n';
};

soilbin.saveFile = function (name, content, type) {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(new Blob([content], {type}));
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
};

// Copies a text and says so on the button; a page that may not reach the clipboard copies a selection.
soilbin.copyText = async function (text, button) {
  try {
    await navigator.clipboard.writeText(text);
  } catch (refused) {
    const box = document.createElement('textarea');
    box.value = text;
    document.body.append(box);
    box.select();
    document.execCommand('copy');
    box.remove();
  }
  const before = button.textContent;
  button.textContent = 'Copied';
  setTimeout(() => { button.textContent = before; }, 1500);
};

// What the page's style gives a mark, as attributes that any program reads; left out where it is what SVG presumes.
soilbin.savedStyle = {
  'fill': 'rgb(0, 0, 0)', 'fill-opacity': '1', 'stroke': 'none', 'stroke-width': '1px', 'stroke-dasharray': 'none',
  'stroke-linejoin': 'miter', 'opacity': '1', 'font-size': '', 'font-weight': '400', 'text-anchor': 'start'};
soilbin.savedOfText = ['font-size', 'font-weight', 'text-anchor'];

soilbin.styleToSave = function (mark) {
  const style = getComputedStyle(mark), idle = key =>
    style[key] === soilbin.savedStyle[key] || (mark.nodeName !== 'text' && soilbin.savedOfText.includes(key));
  return Object.keys(soilbin.savedStyle).filter(key => !idle(key) || mark.hasAttribute(key))
    .map(key => [key, style[key].replace(/px/g, '')]);
};

// A figure as one stand-alone SVG on white, in the light colours whatever the screen's, laid out as it is seen: its
// drawings, its legend (what is switched off is left out), its caption for those who can't see it.
soilbin.figureSvg = function (figure) {
  const make = (name, set) => {
    const element = document.createElementNS('http://www.w3.org/2000/svg', name);
    for (const [key, value] of Object.entries(set)) element.setAttribute(key, value);
    return element;
  };
  const shown = [...figure.querySelectorAll('svg')].filter(svg => svg.getBoundingClientRect().width > 0)
    .filter(svg => !svg.closest('[aria-pressed=false]'));
  const places = shown.map(svg => svg.getBoundingClientRect()), margin = 12;
  const left = Math.min(...places.map(p => p.left)) - margin, top = Math.min(...places.map(p => p.top)) - margin;
  const width = Math.ceil(Math.max(...places.map(p => p.right)) - left + margin);
  let height = Math.ceil(Math.max(...places.map(p => p.bottom)) - top + margin), right = width;
  const whole = make('svg', {xmlns: 'http://www.w3.org/2000/svg', class: 'as-saved', 'font-size': '12',
                             'font-family': "system-ui, 'Segoe UI', 'DejaVu Sans', Helvetica, Arial, sans-serif"});
  const caption = figure.querySelector('figcaption');
  if (caption) whole.append(Object.assign(make('desc', {}), {textContent: caption.textContent.trim()}));
  const paper = whole.appendChild(make('rect', {width: '100%', height: '100%', fill: '#ffffff'}));
  shown.forEach((svg, i) => {
    const copy = svg.cloneNode(true), place = places[i];
    copy.querySelectorAll('.cursor, title').forEach(one => one.remove());
    for (const [key, value] of [['x', place.left - left], ['y', place.top - top], ['width', place.width], ['height', place.height]])
      copy.setAttribute(key, value.toFixed(1));
    whole.append(copy);
    const item = svg.closest('.legend li');
    if (!item) return;
    const text = whole.appendChild(make('text', {class: 'ink', x: (place.right - left + 7).toFixed(1),
                                                 y: (place.top + place.height / 2 - top + 4).toFixed(1)}));
    text.textContent = item.textContent;
    right = Math.max(right, place.right - left + 7 + 7 * item.textContent.length);
  });
  whole.style.cssText = 'position:absolute;left:-99999px';
  document.body.append(whole);
  const marks = [...whole.querySelectorAll('*')].filter(e => e !== paper && !['desc', 'clipPath'].includes(e.nodeName));
  const styles = marks.map(soilbin.styleToSave);  // all of them before any loses its class
  marks.forEach((mark, i) => {
    for (const key of ['class', 'style', 'tabindex', 'role', 'aria-label', 'data-tip']) mark.removeAttribute(key);
    for (const [key, value] of styles[i]) mark.setAttribute(key, value);
  });
  whole.remove();
  whole.removeAttribute('style');
  whole.removeAttribute('class');
  for (const [key, value] of [['viewBox', `0 0 ${Math.ceil(right)} ${height}`], ['width', Math.ceil(right)], ['height', height]])
    whole.setAttribute(key, value);
  return `<?xml version="1.0" encoding="UTF-8"?>\n${new XMLSerializer().serializeToString(whole)}\n`;
};

// The SVG as a PNG file, two pixels a unit.
soilbin.pngOf = async function (svg) {
  const image = new Image(), canvas = document.createElement('canvas');
  await new Promise((done, failed) => {
    image.onload = done;
    image.onerror = () => failed(new Error('the drawing can not be read'));
    image.src = `data:image/svg+xml;charset=utf-8,${encodeURIComponent(svg)}`;
  });
  canvas.width = 2 * image.width;
  canvas.height = 2 * image.height;
  canvas.getContext('2d').drawImage(image, 0, 0, canvas.width, canvas.height);
  return new Promise(done => canvas.toBlob(done, 'image/png'));
};

// Buttons below a figure: save it, copy or save its data. `name` begins the files' names, `title` tells ears what is
// saved; `sheet()` gives the data of charts, and is left out for a drawing. Each button's data-take says what it does.
soilbin.addTakeAlong = function (figure, name, title, sheet) {
  const row = document.createElement('p');
  row.className = 'take-along';
  const add = (take, text, what, act) => {
    const button = document.createElement('button');
    button.type = 'button';
    button.textContent = text;
    button.dataset.take = take;
    button.setAttribute('aria-label', `${what} ${title}`);
    button.addEventListener('click', () => act(button));
    row.append(button, ' ');
  };
  const rows = () => soilbin.rowsOf(figure, sheet && sheet()), csv = () => soilbin.csvOf(rows());
  row.append('Save figure: ');
  add('svg', 'SVG', 'Save as SVG:', () => soilbin.saveFile(`${name}.svg`, soilbin.figureSvg(figure), 'image/svg+xml'));
  add('png', 'PNG', 'Save as PNG:', async () =>
    soilbin.saveFile(`${name}.png`, await soilbin.pngOf(soilbin.figureSvg(figure)), 'image/png'));
  if (sheet || figure.querySelector('[data-value]')) {
    row.append('Data: ');
    add('copy', 'Copy', 'Copy the data of', button => soilbin.copyText(rows().map(r => r.join('\t')).join('\n'), button));
    add('csv', 'CSV', 'Save the data as CSV:', () => soilbin.saveFile(`${name}.csv`, csv(), 'text/csv'));
    if (sheet)
      add('json', 'JSON', 'Save the data as JSON:', () =>
        soilbin.saveFile(`${name}.json`, JSON.stringify(sheet(), null, 1), 'application/json'));
  }
  figure.append(row);
};

soilbin.enlivenFigure = function (figure, sheet) {
  const panels = figure.querySelector('.panels'), hidden = new Set(), charts = [];
  panels.replaceChildren();
  for (const plot of sheet.plots) {
    const host = document.createElement('div');
    panels.append(host);
    charts.push(new soilbin.Chart(host, plot, hidden));
  }
  figure.classList.add('alive');
  soilbin.enlivenLegend(figure, hidden, () => charts.forEach(chart => chart.draw()));
};

// Parts of which one is shown at a time get a list to choose from; without scripts, and in `details`, all are there.
soilbin.enlivenChoices = function (box) {
  const parts = [...box.querySelectorAll(':scope > .choice')];
  if (parts.length < 2) return;
  const label = document.createElement('label'), select = document.createElement('select');
  label.className = 'chooser';
  label.append(box.dataset.what + ' ', select);
  parts.forEach((part, i) => select.add(new Option(part.dataset.name, i)));
  const first = Math.max(0, parts.findIndex(part => part.hasAttribute('data-first')));
  const show = chosen => parts.forEach((part, i) => { part.hidden = i !== chosen; });
  select.value = first;
  select.addEventListener('change', () => show(Number(select.value)));
  box.prepend(label);
  box.classList.add('alive');
  show(first);
};

// Cells of a heat map: one stop of the Tab key, arrows move within, the reading stands below.
soilbin.enlivenHeatMap = function (svg) {
  const cells = [...svg.querySelectorAll('.cell')], said = document.createElement('p');
  if (!cells.length) return;
  said.className = 'reading';
  said.setAttribute('aria-live', 'polite');
  said.textContent = 'Point at a cell, or move with the arrow keys.';
  svg.after(said);
  const at = (row, column) => cells.find(c => Number(c.dataset.row) === row && Number(c.dataset.column) === column);
  const steps = {ArrowLeft: [0, -1], ArrowRight: [0, 1], ArrowUp: [-1, 0], ArrowDown: [1, 0]};
  cells.forEach((cell, i) => {
    cell.setAttribute('tabindex', i === 0 ? 0 : -1);
    const tell = () => { said.textContent = cell.dataset.tip; };
    cell.addEventListener('mousemove', () => { if (soilbin.pointed) tell(); });
    cell.addEventListener('focus', tell);
    cell.addEventListener('keydown', event => {
      const step = steps[event.key];
      if (!step) return;
      event.preventDefault();
      const next = at(Number(cell.dataset.row) + step[0], Number(cell.dataset.column) + step[1]);
      if (!next) return;
      cell.setAttribute('tabindex', -1);
      next.setAttribute('tabindex', 0);
      next.focus();
    });
  });
};

// A link into a folded part opens it.
soilbin.openTarget = function () {
  const target = location.hash.length > 1 && document.getElementById(location.hash.slice(1));
  if (!target) return;
  for (let fold = target.closest('details'); fold; fold = fold.parentElement.closest('details')) fold.open = true;
  target.scrollIntoView();
};
