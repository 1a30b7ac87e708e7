// Starts what the page holds.
'use strict';

soilbin.start = function () {
  const data = document.getElementById('figures'), sheets = data ? JSON.parse(data.textContent) : {};
  if (typeof d3 !== 'undefined')
    for (const [id, sheet] of Object.entries(sheets)) soilbin.enlivenFigure(document.getElementById(id), sheet);
  for (const figure of document.querySelectorAll('figure'))
    if (figure.querySelector('svg') && !figure.querySelector('.replay'))
      soilbin.addTakeAlong(figure, figure.id || 'figure', sheets[figure.id] && sheets[figure.id].title || 'this figure',
                           sheets[figure.id] && (() => sheets[figure.id]));
  for (const figure of document.querySelectorAll('.sliding-map')) soilbin.enlivenSlidingMap(figure);
  for (const svg of document.querySelectorAll('svg.heat')) soilbin.enlivenHeatMap(svg);
  for (const box of document.querySelectorAll('.choices')) soilbin.enlivenChoices(box);
  for (const host of document.querySelectorAll('.replay')) soilbin.startReplay(host);
  window.addEventListener('hashchange', soilbin.openTarget);
  window.addEventListener('beforeprint', () => { for (const fold of document.querySelectorAll('details.print')) fold.open = true; });
  soilbin.openTarget();
  document.documentElement.dataset.ready = 'yes';
};
soilbin.start();
