// Starts what the page holds.
'use strict';

// What a figure's files are called: its title, of a lone panel with the panel's; else what its drawing is said to show.
soilbin.fileNameOf = function (figure, sheet) {
  const drawing = figure.querySelector('svg'), plots = sheet ? sheet.plots : [];
  const words = sheet ? [sheet.title, ...(!sheet.title || plots.length === 1 ? plots.slice(0, 1).map(p => p.title.split(' [')[0]) : [])]
    : [drawing.getAttribute('aria-label') || drawing.querySelector('text').textContent];
  const name = words.join(' ').toLowerCase().normalize('NFKD').replace(/[^a-z0-9]+/g, '-').slice(0, 60).replace(/^-|-$/g, '');
  return name || figure.id || 'figure';
};

soilbin.start = function () {
  const data = document.getElementById('figures'), sheets = data ? JSON.parse(data.textContent) : {};
  if (typeof d3 !== 'undefined')
    for (const [id, sheet] of Object.entries(sheets)) soilbin.enlivenFigure(document.getElementById(id), sheet);
  for (const figure of document.querySelectorAll('figure'))
    if (figure.querySelector('svg') && !figure.querySelector('.replay'))
      soilbin.addTakeAlong(figure, soilbin.fileNameOf(figure, sheets[figure.id]), sheets[figure.id] && sheets[figure.id].title || 'this figure',
                           sheets[figure.id] && (() => sheets[figure.id]));
  for (const figure of document.querySelectorAll('.sliding-map')) soilbin.enlivenSlidingMap(figure);
  for (const svg of document.querySelectorAll('figure svg.heat')) soilbin.enlivenHeatMap(svg);
  for (const box of document.querySelectorAll('.choices')) soilbin.enlivenChoices(box);
  for (const host of document.querySelectorAll('.replay')) soilbin.startReplay(host);
  window.addEventListener('hashchange', soilbin.openTarget);
  window.addEventListener('beforeprint', () => { for (const fold of document.querySelectorAll('details.print')) fold.open = true; });
  soilbin.openTarget();
  document.documentElement.dataset.ready = 'yes';
};
soilbin.start();
