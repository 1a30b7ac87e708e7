// Sliders that pick one of several heat maps (heat_map.hpp): the drawing stays, its cells change.
'use strict';

soilbin.enlivenSlidingMap = function (figure) {
  const data = JSON.parse(figure.querySelector('script').textContent), svg = figure.querySelector('svg.heat');
  const cells = [...svg.querySelectorAll('.cell')], title = svg.querySelector('text'), ranges = [];
  const show = () => {
    const index = ranges.reduce((sum, range, i) => sum * data.sliders[i].settings.length + Number(range.value), 0);
    const map = data.maps[index];
    title.textContent = map.title;
    cells.forEach((cell, i) => {
      const [text, meaning, side, opacity, counts, value] = map.cells[i];
      const box = cell.querySelector('rect'), label = cell.querySelector('text');
      cell.dataset.tip = meaning;
      cell.dataset.value = value;
      cell.setAttribute('aria-label', meaning);
      cell.querySelector('title').textContent = meaning;
      box.setAttribute('class', `f ${side}`);
      box.setAttribute('fill-opacity', opacity);
      label.textContent = text;
      label.setAttribute('class', counts ? 'ink' : 'quiet');
      label.setAttribute('font-weight', counts ? 600 : 400);
    });
  };
  for (const slider of data.sliders) {
    const label = document.createElement('label'), range = document.createElement('input'), said = document.createElement('output');
    range.type = 'range';
    range.min = 0;
    range.max = slider.settings.length - 1;
    range.value = slider.first;
    const tell = () => { said.textContent = slider.settings[range.value]; };
    range.addEventListener('input', () => { tell(); show(); });
    tell();
    label.append(`${slider.name} `, range, said);
    figure.querySelector('.sliders').append(label);
    ranges.push(range);
  }
};
