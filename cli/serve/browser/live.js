// The live page: controls make a query of the flags of `soilbin estimate`, the server answers, charts follow. What differs from
// the start stands in the address behind '#', spelled like the query.
'use strict';

soilbin.make = function (tag, set = {}, ...inside) {
  const element = Object.assign(document.createElement(tag), set);
  element.append(...inside);
  return element;
};
soilbin.part = id => document.getElementById(id);
soilbin.slipRanges = [['0%..100%', '0 to 100 %'], ['0%..40%', '0 to 40 %'], ['-100%..100%', '\u2212100 (braked) to 100 %']];

soilbin.Live = class {
  constructor(start) {
    this.start = start;
    this.charts = {curves: [], stresses: []};
    this.numbers = new Map();
    this.state = new URLSearchParams(location.hash.slice(1));
    this.addControls();
    this.ask();
    window.addEventListener('hashchange', () => this.go(location.hash.slice(1)));
    soilbin.part('reset').addEventListener('click', () => this.go(''));
    soilbin.part('keep').addEventListener('click', event => this.keep(event.currentTarget));
    soilbin.part('copy').addEventListener('click', () => this.copy());
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
    const form = document.querySelector('.live-page form'), {make} = soilbin;
    const group = (title, ...inside) => make('fieldset', {}, make('legend', {textContent: title}), ...inside);
    const list = (title, options, key, start) => {
      const select = make('select');
      for (const [value, text] of options) select.add(new Option(text, value));
      select.addEventListener('change', () => this.set(key, select.value, start));
      (this.lists = this.lists || []).push([select, key, start]);
      return make('label', {className: 'chooser'}, title + ' ', select);
    };
    const soils = [['', `${this.start.soil} (start)`]].concat(
      this.start.soils.filter(name => name !== this.start.soil).map(name => [name, name]));
    form.addEventListener('submit', event => event.preventDefault());
    form.replaceChildren(
      group('Condition', list('Soil', soils, 'soil', ''), ...this.start.numbers.map(n => this.addNumber(n))),
      this.effects = make('details', {open: window.innerWidth > 820}, make('summary'),
                          ...this.start.effects.map(effect => this.addEffect(effect))),
      group('Curves', list('Slip from', soilbin.slipRanges, 'slips', soilbin.slipRanges[0][0])));
    this.showEffects();
    this.showLists();
  }

  addNumber(number) {
    const control = this.control(`number-${number.key}`, number, text => this.set(number.key, text, number.value + number.unit));
    this.numbers.set(number.key, control);
    return control.element;
  }

  // A slider and a box for one number; the box takes what the slider can't reach.
  control(id, {lower, upper, step, unit, title, meaning, value}, changed) {
    const {make} = soilbin;
    const slider = make('input', {type: 'range', min: lower, max: upper, step, title: meaning});
    const box = make('input', {type: 'number', id, step: 'any', title: meaning});
    slider.setAttribute('aria-label', meaning.length < 40 ? meaning : title);
    const moved = (from, to) => {
      if (from.value === '') return;
      to.value = from.value;
      slider.setAttribute('aria-valuetext', `${from.value} ${unit}`);
      changed(from.value + unit);
    };
    slider.addEventListener('input', () => moved(slider, box));
    box.addEventListener('input', () => moved(box, slider));
    const element = make('div', {className: 'number'}, make('label', {htmlFor: id, textContent: title, title: meaning}), box,
                         make('span', {textContent: unit}), slider);
    const control = {slider, box, unit, element};
    this.showNumber(control, value);
    return control;
  }

  addEffect(effect) {
    const {make} = soilbin, box = make('input', {type: 'checkbox'}), forms = make('select'), note = make('small');
    const parameters = make('div', {className: 'parameters'});
    for (const {form} of effect.forms) forms.add(new Option(form, form));
    forms.setAttribute('aria-label', `Form of ${effect.id}`);
    box.addEventListener('change', () => this.switchEffect(effect, box.checked ? effect.on || effect.id : null));
    forms.addEventListener('change', () => this.switchEffect(effect, `${effect.id}:${forms.value}`));
    effect.show = word => {
      const name = word && word.split(',')[0].split(':')[1] || effect.forms[0].form;
      const form = effect.forms.find(f => f.form === name) || {parameters: []};
      box.checked = Boolean(word);
      forms.value = name;
      forms.hidden = !word || effect.forms.length < 2;
      note.textContent = word && form.equation || '';
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
      return [p, p.key === key ? text : box.value + unit];
    }).filter(([p, value]) => value !== p.value + p.unit);
    return [`${effect.id}:${form.form}`, ...spelled.map(([p, value]) => `${p.key}=${value}`)].join();
  }

  startEffects() { return this.start.effects.filter(e => e.on).map(e => e.on); }
  effectWords() {
    return this.state.has('effect') ? this.state.getAll('effect').filter(word => word !== 'none') : this.startEffects();
  }
  wordOf(effect) { return this.effectWords().find(word => word.split(/[:,]/)[0] === effect.id); }
  showEffects() {
    for (const effect of this.start.effects) effect.show(this.wordOf(effect));
    for (const {key, effects} of this.start.numbers)
      if (effects) this.numbers.get(key).element.hidden = !effects.some(id => this.wordOf({id}));
    const on = this.effectWords().length;
    this.effects.firstChild.textContent = on ? `Effects (${on} on)` : 'Effects';
  }
  showLists() { for (const [select, key, start] of this.lists) select.value = this.state.get(key) || start; }

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

  complain(error, hint) {
    const say = soilbin.part('say');
    say.hidden = !error;
    say.replaceChildren(...(error ? [soilbin.make('p', {textContent: error})] : []),
                        ...(error && hint ? [soilbin.make('p', {textContent: `Hint: ${hint}`})] : []));
  }

  // A refusal has no curves: those of the last answer stay.
  show(answer) {
    this.refused = Boolean(answer.error);
    this.complain(answer.error || (answer.warnings || []).join('; '), answer.hint);
    document.querySelector('.results').classList.toggle('stale', !answer.curves);
    if (!answer.curves) return;
    soilbin.part('chosen').textContent = answer.in_words;
    soilbin.part('command').textContent = answer.command;
    this.showReadings(answer.readings);
    for (const {key, value} of answer.numbers) this.showNumber(this.numbers.get(key), value);
    for (const {id, parameters} of answer.effects) {
      const {controls} = this.start.effects.find(effect => effect.id === id);
      for (const {key, value} of parameters) if (controls.has(key)) this.showNumber(controls.get(key), value);
    }
    this.answer = answer;
    this.draw();
  }

  showNumber({slider, box, unit}, value) {
    if (document.activeElement === slider || document.activeElement === box) return;
    slider.value = box.value = Number(value.toPrecision(6));
    slider.setAttribute('aria-valuetext', `${box.value} ${unit}`);
  }

  showReadings(readings) {
    const {make, part} = soilbin, tile = ({name, value, unit}) => {
      const one = make('div', {}, make('b', {textContent: unit ? `${value} ${unit}` : 'none'}), make('span', {textContent: name}));
      one.dataset.said = `${name} ${value} ${unit}`;
      if (!unit) one.title = value;
      return one;
    };
    part('now').replaceChildren(...readings.slice(0, 5).map(tile));
    part('sentences').replaceChildren(...readings.slice(5).map(r => make('p', {}, make('b', {textContent: `${r.name} `}), r.value)));
  }

  draw() {
    if (typeof d3 === 'undefined') return;
    for (const place of ['curves', 'stresses']) {
      const plots = this.answer[place].plots, charts = this.charts[place], host = soilbin.part(place);
      host.closest('figure').hidden = !plots.length;
      plots.forEach((plot, i) => {
        const kept = this.kept ? this.kept[place].plots[i] : null;
        const old = kept ? kept.series.filter(s => s.label !== 'this point')
          .map(s => ({...s, label: 'kept', error: [], dash: 1, color: 'c2'})) : [];
        const all = {...plot, series: [...old, ...plot.series]};
        if (charts[i]) charts[i].replot(all);
        else charts.push(new soilbin.Chart(host.appendChild(soilbin.make('div')), all, new Set()));
      });
    }
  }

  keep(button) {
    this.kept = this.kept ? null : this.answer;
    button.setAttribute('aria-pressed', String(Boolean(this.kept)));
    button.textContent = this.kept ? 'Let go of the kept curves (dashed)' : 'Keep these curves to compare';
    this.draw();
  }

  async copy() {
    await navigator.clipboard.writeText(soilbin.part('command').textContent);
    soilbin.part('spoken').textContent = soilbin.part('copy').textContent = 'Copied';
    setTimeout(() => { soilbin.part('copy').textContent = 'Copy the command'; }, 1500);
  }
};

fetch('case').then(response => response.json()).then(start => {
  soilbin.live = new soilbin.Live(start);
});
