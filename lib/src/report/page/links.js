// What is told of one link: its figures, the histogram of its residuals, and the direction it can slide in.

// Of a shift with a turn, what moves the points more.
function slideOf(link) {
  if (!link.strength) return null;
  const axis = link.strength.axis, shift = axis.slide_translation_m, turn = axis.slide_rotation_deg;
  if (!shift || shift.some(x => x === null) || turn.some(x => x === null)) return {centre: link.strength.centre};
  const norm = v => Math.hypot(...v), arc = norm(turn) * Math.PI / 180 * link.strength.radius_m;
  const turns = arc > norm(shift), along = turns ? turn : shift;
  return {centre: link.strength.centre, turns, length_m: axis.slide_m, degrees: norm(turn),
          direction: along.map(x => x / norm(along))};
}

function slideText(slide) {
  if (!slide) return null;
  if (!slide.direction) return 'Nothing holds it in its weakest direction.';
  const by = lengthText(slide.length_m);
  return slide.turns ? 'Can turn by ' + slide.degrees.toFixed(3) + '\u00b0 (' + by + ' at its points) about the red arrows unnoticed.'
                     : 'Can move by ' + by + ' along the red arrows unnoticed.';
}

function histogram(residuals) {
  const {class_m: width, counts} = residuals.histogram, most = Math.max(...counts), n = counts.length;
  const bars = counts.map((count, i) => {
    const height = 80 * count / most;
    return '<rect x="' + (10 * i + 1) + '" y="' + (84 - height) + '" width="8" height="' + height + '"/>';
  }).join('');
  const end = lengthText(n * width / 2);
  return '<svg class="histogram" viewBox="0 0 ' + 10 * n + ' 104" role="img"><title>Histogram of residuals</title>' + bars +
      '<path d="M0 84.5 H' + 10 * n + '"/><text x="0" y="98">\u2212' + end + '</text><text x="' + 5 * n +
      '" y="98" text-anchor="middle">0</text><text x="' + 10 * n + '" y="98" text-anchor="end">' + end + '</text></svg>';
}

function fillPanel(panel, data, number) {
  panel.hidden = number === null;
  if (number === null) return;
  const link = data.links[number], r = link.residuals, add = (element, text) => {
    const e = document.createElement(element);
    e.textContent = text;
    panel.appendChild(e);
  };
  panel.textContent = '';
  add('h3', data.scans[link.a].name + ' \u2013 ' + data.scans[link.b].name);
  add('p', link.verdict[0].toUpperCase() + link.verdict.slice(1) + ', ' + Math.round(100 * link.evidence.overlap) +
           ' % overlap' + (r ? '; residuals RMS ' + lengthText(r.rms_m) + ', 95 % within ' + lengthText(r.p95_m) : '') + '.');
  if (link.verdict !== 'accepted') add('p', link.reason);
  const slide = slideText(slideOf(link));
  if (slide) add('p', slide);
  if (r) panel.insertAdjacentHTML('beforeend', histogram(r));
}
