// Figures of the page come to life: charts in place of drawings, legends as switches, data to take along.
'use strict';

// A button for each label of the legend that shows and hides its series in all panels.
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
  }
};

soilbin.csvOf = function (sheet) {
  const cell = text => /[",\n]/.test(text) ? `"${text.replace(/"/g, '""')}"` : text;
  const rows = [['plot', 'series', 'x', 'y', 'error']];
  for (const plot of sheet.plots)
    for (const series of plot.series)
      series.x.forEach((x, i) => rows.push([plot.title, series.label, x, series.y[i], series.error[i]]));
  return rows.map(row => row.map(value => cell(String(value === null || value === undefined ? '' : value))).join(',')).join('\n');
};

soilbin.addDownload = function (figure, name, sheet) {
  const save = (text, type, extension) => {
    const link = document.createElement('a');
    link.href = URL.createObjectURL(new Blob([text], {type}));
    link.download = `${name}.${extension}`;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 1000);
  };
  const row = document.createElement('p');
  row.className = 'take-along';
  row.append('Data of this figure: ');
  for (const [extension, type, text] of [['csv', 'text/csv', () => soilbin.csvOf(sheet)],
                                         ['json', 'application/json', () => JSON.stringify(sheet, null, 1)]]) {
    const button = document.createElement('button');
    button.type = 'button';
    button.textContent = extension.toUpperCase();
    button.setAttribute('aria-label', `Save the data of ${sheet.title || name} as ${extension.toUpperCase()}`);
    button.addEventListener('click', () => save(text(), type, extension));
    row.append(button, ' ');
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
  soilbin.addDownload(figure, figure.id, sheet);
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
