// The live page of a wheel: what `soilbin estimate` answers.
'use strict';

soilbin.slipRanges = [['0%..100%', '0 to 100 %'], ['0%..40%', '0 to 40 %'], ['-100%..100%', '\u2212100 (braked) to 100 %']];
// The number by which a tire declares what an effect is about.
soilbin.declaredBy = {lug_thrust: 'lug-height', tire_flexibility: 'inflation-pressure'};

soilbin.WheelPage = class extends soilbin.LivePage {
  constructor(start) {
    super(start, {asks: 'estimate', drawing: 'wheel', chartFigures: ['budget', 'curves', 'stresses'],
                  saves: [['save-case', 'case.yaml?'], ['save-csv', 'curves.csv?'], ['save-csv-comma', 'curves.csv?decimal-comma=true&']]});
  }

  data() { return this.answer.stresses; }

  controls() {
    const {start} = this, wide = window.innerWidth > 820, models = start.models.map(({name, title}) => [name, title]);
    const beside = (title, key, names) => this.list(title, [['', 'none']].concat(names.map(n => [n, n])), key, '');
    return [
      this.list('Model', models, 'model', start.model, () => { this.state.delete('effect'); }),
      this.group('Condition', true, ...this.numbersOf('condition')),
      this.effectsGroup(),
      this.group('Wheel', wide, this.preset('Tire', 'tire', start.tire_name, start.tires), ...this.numbersOf('tire')),
      this.group('Soil', wide, this.preset('Soil', 'soil', start.soil, start.soils), ...this.numbersOf('soil')),
      this.group('Beside it', wide, beside('A second soil', 'beside-soil', start.soils), beside('A second tire', 'beside-tire', start.tires),
                 this.list('A second model', [['', 'none'], ...models], 'beside-model', '')),
      this.group('Curves', wide, this.list('Slip from', soilbin.slipRanges, 'slips', soilbin.slipRanges[0][0]))];
  }

  takesEffects() { return (this.state.get('model') || this.start.model) === 'bekker_wong'; }
  declares(effect) { return Number(this.numbers.get(soilbin.declaredBy[effect.id]).box.value) > 0; }

  say(answer) {
    const second = answer.beside && answer.beside.error ? `${answer.beside.label}: ${answer.beside.error}` : '';
    const wrong = answer.error || second;
    this.complain(wrong, answer.hint || (second && answer.beside.hint), wrong ? [] : answer.warnings);
    if (answer.carried_load) this.offerLoad(answer.carried_load);
  }

  isDrawn({curves}) { return Boolean(curves) && curves.plots.some(plot => plot.series.some(s => s.y.some(y => y !== null))); }
  commandOf({command, beside}) { return command + (beside ? `\n${beside.command}` : ''); }

  tell(answer) {
    soilbin.part('chosen').textContent = answer.in_words + (answer.beside ? `; beside it ${answer.beside.in_words}` : '');
    this.showReadings(answer.readings, answer.beside);
  }

  show(answer) {
    super.show(answer);
    if (answer.curves) soilbin.part('errors').textContent = answer.errors_in_words;
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

  showReadings(readings, beside) {
    const {make, part} = soilbin, text = ({value, unit}) => unit ? `${value} ${unit}` : 'none';
    const tiles = readings.findIndex(reading => reading.name === 'Contact');
    const second = ({name}) => beside && beside.readings.find(reading => reading.name === name);
    const tile = reading => {
      const one = this.tile(text(reading), reading.name, `${reading.name} ${reading.value} ${reading.unit}`);
      if (!reading.unit) one.title = reading.value;
      if (second(reading)) one.append(make('small', {textContent: `${beside.label}: ${text(second(reading))}`}));
      return one;
    };
    part('now').replaceChildren(...readings.slice(0, tiles).map(tile));
    part('sentences').replaceChildren(...readings.slice(tiles).map(r => make('p', {}, make('b', {textContent: `${r.name} `}), r.value)));
  }

  plotsOf(place) {
    const {plots} = this.answer[place];
    return place === 'budget' ? plots.filter(p => p.series.some(s => s.y.some(y => y !== null))) : plots;
  }

  // The budget piles up and has no room for a second one.
  keptSeries(place, i) { return place === 'budget' ? [] : super.keptSeries(place, i); }

  draw() {
    const wheels = this.answer.wheels.filter(wheel => wheel);
    soilbin.part('ground').hidden = !wheels.length;
    soilbin.part('ground').querySelector('.panels').replaceChildren(...wheels.map(soilbin.drawWheel));
    super.draw();
  }
};

fetch('case').then(response => response.json()).then(start => {
  soilbin.live = new soilbin.WheelPage(start);
});
