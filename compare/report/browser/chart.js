// Interactive line charts from the data of a sheet (plot.hpp): zoom, pan, readings by mouse and by keys.
// Colours are the page's classes (s c0, f q3), so that light, dark and print need nothing here.
'use strict';

const soilbin = {};

soilbin.formatNumber = function (value) {
  if (value === null || !isFinite(value)) return '-';
  if (value === 0) return '0';
  const size = Math.abs(value);
  const text = size >= 1e5 || size < 1e-3 ? value.toExponential(2) : String(Number(value.toPrecision(4)));
  return text.replace('-', '\u2212');
};

// 127000 as '127 kN', with four digits at most.
soilbin.formatForce = function (newton) {
  return Math.abs(newton) < 1000 ? `${soilbin.formatNumber(newton)} N` : `${soilbin.formatNumber(newton / 1000)} kN`;
};

// A text in lines of so many pixels, as far as its words allow; `letter` is a letter's width, near enough.
soilbin.linesOf = function (text, width, letter) {
  const lines = [''];
  for (const word of text.split(' ')) {
    const longer = lines[lines.length - 1] ? `${lines[lines.length - 1]} ${word}` : word;
    if (lines[lines.length - 1] && letter * longer.length > width) lines.push(word);
    else lines[lines.length - 1] = longer;
  }
  return lines;
};

soilbin.dashes = [null, '7 4', '1 4', '8 4 1 4'];

// Whether a hand moved the mouse: where the page scrolls under a mouse that lies still, it is told to move too, and what
// the keys read would be lost.
soilbin.pointed = false;
soilbin.pointer = {x: NaN, y: NaN};
document.addEventListener('mousemove', event => {
  const {clientX: x, clientY: y} = event;
  soilbin.pointed = x !== soilbin.pointer.x || y !== soilbin.pointer.y;
  soilbin.pointer = {x, y};
}, true);

// One panel: a plot of the sheet in the element `host`. Hidden labels are those in the set `hidden`, whose `pointed` is the
// one that is pointed at in the legend.
soilbin.Chart = class {
  constructor(host, plot, hidden) {
    this.host = host;
    this.plot = plot;
    this.hidden = hidden;
    this.transform = d3.zoomIdentity;
    this.reading = null;  // index into this.places()
    host.classList.add('chart');
    this.root = d3.select(host).append('div').attr('class', 'chart-frame');
    this.svg = this.root.append('svg').attr('class', 'live').attr('tabindex', 0).attr('role', 'group')
      .attr('aria-label', `${plot.title} against ${plot.x.title}. Left and right: read values. Plus, minus, 0: zoom.`);
    this.tip = this.root.append('div').attr('class', 'tip').attr('hidden', true);
    this.spoken = d3.select(host).append('p').attr('class', 'for-ears').attr('aria-live', 'polite');
    this.addZoom();
    this.addReadings();
    this.draw();
    new ResizeObserver(() => this.draw()).observe(host);
  }

  // Shows another plot in the same panel; zoom and reading stay.
  replot(plot) {
    this.plot = plot;
    if (this.reading !== null) this.reading = Math.min(this.reading, this.places().length - 1);
    this.draw();
  }

  // A line that stays at x, such as the present time; null: none.
  mark(x) {
    this.marked = x;
    const out = x === null || x === undefined || this.frame.x(x) < this.frame.left - 1 || this.frame.x(x) > this.frame.right + 1;
    this.marker.attr('visibility', out ? 'hidden' : 'visible');
    if (!out) this.marker.attr('x1', this.frame.x(x)).attr('x2', this.frame.x(x));
  }

  visible() { return this.plot.series.filter(series => !this.hidden.has(series.label)); }

  // Every x at which a visible series has a value, once.
  places() {
    const all = new Set();
    for (const series of this.visible())
      series.x.forEach((x, i) => { if (series.y[i] !== null) all.add(x); });
    return [...all].sort((a, b) => a - b);
  }

  domains() {
    const xs = [], ys = [];
    for (const series of this.visible())
      series.x.forEach((x, i) => {
        if (series.y[i] === null) return;
        const error = series.band === false ? 0 : series.error[i] || 0;
        xs.push(x);
        ys.push(series.y[i] - error, series.y[i] + error);
        if (series.base.length) ys.push(series.base[i]);
      });
    const span = (values, axis, room) => {
      let [low, high] = values.length ? d3.extent(values) : [0, 1];
      if (low === high) [low, high] = [low - 0.5 * Math.abs(low || 1), high + 0.5 * Math.abs(high || 1)];
      const pad = room * (high - Math.min(low, axis.lower !== null ? axis.lower : low));
      return [axis.lower !== null ? axis.lower : low - pad, axis.upper !== null ? axis.upper : high + pad];
    };
    if (this.plot.identity_line) { xs.push(...ys); ys.push(...xs); }
    return [span(xs, this.plot.x, 0.02), span(ys, this.plot.y, 0.06)];
  }

  // Scales of the panel's present size and zoom.
  layout() {
    const width = Math.max(240, this.host.clientWidth), height = Math.round(Math.min(340, Math.max(220, 0.68 * width)));
    const [x, y] = this.domains(), buttons = 90, title = soilbin.linesOf(this.plot.title, width - buttons, 7.2);
    const frame = {left: this.plot.y.title ? 62 : 50, right: width - 10, top: 15 + 15 * title.length, bottom: height - 40, width, height, title};
    frame.x = this.transform.rescaleX(d3.scaleLinear().domain(x).range([frame.left, frame.right]));
    frame.y = this.transform.rescaleY(d3.scaleLinear().domain(y).range([frame.bottom, frame.top]));
    return frame;
  }

  draw() {
    const frame = this.frame = this.layout(), {svg, plot} = this;
    svg.attr('viewBox', `0 0 ${frame.width} ${frame.height}`).attr('height', frame.height);
    svg.selectAll('*').remove();
    const clip = `clip-${soilbin.Chart.count = (soilbin.Chart.count || 0) + 1}`;
    svg.append('clipPath').attr('id', clip).append('rect').attr('x', frame.left).attr('y', frame.top)
      .attr('width', frame.right - frame.left).attr('height', frame.bottom - frame.top);
    this.drawAxes(frame);
    const marks = svg.append('g').attr('clip-path', `url(#${clip})`);
    if (plot.identity_line) {
      const [low, high] = frame.x.domain();
      marks.append('line').attr('class', 'quiet-line').attr('stroke-dasharray', '4 4').attr('x1', frame.x(low))
        .attr('x2', frame.x(high)).attr('y1', frame.y(low)).attr('y2', frame.y(high));
    }
    for (const series of this.visible()) soilbin.drawSeries(marks, series, frame, series.label === this.hidden.pointed);
    this.marker = svg.append('line').attr('class', 'quiet-line').attr('y1', frame.top).attr('y2', frame.bottom);
    this.mark(this.marked);
    this.cursor = svg.append('line').attr('class', 'cursor').attr('y1', frame.top).attr('y2', frame.bottom)
      .attr('visibility', 'hidden');
    this.zoom.extent([[frame.left, frame.top], [frame.right, frame.bottom]])
      .translateExtent([[frame.left, frame.top], [frame.right, frame.bottom]]);
    this.show();
  }

  drawAxes(frame) {
    const {svg, plot} = this;
    // A tick's digits follow from how many ticks there are: one count for both.
    const ticked = (axis, scale, count) => {
      const own = scale.tickFormat(count);
      return axis(scale).ticks(count).tickFormat(value => own(value).replace('-', '\u2212'));
    };
    svg.append('g').attr('class', 'axis lines').attr('transform', `translate(${frame.left},0)`)
      .call(ticked(d3.axisLeft, frame.y, 5).tickSize(frame.left - frame.right));
    // Of a single place: points that stand beside each other there would be read at other ticks.
    const below = ticked(d3.axisBottom, frame.x, Math.max(3, frame.width / 80)).tickSizeOuter(0), places = this.places();
    if (places.length === 1) below.tickValues(places).tickFormat(soilbin.formatNumber);
    svg.append('g').attr('class', 'axis').attr('transform', `translate(0,${frame.bottom})`).call(below);
    frame.title.forEach((line, i) => svg.append('text').attr('class', 'ink title').attr('x', 4).attr('y', 17 + 15 * i).text(line));
    svg.append('text').attr('class', 'quiet').attr('text-anchor', 'middle').attr('x', (frame.left + frame.right) / 2)
      .attr('y', frame.height - 6).text(plot.x.title);
    if (plot.y.title)
      svg.append('text').attr('class', 'quiet').attr('text-anchor', 'middle')
        .attr('transform', `translate(13,${(frame.top + frame.bottom) / 2}) rotate(-90)`).text(plot.y.title);
  }

  // The wheel scrolls the page unless Ctrl is held; dragging pans once zoomed in, so a finger still scrolls the page.
  addZoom() {
    this.zoom = d3.zoom().scaleExtent([1, 40])
      .filter(() => {
        const event = d3.event;
        if (event.type === 'wheel') return event.ctrlKey || event.metaKey;
        if (event.type.startsWith('touch')) return event.touches.length > 1 || this.transform.k > 1;
        return !event.button;
      })
      .on('zoom', () => { this.transform = d3.event.transform; this.draw(); });
    this.svg.call(this.zoom).on('dblclick.zoom', null);
    const buttons = this.root.append('div').attr('class', 'zoom');
    for (const [text, name, act] of [['+', 'Zoom in', () => this.zoomBy(1.6)], ['\u2212', 'Zoom out', () => this.zoomBy(1 / 1.6)],
                                     ['\u27f2', 'Whole range', () => this.reset()]])
      buttons.append('button').attr('type', 'button').attr('title', name).attr('aria-label', `${name}: ${this.plot.title}`)
        .text(text).on('click', act);
  }
  zoomBy(factor) { this.svg.call(this.zoom.scaleBy, factor); }
  reset() { this.svg.call(this.zoom.transform, d3.zoomIdentity); }

  addReadings() {
    const at = () => {
      const x = this.frame.x.invert(d3.mouse(this.svg.node())[0]), places = this.places();
      this.reading = places.length ? d3.scan(places, (a, b) => Math.abs(a - x) - Math.abs(b - x)) : null;
      this.show();
    };
    const leave = () => { this.reading = null; this.show(); };
    this.svg.on('mousemove', () => soilbin.pointed && at()).on('touchstart.reading', at).on('mouseleave', leave).on('blur', leave);
    this.svg.on('keydown', () => {
      const {key} = d3.event, last = this.places().length - 1;
      const steps = {ArrowLeft: -1, ArrowRight: 1};
      if (key in steps) {
        this.reading = this.reading === null ? 0 : Math.min(last, Math.max(0, this.reading + steps[key]));
        this.show(true);
      } else if (key === '+' || key === '=') this.zoomBy(1.6);
      else if (key === '-') this.zoomBy(1 / 1.6);
      else if (key === '0') this.reset();
      else if (key === 'Escape') leave();
      else return;
      d3.event.preventDefault();
    });
  }

  // What visible series say at the place read: [label, colour, text].
  values(x) {
    const lines = [];
    for (const series of this.visible())
      series.x.forEach((at, i) => {
        if (Math.abs(at - x) > 1e-9 * Math.max(1, Math.abs(x)) || series.y[i] === null) return;
        const error = series.error[i] ? ` \u00b1 ${soilbin.formatNumber(series.error[i])}` : '';
        const value = soilbin.valueAt(series, i);
        if (value !== 0 || !series.base.length) lines.push([series.label, series.color, soilbin.formatNumber(value) + error]);
      });
    return lines;
  }

  show(speak = false) {
    const x = this.reading === null ? undefined : this.places()[this.reading];
    const out = x === undefined || this.frame.x(x) < this.frame.left - 1 || this.frame.x(x) > this.frame.right + 1;
    this.tip.attr('hidden', out ? true : null);
    this.cursor.attr('visibility', out ? 'hidden' : 'visible');
    if (out) return;
    const at = this.frame.x(x), lines = this.values(x), where = `${this.plot.x.title}: ${soilbin.formatNumber(x)}`;
    this.cursor.attr('x1', at).attr('x2', at);
    this.tip.text('').append('b').text(where);
    const rows = this.tip.selectAll('div').data(lines).enter().append('div');
    rows.append('span').attr('class', ([, color]) => `dot ${color}`);
    rows.append('span').text(([label, , text]) => (label ? `${label}: ` : '') + text);
    const right = at > this.frame.width / 2;
    this.tip.style('left', right ? null : `${at + 10}px`).style('right', right ? `${this.frame.width - at + 10}px` : null);
    if (speak) this.spoken.text(`${where}; ` + lines.map(([label, , text]) => `${label} ${text}`).join('; '));
  }
};

// What a series says at its i-th point: an area its own share of the pile.
soilbin.valueAt = (series, i) => series.y[i] === null || !series.base.length ? series.y[i]
  : Number((series.y[i] - series.base[i]).toPrecision(6));

// Area, band, line, points and error bars of one series. `pointed`: its errors are drawn even where many series keep theirs
// to the readings.
soilbin.drawSeries = function (marks, series, frame, pointed) {
  const drawn = pointed || series.band !== false;
  const points = series.x.map((x, i) => ({x, y: series.y[i], error: drawn && series.error[i] || 0}));
  const there = p => p.y !== null, px = p => frame.x(p.x) + (series.shift || 0), py = p => frame.y(p.y);
  if (series.base.length) {
    marks.append('path').attr('class', `f ${series.color} area`)
      .attr('d', d3.area().defined(there).x(px).y0((p, i) => frame.y(series.base[i])).y1(py)(points));
    return;
  }
  const joined = series.mark !== 'points';
  if (joined && drawn && series.error.length)
    marks.append('path').attr('class', `f ${series.color} band`)
      .attr('d', d3.area().defined(there).x(px).y0(p => frame.y(p.y - p.error)).y1(p => frame.y(p.y + p.error))(points));
  if (joined)
    marks.append('path').attr('class', `s ${series.color} line`).attr('stroke-dasharray', soilbin.dashes[series.dash % 4])
      .attr('d', d3.line().defined(there).x(px).y(py)(points));
  if (series.mark === 'line' && points.length > 1) return;
  const each = marks.append('g').selectAll('g').data(points.filter(there)).enter();
  if (!joined || points.length === 1)
    each.append('line').attr('class', `s ${series.color}`).attr('x1', px).attr('x2', px)
      .attr('y1', p => frame.y(p.y - p.error)).attr('y2', p => frame.y(p.y + p.error));
  each.append('circle').attr('class', `f ${series.color}`).attr('r', 3.4).attr('cx', px).attr('cy', py);
};
