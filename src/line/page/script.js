'use strict';
(() => {
  const data = JSON.parse(document.getElementById('data').textContent);
  const cards = new Map([...document.querySelectorAll('article')].map((a) => [a.dataset.job, a]));
  const form = document.getElementById('filters');
  const tables = document.getElementById('tables');
  const say = (english, ...values) => ((WORDS && WORDS[english]) || english).replace(/\{(\d)\}/g, (_, k) => values[k]);
  const make = (name, text) => {
    const node = document.createElement(name);
    if (text !== undefined) node.textContent = text;
    return node;
  };
  const choose = (parent, name, values, first) => {
    const label = make('label', say(name) + ' ');
    const select = make('select');
    if (first !== undefined) select.append(new Option(say(first), ''));
    values.forEach((v) => select.append(new Option(say(v), v)));
    label.append(select);
    parent.append(label);
    select.addEventListener('change', show);
    return select;
  };
  const axes = Object.keys(data.axes).filter((a) => data.axes[a].length > 1);
  const filters = axes.map((a) => [a, choose(form, a, data.axes[a], 'all')]);
  const verdict = choose(form, 'verdict', ['passed', 'failed'], 'all');

  const bar = make('form');
  tables.append(make('h1', say('Tables')), bar);
  const named = data.figures.filter((f) => f.includes('.')).concat(data.figures.filter((f) => !f.includes('.')));
  const figure = choose(bar, 'figure', named);
  const rows = choose(bar, 'rows', axes);
  const columns = choose(bar, 'columns', axes);
  if (axes.includes('size')) columns.value = 'size';
  rows.value = axes.find((a) => a !== columns.value) || '';
  const grid = make('div');
  tables.append(grid);

  const wanted = (job) =>
    filters.every(([axis, select]) => !select.value || job.at[axis] === select.value) &&
    (!verdict.value || (verdict.value === 'passed') === job.passed);

  const mean = (jobs) => {
    const values = jobs.map((j) => j.figures[figure.value]).filter((v) => v !== undefined);
    return values.length ? values.reduce((a, b) => a + b, 0) / values.length : undefined;
  };
  const words = (value) => (value === undefined ? '' : figure.value.includes('.') ? value.toFixed(0) : value.toPrecision(4));
  const series = (jobs) => {
    const keys = rows.value ? data.axes[rows.value] : [''];
    return keys.map((row) => ({
      name: row,
      cells: (data.axes[columns.value] || []).map((column) =>
        jobs.filter((j) => (!row || j.at[rows.value] === row) && j.at[columns.value] === column)),
    }));
  };

  const table = (all) => {
    const out = make('table');
    const head = make('tr');
    head.append(make('th', figure.value));
    (data.axes[columns.value] || []).forEach((c) => head.append(make('th', c)));
    out.append(head);
    all.forEach(({ name, cells }) => {
      const row = make('tr');
      row.append(make('th', name));
      cells.forEach((jobs) => {
        const cell = make('td', words(mean(jobs)));
        if (jobs.some((j) => !j.passed)) cell.className = 'failed';
        row.append(cell);
      });
      out.append(row);
    });
    return out;
  };

  const chart = (all) => {
    const space = 'http://www.w3.org/2000/svg';
    const draw = (parent, name, attributes, text) => {
      const node = document.createElementNS(space, name);
      Object.entries(attributes).forEach(([k, v]) => node.setAttribute(k, v));
      if (text !== undefined) node.textContent = text;
      parent.append(node);
    };
    const svg = document.createElementNS(space, 'svg');
    svg.setAttribute('viewBox', '0 0 760 320');
    const lines = all.map(({ name, cells }) => ({ name, values: cells.map(mean) }));
    const values = lines.flatMap((l) => l.values).filter((v) => v !== undefined);
    if (!values.length) return svg;
    const [low, high] = [Math.min(...values), Math.max(...values)];
    const names = data.axes[columns.value] || [];
    const x = (k) => 70 + (names.length > 1 ? (k * 520) / (names.length - 1) : 260);
    const y = (v) => 270 - (high > low ? ((v - low) * 230) / (high - low) : 115);
    names.forEach((n, k) => draw(svg, 'text', { x: x(k), y: 300, 'text-anchor': 'middle', 'font-size': 12 }, n));
    [low, high].forEach((v) => draw(svg, 'text', { x: 60, y: y(v) + 4, 'text-anchor': 'end', 'font-size': 12 }, words(v)));
    lines.forEach((line, number) => {
      const color = `hsl(${(number * 67) % 360} 55% 40%)`;
      const points = line.values.map((v, k) => (v === undefined ? '' : `${x(k)},${y(v)}`)).filter(Boolean);
      draw(svg, 'polyline', { points: points.join(' '), fill: 'none', stroke: color, 'stroke-width': 2 });
      points.forEach((p) => draw(svg, 'circle', { cx: p.split(',')[0], cy: p.split(',')[1], r: 3, fill: color }));
      draw(svg, 'text', { x: 610, y: 40 + 16 * number, fill: color, 'font-size': 12 }, line.name);
    });
    return svg;
  };

  function show() {
    const jobs = data.jobs.filter(wanted);
    const names = new Set(jobs.map((j) => j.job));
    cards.forEach((card, name) => { card.hidden = !names.has(name); });
    document.getElementById('count').textContent = say('{0} of {1} jobs', jobs.length, data.jobs.length);
    const all = series(jobs);
    grid.replaceChildren(table(all), chart(all));
  }
  show();
  window.toile = { state: () => ({ ready: true, shown: [...cards.values()].filter((c) => !c.hidden).length }) };
})();
