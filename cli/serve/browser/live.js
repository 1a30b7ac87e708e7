// What every live page has: controls make a query of a command's flags, the server answers, numbers and charts follow. What
// differs from the start stands in the address behind '#', spelled like the query. A page of its own extends LivePage.
'use strict';

soilbin.make = function (tag, set = {}, ...inside) {
  const element = Object.assign(document.createElement(tag), set);
  element.append(...inside);
  return element;
};
soilbin.part = id => document.getElementById(id);
soilbin.spaced = id => id.replaceAll('_', ' ');
// '80N', '0.2 1/kPa'.
soilbin.quantity = (value, unit) => unit.startsWith('1') ? `${value} ${unit}` : value + unit;

// Flags that leave out what a tire declares, by the effect that it takes.
soilbin.leftOutBy = {lug_thrust: 'no-lugs', tire_flexibility: 'rigid'};

// A page says:
//   asks                 what of the server answers a query: 'estimate'
//   drawing              what the figure #ground shows: 'wheel'
//   chartFigures         its figures of charts, each named as the sheet of the answer that it shows
//   saves                links to what the server saves, by their ids: ['save-csv', 'curves.csv?']
//   controls()           the elements of the form
//   tell(answer)         words and numbers of an answer
//   data()               the sheet that goes with the drawing #ground
// and may say more by what is called below.
soilbin.LivePage = class {
  constructor(start, {asks, drawing, chartFigures, saves}) {
    Object.assign(this, {start, asks, chartFigures, saves});
    this.charts = Object.fromEntries(chartFigures.map(place => [place, []]));
    this.numbers = new Map();
    this.lists = [];
    this.taken = new Map();  // effects that nobody named and a tire declares: id, 'id:form'
    this.state = new URLSearchParams(location.hash.slice(1));
    const form = document.querySelector('.live-page form');
    form.addEventListener('submit', event => event.preventDefault());
    form.replaceChildren(...this.controls());
    this.showControls();
    soilbin.addTakeAlong(soilbin.part('ground'), drawing, drawing, () => this.data());
    for (const place of chartFigures) soilbin.addTakeAlong(soilbin.part(place), place, place, () => this.answer[place]);
    this.ask();
    window.addEventListener('hashchange', () => this.go(location.hash.slice(1)));
    soilbin.part('reset').addEventListener('click', () => this.go(''));
    soilbin.part('keep').addEventListener('click', event => this.keep(event.currentTarget));
    soilbin.part('copy').addEventListener('click', event =>
      soilbin.copyText(soilbin.part('command').textContent, event.currentTarget));
    soilbin.part('save-png').addEventListener('click', async () =>
      soilbin.saveFile('soilbin.png', await soilbin.pngOf(soilbin.figureSvg(document.querySelector('.results'))), 'image/png'));
  }

  // Controls as the state has them.
  showControls() {
    this.showEffects();
    this.showLists();
  }

  go(query) {
    this.state = new URLSearchParams(query);
    this.showControls();
    this.ask();
  }

  // A flag that says what the start says is left out.
  set(key, text, start) {
    if (text === start) this.state.delete(key);
    else this.state.set(key, text);
    this.ask();
  }

  group(title, open, ...inside) {
    return soilbin.make('details', {open}, soilbin.make('summary', {textContent: title}), ...inside);
  }

  list(title, options, key, start, changed = () => {}) {
    const select = soilbin.make('select');
    for (const [value, text] of options) select.add(new Option(text, value));
    select.addEventListener('change', () => { changed(); this.set(key, select.value, start); });
    this.lists.push([select, key, start]);
    return soilbin.make('label', {className: 'chooser'}, title + ' ', select);
  }

  // Of a shelf of the library; what was changed of the one before goes with it.
  preset(title, key, own, names) {
    return this.list(title, [['', `${own} (start)`]].concat(names.map(n => [n, n])), key, '', () => {
      for (const {key: number, group: of} of this.start.numbers) if (of === key) this.state.delete(number);
    });
  }

  numbersOf(group) { return this.start.numbers.filter(n => n.group === group).map(n => this.addNumber(n)); }

  effectsGroup() {
    return this.effects = soilbin.make('details', {open: false}, soilbin.make('summary'),
                                       ...this.start.effects.map(effect => this.addEffect(effect)));
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
    const name = soilbin.spaced(effect.id) + (effect.of === 'measurement' ? ' (of the measurement)' : '');
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
    return this.state.has('effect') ? this.state.getAll('effect').filter(word => word !== 'none' && word !== 'declared')
      : this.startEffects();
  }
  takesEffects() { return true; }
  // Whether a tire declares what an effect is about.
  declares(effect) { return this.taken.has(effect.id); }
  wordOf(effect) { return this.effectWords().find(word => word.split(/[:,]/)[0] === effect.id); }
  showEffects() {
    this.effects.hidden = !this.takesEffects();
    for (const effect of this.start.effects) effect.show(this.wordOf(effect));
    for (const {key, effects} of this.start.numbers)
      if (effects) this.numbers.get(key).element.hidden = !effects.some(id => this.wordOf({id}));
    const on = [...this.effectWords().map(word => word.split(/[:,]/)[0]), ...this.taken.keys()];
    this.effects.firstChild.textContent = on.length ? `Effects on: ${on.map(soilbin.spaced).join(', ')}` : 'Effects: none';
  }
  showLists() { for (const [select, key, start] of this.lists) select.value = this.state.get(key) || start; }

  // What a tire declares comes back where it is only not named: a flag leaves it out.
  tickEffect(effect, on) {
    const flag = soilbin.leftOutBy[effect.id], declared = flag && this.declares(effect);
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
      for (const w of words.length ? words : ['declared']) this.state.append('effect', w);
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
        const began = performance.now(), response = await fetch(`${this.asks}?${this.state}`), answer = await response.json();
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

  // The words are the command's: its flags are this page's controls. Several doubts are folded.
  complain(error, hint, doubts = []) {
    const {make} = soilbin, say = soilbin.part('say'), folded = say.querySelector('details'), here = text => text && text.replace(/--([a-z0-9-]+)/g, (flag, key) =>
      this.numbers.has(key) ? `\u2018${this.numbers.get(key).number.title}\u2019` : flag);
    say.hidden = !error && !doubts.length;
    const lines = [error, error && hint && `Hint: ${hint}`, doubts.length === 1 && doubts[0]].filter(Boolean);
    say.replaceChildren(...lines.map(line => make('p', {textContent: here(line)})),
                        ...(doubts.length > 1 ? [make('details', {open: Boolean(folded && folded.open)},
                                                      make('summary', {textContent: `${doubts.length} warnings`}),
                                                      make('ul', {}, ...doubts.map(doubt => make('li', {textContent: here(doubt)}))))]
                                              : []));
  }

  // What is wrong, or doubtful, in an answer.
  say(answer) { this.complain(answer.error, answer.hint, answer.error ? [] : answer.warnings); }
  // Whether there is something in an answer to draw in the place of the last one.
  isDrawn(answer) { return Boolean(answer.curves); }
  commandOf(answer) { return answer.command; }

  // A refusal has no curves, or none with a point: those of the last answer stay.
  show(answer) {
    this.refused = Boolean(answer.error);
    this.say(answer);
    const drawn = this.isDrawn(answer), keeps = !drawn && this.answer;
    document.querySelector('.results').classList.toggle('stale', !drawn);
    if (!answer.curves) return;
    document.title = document.querySelector('h1').textContent = answer.title;
    soilbin.part('command').textContent = this.commandOf(answer);
    for (const [id, target] of this.saves) soilbin.part(id).href = target + this.state;
    if (!keeps) this.tell(answer);
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

  showNumber({slider, box, deviation, unit}, value, sd) {
    if ([slider, box, deviation].includes(document.activeElement)) return;
    if (deviation) deviation.value = Number(sd.toPrecision(6));
    if (value === null) { box.value = ''; return; }
    slider.value = box.value = Number(value.toPrecision(6));
    slider.setAttribute('aria-valuetext', `${box.value} ${unit}`);
  }

  // A number in large print; `said` is what is read aloud of it.
  tile(text, name, said) {
    const tile = soilbin.make('div', {}, soilbin.make('b', {textContent: text}), soilbin.make('span', {textContent: name}));
    tile.dataset.said = said;
    return tile;
  }

  // The panels of a figure that are drawn.
  plotsOf(place) { return this.answer[place].plots; }

  draw() {
    for (const place of this.chartFigures)
      this.drawCharts(place, this.charts[place], this.plotsOf(place), i => this.keptSeries(place, i));
  }

  // The charts of a figure, as many as there are plots; `kept(i)`: series that are drawn before those of a plot.
  drawCharts(place, charts, plots, kept = () => []) {
    const figure = soilbin.part(place), host = figure.querySelector('.panels');
    if (typeof d3 === 'undefined') return;
    figure.hidden = !plots.length;
    while (charts.length > plots.length) charts.pop().host.remove();
    plots.forEach((plot, i) => {
      const all = {...plot, series: [...kept(i), ...plot.series]};
      if (charts[i]) charts[i].replot(all);
      else charts.push(new soilbin.Chart(host.appendChild(soilbin.make('div')), all, new Set()));
    });
    this.showLegend(figure, charts.map(chart => chart.plot));
  }

  // The kept curves, dashed.
  keptSeries(place, i) {
    const kept = this.kept ? this.kept[place].plots[i] : null;
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
