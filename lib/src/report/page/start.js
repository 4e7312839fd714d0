// Builds the view in place of its picture, and connects it with its controls and with the tables of the report.

function labelsOf(view, stage) {
  const labels = view.setups.children.map(mark => {
    const label = document.createElement('span');
    label.className = 'view-label';
    label.textContent = mark.userData.scan.number;
    stage.appendChild(label);
    return [label, mark];
  });
  const kApart = 16;  // [pixels] those that would cover an earlier one are left out until one comes nearer
  let placed = [];
  const isFree = at => placed.every(p => Math.hypot(p[0] - at[0], p[1] - at[1]) > kApart);
  return () => (placed = []) && labels.forEach(([label, mark]) => {
    const at = mark.visible ? view.onScreen(mark.position) : null;
    label.hidden = !at || !isFree(at);
    if (label.hidden) return;
    placed.push(at);
    label.style.transform = 'translate(' + at[0].toFixed(1) + 'px,' + at[1].toFixed(1) + 'px)';
  });
}

function fillScanList(list, view) {
  const boxes = [], entries = [];
  const add = (text, colour, change) => {
    const label = document.createElement('label'), box = document.createElement('input');
    box.type = 'checkbox';
    box.checked = true;
    box.addEventListener('change', () => change(box.checked));
    label.append(box);
    if (colour) {
      const dot = document.createElement('span');
      dot.className = 'swatch';
      dot.style.background = colour;
      label.append(dot);
    }
    label.append(text);
    list.append(label);
    entries.push(label);
    return box;
  };
  const ofGroup = () => boxes.filter(([, scan]) => scan.group === view.group);
  const all = add('all', null, on => ofGroup().forEach(([box, scan]) => {
    box.checked = scan.shown = on;
  }) || view.select(null) || view.onSelect(null));
  for (const scan of view.data.scans) {
    if (!scan.count) continue;
    boxes.push([add(scan.name, scan.colour, on => {
      scan.shown = on;
      all.checked = ofGroup().every(([box]) => box.checked);
      view.draw();
    }), scan]);
  }
  const showGroup = () => {
    boxes.forEach(([, scan], k) => entries[k + 1].hidden = scan.group !== view.group);
    all.checked = ofGroup().every(([box]) => box.checked);
  };
  showGroup();
  return showGroup;
}

// What is not registered with the rest is not taken for it.
function groupText(view) {
  const group = view.data.groups[view.group], scans = view.data.scans.filter(scan => scan.count && scan.group === view.group);
  return 'Group ' + group.component + ': its ' + scans.length + ' scans hold together, but are not registered with the ' +
      'others. They are shown in a frame of their own.';
}

function connect(view, part, showGroup) {
  const choices = (name, act) => part.querySelectorAll('[name=' + name + ']').forEach(
      input => input.addEventListener('change', () => act(input.value)));
  const modes = {scan: kByScan, height: kByHeight, distance: kByDistance};
  const legend = part.querySelector('.view-legend'), panel = part.querySelector('.view-link');
  const tellLegend = mode => {
    legend.hidden = mode === 'scan';
    if (mode === 'scan') return;
    const byHeight = mode === 'height', box = view.boxOf(view.group), tell = (name, text) => legend.querySelector(name).textContent = text;
    tell('.low', byHeight ? 'low' : '0');
    tell('.half', byHeight ? '' : lengthText(view.data.most_m / 4));  // the scale is that of the root
    tell('.high', byHeight ? lengthText(box[1].z - box[0].z) + ' above' : lengthText(view.data.most_m));
    tell('em', byHeight ? '' : 'grey: no other scan near');
  };
  choices('view-colour', value => {
    view.setMode(modes[value]);
    tellLegend(value);
  });
  const own = part.querySelector('.view-own'), groups = part.querySelectorAll('[name=view-group]');
  const takeGroup = group => {
    view.setGroup(group);
    groups.forEach(input => input.checked = Number(input.value) === group);
    own.hidden = group === 0;
    if (group !== 0) own.textContent = groupText(view);
    showGroup();
    tellLegend(part.querySelector('[name=view-colour]:checked').value);
  };
  choices('view-group', value => {
    choose(null);
    takeGroup(Number(value));
  });
  choices('view-state', value => view.setRegistered(value === 'registered'));
  part.querySelectorAll('[data-look]').forEach(
      button => button.addEventListener('click', () => view.look(button.dataset.look)));
  const toggles = {links: 'withLinks', setups: 'withSetups'};
  for (const [name, field] of Object.entries(toggles)) {
    const box = part.querySelector('[name=view-' + name + ']');
    view[field] = box.checked;
    box.addEventListener('change', () => {
      view[field] = box.checked;
      view.draw();
    });
  }
  part.querySelector('[name=view-size]').addEventListener('input', event => {
    view.pointSize = Math.pow(2, Number(event.target.value));
    view.draw();
  });
  view.onSelect = number => {
    fillPanel(panel, view.data, number);
    document.querySelectorAll('[data-link]').forEach(
        row => row.classList.toggle('chosen', number !== null && Number(row.dataset.link) === number));
    if (number === null) return;
    const close = document.createElement('button');
    close.type = 'button';
    close.textContent = 'Show all scans';
    close.addEventListener('click', () => choose(null));
    panel.append(close);
  };
  const choose = number => {
    const group = number === null ? view.group : view.data.scans[view.data.links[number].a].group;
    if (group !== view.group) takeGroup(group);
    view.select(number);
    view.onSelect(number);
  };
  let pressed = null;
  view.canvas.addEventListener('pointerdown', event => pressed = [event.clientX, event.clientY]);
  view.canvas.addEventListener('pointerup', event => {
    const isClick = pressed && Math.hypot(event.clientX - pressed[0], event.clientY - pressed[1]) < 5;
    if (!isClick) return;
    const box = view.canvas.getBoundingClientRect();
    const link = view.linkAt(event.clientX - box.left, event.clientY - box.top);
    if (link !== null) choose(link);
  });
  document.querySelectorAll('[data-link]').forEach(row => row.addEventListener('click', () => {
    choose(Number(row.dataset.link));
    part.scrollIntoView({behavior: 'smooth'});
  }));
}

function start() {
  const part = document.getElementById('view');
  if (!part) return;
  const stage = part.querySelector('.view-stage'), canvas = document.createElement('canvas');
  try {
    const data = readData();
    canvas.setAttribute('aria-label', 'Merged cloud in three dimensions');
    stage.append(canvas);
    const view = new CloudView(canvas, data);
    view.onDraw = labelsOf(view, stage);
    connect(view, part, fillScanList(part.querySelector('.view-scans'), view));
    part.classList.add('live');
    new ResizeObserver(() => view.resize()).observe(canvas);
    view.resize();
    view.look('oblique');
    window.tcmIcpView = view;
  } catch (error) {  // no WebGL: the picture stays
    canvas.remove();
    part.classList.remove('live');
    part.dataset.why = String(error);
  }
}

start();
