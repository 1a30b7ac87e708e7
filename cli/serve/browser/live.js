// The live page: controls make a query of the flags of `soilbin estimate`, the server answers, charts follow. What differs from
// the start stands in the address behind '#', spelled like the query.
'use strict';

soilbin.make = function (tag, set = {}, ...inside) {
  const element = Object.assign(document.createElement(tag), set);
  element.append(...inside);
  return element;
};
soilbin.part = id => document.getElementById(id);
// '80N', '0.2 1/kPa'.
soilbin.quantity = (value, unit) => unit.startsWith('1') ? `${value} ${unit}` : value + unit;
soilbin.slipRanges = [['0%..100%', '0 to 100 %'], ['0%..40%', '0 to 40 %'], ['-100%..100%', '\u2212100 (braked) to 100 %']];

// Effects that a tire declares: the flag that leaves them out, and the number that tells them.
soilbin.leftOutBy = {lug_thrust: {flag: 'no-lugs', number: 'lug-height'},
                     tire_flexibility: {flag: 'rigid', number: 'inflation-pressure'}};

// Figures of charts, and the sheet of the answer that each shows.
soilbin.chartFigures = ['budget', 'curves', 'stresses'];

soilbin.Live = class {
  constructor(start) {
    this.start = start;
    this.charts = {budget: [], curves: [], stresses: []};
    this.numbers = new Map();
    this.lists = [];
    this.taken = new Map();  // effects that nobody named and the tire declares: id, 'id:form'
    this.state = new URLSearchParams(location.hash.slice(1));
    this.addControls();
    for (const [place, name, what] of [['ground', 'wheel', 'stresses'], ...soilbin.chartFigures.map(p => [p, p, p])])
      soilbin.addTakeAlong(soilbin.part(place), name, name, () => this.answer[what]);
    this.ask();
    window.addEventListener('hashchange', () => this.go(location.hash.slice(1)));
    soilbin.part('reset').addEventListener('click', () => this.go(''));
    soilbin.part('keep').addEventListener('click', event => this.keep(event.currentTarget));
    soilbin.part('copy').addEventListener('click', event =>
      soilbin.copyText(soilbin.part('command').textContent, event.currentTarget));
    soilbin.part('save-png').addEventListener('click', async () =>
      soilbin.saveFile('soilbin.png', await soilbin.pngOf(soilbin.figureSvg(document.querySelector('.results'))), 'image/png'));
  }

  go(query) {
    this.state = new URLSearchParams(query);
    this.showEffects();
    this.showLists();
    this.ask();
  }

  // A flag that says what the start says is left out.
  set(key, text, start) {
    if (text === start) this.state.delete(key);
    else this.state.set(key, text);
    this.ask();
  }

  addControls() {
    const form = document.querySelector('.live-page form'), {make} = soilbin, wide = window.innerWidth > 820;
    const group = (title, open, ...inside) => make('details', {open}, make('summary', {textContent: title}), ...inside);
    const list = (title, options, key, start, changed = () => {}) => {
      const select = make('select');
      for (const [value, text] of options) select.add(new Option(text, value));
      select.addEventListener('change', () => { changed(); this.set(key, select.value, start); });
      this.lists.push([select, key, start]);
      return make('label', {className: 'chooser'}, title + ' ', select);
    };
    // Of a shelf of the library; what was changed of the one before goes with it.
    const preset = (title, key, own, names) => list(title, [['', `${own} (start)`]].concat(names.map(n => [n, n])), key, '', () => {
      for (const {key: number, group: of} of this.start.numbers) if (of === key) this.state.delete(number);
    });
    const models = this.start.models.map(({name, title}) => [name, title]);
    const beside = (title, key, names) => list(title, [['', 'none']].concat(names.map(n => [n, n])), key, '');
    const numbers = of => this.start.numbers.filter(n => n.group === of).map(n => this.addNumber(n));
    form.addEventListener('submit', event => event.preventDefault());
    form.replaceChildren(
      list('Model', models, 'model', this.start.model, () => { this.state.delete('effect'); }),
      group('Condition', true, ...numbers('condition')),
      group('Wheel', wide, preset('Tire', 'tire', this.start.tire_name, this.start.tires), ...numbers('tire')),
      group('Soil', wide, preset('Soil', 'soil', this.start.soil, this.start.soils), ...numbers('soil')),
      group('Beside it', wide, beside('A second soil', 'beside-soil', this.start.soils),
            beside('A second tire', 'beside-tire', this.start.tires),
            list('A second model', [['', 'none'], ...models], 'beside-model', '')),
      this.effects = make('details', {open: false}, make('summary'), ...this.start.effects.map(effect => this.addEffect(effect))),
      group('Curves', wide, list('Slip from', soilbin.slipRanges, 'slips', soilbin.slipRanges[0][0])));
    this.showEffects();
    this.showLists();
  }

  // `number.value` and `number.sd` are what stands there while no flag says otherwise.
  addNumber(number) {
    const says = () => number.value === null ? '' : number.sd === undefined ? number.value + number.unit
      : `${number.value}+-${number.sd}${number.unit}`;
    const control = this.control(`number-${number.key}`, number, text => this.set(number.key, text || says(), says()));
    control.number = number;
    this.numbers.set(number.key, control);
    return control.element;
  }

  // A slider and a box for one number; the box takes what the slider can't reach. A soil's value has a second box for its
  // standard deviation. A number that the tire doesn't declare has an empty box, and emptying the box takes it back.
  control(id, {lower, upper, step, unit, title, meaning, value, sd}, changed) {
    const {make} = soilbin, doubtful = sd !== undefined;
    const slider = make('input', {type: 'range', min: lower, max: upper, step, title: meaning});
    const box = make('input', {type: 'number', id, step: 'any', title: meaning, placeholder: value === null ? 'none' : ''});
    const deviation = doubtful ? make('input', {type: 'number', step: 'any', min: 0, title: 'one standard deviation'}) : null;
    slider.setAttribute('aria-label', meaning.length < 40 ? meaning : title);
    if (doubtful) deviation.setAttribute('aria-label', `Standard deviation of ${title}`);
    const moved = (from, to) => {
      if (from.value === '') return value === null ? changed('') : this.complain(`${title}: a number is missing`, 'the last one holds until there is another');
      to.value = from.value;
      slider.setAttribute('aria-valuetext', `${from.value} ${unit}`);
      changed(doubtful ? `${box.value}+-${deviation.value || 0}${unit}` : soilbin.quantity(from.value, unit));
    };
    slider.addEventListener('input', () => moved(slider, box));
    box.addEventListener('input', () => moved(box, slider));
    if (doubtful) deviation.addEventListener('input', () => moved(box, slider));
    const element = make('div', {className: doubtful ? 'number doubtful' : 'number'},
                         make('label', {htmlFor: id, textContent: title, title: meaning}), box,
                         ...(doubtful ? [deviation] : []),
                         make('span', {textContent: doubtful ? `\u00b1 one standard deviation${unit && ', '}${unit}` : unit}), slider);
    const control = {slider, box, deviation, unit, element};
    this.showNumber(control, value, sd);
    return control;
  }

  addEffect(effect) {
    const {make} = soilbin, box = make('input', {type: 'checkbox'}), forms = make('select'), note = make('small');
    const parameters = make('div', {className: 'parameters'});
    for (const {form} of effect.forms) forms.add(new Option(form, form));
    forms.setAttribute('aria-label', `Variant of ${effect.id}`);
    box.addEventListener('change', () => this.tickEffect(effect, box.checked));
    forms.addEventListener('change', () => this.switchEffect(effect, `${effect.id}:${forms.value}`));
    // Where no word names it, the tire as it declares itself may have it.
    effect.show = named => {
      const taken = !named && this.taken.get(effect.id), word = named || taken;
      const name = word && word.split(',')[0].split(':')[1] || effect.forms[0].form;
      const form = effect.forms.find(f => f.form === name) || {parameters: []};
      box.checked = Boolean(word);
      forms.value = name;
      forms.hidden = !word || effect.forms.length < 2;
      note.textContent = [taken ? 'As the tire declares.' : '', word && form.equation || ''].filter(Boolean).join(' ');
      this.showParameters(effect, parameters, word ? form : {parameters: []});
    };
    const name = effect.id.replaceAll('_', ' ') + (effect.of === 'measurement' ? ' (of the measurement)' : '');
    return make('div', {className: 'effect'}, make('label', {}, box, name), forms, note, parameters);
  }

  // Controls for a form's parameters; they stay while the form does, so that a slider that is being moved isn't replaced.
  showParameters(effect, host, form) {
    if (host.dataset.form === String(form.form)) return;
    host.dataset.form = form.form;
    effect.controls = new Map(form.parameters.map(p => {
      const spell = text => this.switchEffect(effect, this.spelled(effect, form, p.key, text));
      return [p.key, this.control(`${effect.id}-${p.key}`, p, spell)];
    }));
    host.replaceChildren(...[...effect.controls.values()].map(control => control.element));
  }

  // 'slip_sinkage:lyasko,a=0.5': what is at its default is left out.
  spelled(effect, form, key, text) {
    const spelled = form.parameters.map(p => {
      const {box, unit} = effect.controls.get(p.key);
      return [p, p.key === key ? text : soilbin.quantity(box.value, unit)];
    }).filter(([p, value]) => value !== soilbin.quantity(p.value, p.unit));
    return [`${effect.id}:${form.form}`, ...spelled.map(([p, value]) => `${p.key}=${value}`)].join();
  }

  startEffects() { return this.start.effects.filter(e => e.on).map(e => e.on); }
  effectWords() {
    return this.state.has('effect') ? this.state.getAll('effect').filter(word => word !== 'none') : this.startEffects();
  }
  wordOf(effect) { return this.effectWords().find(word => word.split(/[:,]/)[0] === effect.id); }
  showEffects() {
    this.effects.hidden = (this.state.get('model') || this.start.model) !== 'bekker_wong';
    for (const effect of this.start.effects) effect.show(this.wordOf(effect));
    for (const {key, effects} of this.start.numbers)
      if (effects) this.numbers.get(key).element.hidden = !effects.some(id => this.wordOf({id}));
    const on = this.effectWords().length + this.taken.size;
    this.effects.firstChild.textContent = on ? `Effects (${on} on)` : 'Effects';
  }
  showLists() { for (const [select, key, start] of this.lists) select.value = this.state.get(key) || start; }

  // What a tire declares comes back where it is only not named: a flag leaves it out.
  tickEffect(effect, on) {
    const {flag, number} = soilbin.leftOutBy[effect.id] || {};
    const declared = flag && Number(this.numbers.get(number).box.value) > 0;
    if (flag && on && this.state.has(flag)) {
      this.state.delete(flag);
      return this.ask();
    }
    if (declared && !on) this.state.set(flag, 'true');
    this.switchEffect(effect, on ? effect.on || effect.id : null);
  }

  switchEffect(effect, word) {
    const words = this.effectWords().filter(w => w.split(/[:,]/)[0] !== effect.id);
    if (word) words.push(word);
    this.state.delete('effect');
    if ([...words].sort().join() !== this.startEffects().sort().join())
      for (const w of words.length ? words : ['none']) this.state.append('effect', w);
    this.showEffects();
    this.ask();
  }

  // One request at a time: what changed meanwhile is asked at once afterwards.
  async ask() {
    this.waiting = true;
    if (this.asking) return;
    this.asking = true;
    while (this.waiting) {
      this.waiting = false;
      try {
        const began = performance.now(), response = await fetch(`estimate?${this.state}`), answer = await response.json();
        this.show(answer);
        document.documentElement.dataset.milliseconds = (performance.now() - began).toFixed(1);
      } catch (error) {
        this.complain('the server does not answer', 'it may have been stopped: start soilbin serve again, then reload');
      }
    }
    this.asking = false;
    document.documentElement.dataset.asked = String(this.state);
    clearTimeout(this.quiet);
    this.quiet = setTimeout(() => this.settle(), 500);
  }

  // Once nothing has moved for a while: address and reading aloud.
  settle() {
    const hash = String(this.state);
    if (location.hash.slice(1) !== hash) history.replaceState(null, '', hash ? `#${hash}` : location.pathname);
    const said = [...document.querySelectorAll('#now div')].map(d => d.dataset.said).join('; ');
    soilbin.part('spoken').textContent = this.refused ? '' : said;
  }

  // The words are the command's: its flags are this page's controls.
  complain(error, hint) {
    const say = soilbin.part('say'), here = text => text && text.replace(/--([a-z0-9-]+)/g, (flag, key) =>
      this.numbers.has(key) ? `\u2018${this.numbers.get(key).number.title}\u2019` : flag);
    [error, hint] = [here(error), here(hint)];
    say.hidden = !error;
    say.replaceChildren(...(error ? [soilbin.make('p', {textContent: error})] : []),
                        ...(error && hint ? [soilbin.make('p', {textContent: `Hint: ${hint}`})] : []));
  }

  // A refusal has no curves, or none with a point: those of the last answer stay.
  show(answer) {
    this.refused = Boolean(answer.error);
    const second = answer.beside && answer.beside.error ? `${answer.beside.label}: ${answer.beside.error}` : '';
    this.complain(answer.error || second || (answer.warnings || []).join('; '), answer.hint || (second && answer.beside.hint));
    if (answer.carried_load) this.offerLoad(answer.carried_load);
    const drawn = answer.curves && answer.curves.plots.some(plot => plot.series.some(s => s.y.some(y => y !== null)));
    document.querySelector('.results').classList.toggle('stale', !drawn);
    if (!answer.curves) return;
    document.title = document.querySelector('h1').textContent = answer.title;
    const keeps = !drawn && this.answer;
    if (!keeps) soilbin.part('chosen').textContent = answer.in_words + (answer.beside ? `; beside it ${answer.beside.in_words}` : '');
    soilbin.part('errors').textContent = answer.errors_in_words;
    soilbin.part('command').textContent = answer.command + (answer.beside ? `\n${answer.beside.command}` : '');
    for (const [id, target] of [['save-case', 'case.yaml'], ['save-csv', 'curves.csv']]) soilbin.part(id).href = `${target}?${this.state}`;
    soilbin.part('save-csv-comma').href = `curves.csv?decimal-comma=true&${this.state}`;
    if (!keeps) this.showReadings(answer.readings, answer.beside);
    for (const {key, value, sd} of answer.numbers) {
      const control = this.numbers.get(key);
      if (!control) continue;
      if (!this.state.has(key)) Object.assign(control.number, {value, sd});
      this.showNumber(control, value, sd);
    }
    this.taken = new Map(answer.effects.filter(({id}) => !this.wordOf({id})).map(({id, form}) => [id, `${id}:${form}`]));
    this.showEffects();
    for (const {id, parameters} of answer.effects) {
      const {controls} = this.start.effects.find(effect => effect.id === id);
      for (const {key, value} of parameters) if (controls.has(key)) this.showNumber(controls.get(key), value);
    }
    if (keeps) return;
    this.answer = answer;
    this.draw();
  }

  // A load that the soil carries, in place of one that it does not: a little below the largest.
  offerLoad(newton) {
    const {box, unit} = this.numbers.get('load');
    const load = Number((0.98 * newton).toPrecision(3));
    const button = soilbin.make('button', {type: 'button', id: 'carried', textContent: `Set the load to ${soilbin.formatForce(load)}`});
    button.addEventListener('click', () => {
      box.value = unit === 'kN' ? load / 1000 : load;
      box.dispatchEvent(new Event('input'));
    });
    soilbin.part('say').append(button);
  }

  showNumber({slider, box, deviation, unit}, value, sd) {
    if ([slider, box, deviation].includes(document.activeElement)) return;
    if (deviation) deviation.value = Number(sd.toPrecision(6));
    if (value === null) { box.value = ''; return; }
    slider.value = box.value = Number(value.toPrecision(6));
    slider.setAttribute('aria-valuetext', `${box.value} ${unit}`);
  }

  showReadings(readings, beside) {
    const {make, part} = soilbin, text = ({value, unit}) => unit ? `${value} ${unit}` : 'none';
    const tiles = readings.findIndex(reading => reading.name === 'Contact');
    const second = ({name}) => beside && beside.readings.find(reading => reading.name === name);
    const tile = reading => {
      const one = make('div', {}, make('b', {textContent: text(reading)}), make('span', {textContent: reading.name}));
      one.dataset.said = `${reading.name} ${reading.value} ${reading.unit}`;
      if (!reading.unit) one.title = reading.value;
      if (second(reading)) one.append(make('small', {textContent: `${beside.label}: ${text(second(reading))}`}));
      return one;
    };
    part('now').replaceChildren(...readings.slice(0, tiles).map(tile));
    part('sentences').replaceChildren(...readings.slice(tiles).map(r => make('p', {}, make('b', {textContent: `${r.name} `}), r.value)));
  }

  draw() {
    const wheels = this.answer.wheels.filter(wheel => wheel);
    soilbin.part('ground').hidden = !wheels.length;
    soilbin.part('ground').querySelector('.panels').replaceChildren(...wheels.map(soilbin.drawWheel));
    if (typeof d3 === 'undefined') return;
    for (const place of soilbin.chartFigures) {
      const plots = this.answer[place].plots.filter(p => place !== 'budget' || p.series.some(s => s.y.some(y => y !== null)));
      const charts = this.charts[place], figure = soilbin.part(place);
      const host = figure.querySelector('.panels');
      figure.hidden = !plots.length;
      while (charts.length > plots.length) charts.pop().host.remove();
      plots.forEach((plot, i) => {
        const all = {...plot, series: [...this.keptSeries(place, i), ...plot.series]};
        if (charts[i]) charts[i].replot(all);
        else charts.push(new soilbin.Chart(host.appendChild(soilbin.make('div')), all, new Set()));
      });
      this.showLegend(figure, charts.map(chart => chart.plot));
    }
  }

  // The kept curves, dashed; the budget piles up and has no room for a second one.
  keptSeries(place, i) {
    const kept = this.kept && place !== 'budget' ? this.kept[place].plots[i] : null;
    return kept ? kept.series.filter(s => !s.label.endsWith('this point'))
      .map(s => ({...s, label: s.label ? `kept, ${s.label}` : 'kept', error: [], dash: 1, color: s.color === 'c0' ? 'c3' : 'c4'})) : [];
  }

  showLegend(figure, plots) {
    const entries = new Map();
    for (const plot of plots) for (const s of plot.series) if (s.label && !s.label.endsWith('this point')) entries.set(s.label, s);
    const swatch = ({color, base, dash}) => soilbin.svgOf('svg', {viewBox: '0 0 26 12', width: 26, height: 12, 'aria-hidden': 'true'},
      base.length ? soilbin.svgOf('circle', {class: `f ${color}`, cx: 13, cy: 6, r: 5})
        : soilbin.svgOf('line', {class: `s ${color}`, 'stroke-width': 2, x1: 1, x2: 25, y1: 6, y2: 6, 'stroke-dasharray': soilbin.dashes[dash % 4] || 'none'}));
    const list = figure.querySelector('.legend');
    if (list.dataset.shows === [...entries.keys()].join()) return;
    list.dataset.shows = [...entries.keys()].join();
    list.replaceChildren(...[...entries].map(([label, series]) => soilbin.make('li', {}, swatch(series), label)));
  }

  keep(button) {
    this.kept = this.kept ? null : this.answer;
    button.setAttribute('aria-pressed', String(Boolean(this.kept)));
    button.textContent = this.kept ? 'Let go of the kept curves (dashed)' : 'Keep these curves to compare';
    this.draw();
  }
};

fetch('case').then(response => response.json()).then(start => {
  soilbin.live = new soilbin.Live(start);
});
