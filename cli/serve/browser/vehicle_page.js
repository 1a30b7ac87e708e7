// The live page of a vehicle: what `soilbin vehicle` answers, and its drive in time as an animation.
'use strict';

soilbin.VehiclePage = class extends soilbin.LivePage {
  constructor(start) {
    super(start, {asks: 'state', drawing: 'vehicle', chartFigures: ['curves'],
                  saves: [['save-vehicle', 'vehicle.yaml?'], ['save-csv', 'pulls.csv?'], ['save-csv-comma', 'pulls.csv?decimal-comma=true&']]});
    const {part} = soilbin;
    soilbin.addTakeAlong(part('over-time'), 'drive', 'drive', () => this.drive.curves);
    part('drive').addEventListener('click', () => this.driveIt());
    part('play').addEventListener('click', () => this.play(!this.player.playing));
    part('scrub').addEventListener('input', event => { this.play(false); this.player.to(Number(event.target.value)); });
    part('pace').addEventListener('change', event => { this.player.pace = Number(event.target.value); });
  }

  data() { return this.answer.curves; }

  controls() {
    const {start} = this, wide = window.innerWidth > 820;
    return [
      this.group('Condition', true, ...this.numbersOf('condition')),
      this.group('Vehicle', wide, ...this.numbersOf('vehicle'),
                 ...start.choices.map(choice => this.choice(choice)),
                 this.drivenAxles()),
      this.group('Soil', wide, this.preset('Soil', 'soil', start.soil, start.soils), ...this.numbersOf('soil')),
      this.effectsGroup()];
  }

  choice(choice) {
    const options = choice.words.map(word => [word, word.replaceAll('_', ' ')]);
    return choice.element = this.list(choice.title, options, choice.key, choice.value);
  }

  // A list that goes with some drive lines alone is hidden beside the others, and what it says is taken back.
  set(key, text, start) {
    if (key === 'drive-line')
      for (const {key: other, drive_lines} of this.start.choices)
        if (drive_lines && !drive_lines.includes(text)) this.state.delete(other);
    super.set(key, text, start);
    this.showLists();
  }
  showLists() {
    super.showLists();
    const line = this.state.get('drive-line') || this.start.choices[0].value;
    for (const {element, drive_lines} of this.start.choices) element.hidden = drive_lines && !drive_lines.includes(line);
  }

  // A box for each axle: whether it is driven.
  drivenAxles() {
    const {make} = soilbin;
    this.axleBoxes = this.start.axles.map(({name}) => {
      const box = make('input', {type: 'checkbox', value: name});
      box.addEventListener('change', () => this.driveAxles());
      return box;
    });
    return make('fieldset', {className: 'axles'}, make('legend', {textContent: 'Driven axles'}),
                ...this.axleBoxes.map(box => make('label', {}, box, ' ' + box.value)));
  }
  startDriven() { return this.start.axles.filter(axle => axle.driven).map(axle => axle.name).join(); }
  driveAxles() {
    const driven = this.axleBoxes.filter(box => box.checked).map(box => box.value).join();
    if (driven) this.set('driven', driven, this.startDriven());
    else this.complain('no axle is driven', 'the last ones hold until one is');
  }

  showControls() {
    super.showControls();
    const driven = (this.state.get('driven') || this.startDriven()).split(',');
    for (const box of this.axleBoxes) box.checked = driven.includes(box.value);
  }

  // What moves with a slider is asked at once, the rest when nothing has moved for a while: it takes longer, and is given up
  // where something moves meanwhile.
  async ask() {
    this.leaveRest();
    await super.ask();
    this.leaveRest();
    if (!this.refused) this.resting = setTimeout(() => this.askRest(), 200);
  }

  leaveRest() {
    clearTimeout(this.resting);
    if (this.abort) this.abort.abort();
  }

  async askRest() {
    if (this.asking) return;
    const query = String(this.state), abort = this.abort = new AbortController();
    try {
      const answer = await (await fetch(`vehicle?${query}`, {signal: abort.signal})).json();
      if (query === String(this.state)) this.show(answer);
    } catch (error) {
      if (!abort.signal.aborted) this.complain('the server does not answer', 'it may have been stopped: start soilbin serve again, then reload');
    }
  }

  tell(answer) {
    const {part} = soilbin, tile = ({value, meaning}) => this.tile(value, meaning, `${meaning} ${value}`);
    const later = answer.in_full ? [] : ['steepest up', 'steepest down', 'steepest across'].map(meaning => ({value: '\u2026', meaning}));
    part('chosen').textContent = answer.in_words;
    part('now').replaceChildren(...[...answer.key_figures, ...later].map(tile));
    this.tellSentences('sentences', answer.sentences.concat(answer.in_full ? [] : [{about: 'Steepest slopes', text: '\u2026'}]));
    this.tellTables(answer);
  }

  // Until the rest is answered the tables that it brings stand there faint.
  tellTables({tables, in_full}) {
    const {make, part} = soilbin, host = part('tables');
    const shown = new Map([...host.children].map(element => [element.dataset.section, element]));
    const told = tables.map(({section, html, legend}) => {
      const element = shown.get(section) || make('section', {}, make('h2', {textContent: section}), make('div'), make('p'));
      element.dataset.section = section;
      element.children[1].innerHTML = html;
      element.children[2].textContent = legend;
      return element;
    });
    for (const element of shown.values()) element.classList.toggle('waiting', !told.includes(element));
    if (in_full) host.replaceChildren(...told);
    else host.append(...told.filter(element => !element.parentNode));
  }

  tellSentences(place, sentences) {
    const {make} = soilbin;
    soilbin.part(place).replaceChildren(...sentences.map(({about, text}) =>
      make('p', {}, ...(about ? [make('b', {textContent: `${about}: `})] : []), text)));
  }

  // The rest of an answer leaves a drive that is shown meanwhile where it is.
  draw() {
    const query = String(this.state), {part} = soilbin;
    super.draw();
    if (this.player && this.drivenFor === query) return;
    if (this.player) this.play(false);
    this.player = null;
    for (const id of ['play', 'scrubber', 'pacer']) part(id).hidden = true;
    part('clock').textContent = '';
    part('outdated').hidden = this.drivenFor === query;
    part('in-time').classList.toggle('stale', this.drivenFor !== query);
    this.showVehicle(this.answer.places, this.answer.state);
  }

  showVehicle(places, state) {
    const panels = soilbin.part('ground').querySelector('.panels'), room = panels.clientWidth || 720;
    panels.replaceChildren(soilbin.drawVehicle(places, state, Math.max(400, Math.min(720, room))));  // letters stay as large
  }

  // Asks for the drive of what is shown, and plays it.
  async driveIt() {
    const {part} = soilbin, button = part('drive'), query = String(this.state);
    button.disabled = true;
    button.textContent = 'Driving ...';
    try {
      const drive = await (await fetch(`drive?${query}`)).json();
      if (query === String(this.state)) this.showDrive(drive, query);
    } catch (error) {
      this.complain('the server does not answer', 'it may have been stopped: start soilbin serve again, then reload');
    }
    button.disabled = false;
    button.textContent = 'Drive';
    document.documentElement.dataset.driven = query;
  }

  showDrive(drive, query) {
    if (drive.error) return this.complain(drive.error, drive.hint);
    const {part} = soilbin;
    this.drive = drive;
    this.drivenFor = query;
    part('in-time').hidden = false;
    part('in-time').classList.remove('stale');
    part('outdated').hidden = true;
    part('drive-command').textContent = drive.command;
    this.tellSentences('driven', drive.sentences);
    part('over-time').hidden = !drive.curves;
    if (!drive.curves) return;
    this.drawCharts('over-time', this.timeCharts ||= [], drive.curves.plots);
    for (const id of ['play', 'scrubber', 'pacer']) part(id).hidden = false;
    part('scrub').max = drive.samples.time_s.at(-1);
    this.player = new soilbin.DrivePlayer(drive, (state, sample) => this.showMoment(state, sample), () => this.showPlaying());
    this.player.pace = Number(part('pace').value);
    this.play(!matchMedia('(prefers-reduced-motion: reduce)').matches);
  }

  showMoment(state, {time, travelled, speed, slip}) {
    const {part, formatNumber} = soilbin;
    this.showVehicle(this.drive.places, state);
    part('scrub').value = time;
    const said = `${time.toFixed(1)} s, ${travelled.toFixed(2)} m, ${formatNumber(speed)} m/s, ` +
      (slip === null ? 'all but at rest' : `slip ${formatNumber(100 * slip)} %`);
    part('scrub').setAttribute('aria-valuetext', said);
    part('clock').textContent = said;
  }

  play(on) {
    if (on) this.player.play();
    else this.player.pause();
    this.showPlaying();
  }
  showPlaying() { soilbin.part('play').textContent = this.player.playing ? 'Pause' : 'Play'; }
};

fetch('case').then(response => response.json()).then(start => {
  soilbin.live = new soilbin.VehiclePage(start);
});
