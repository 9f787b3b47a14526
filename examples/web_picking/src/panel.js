// The panel beside the picture: what was picked, the slider, and the bars.

const element = (id) => document.getElementById(id);
const counted = (count) => count.toLocaleString('en');

const trianglesText = (count) => `${counted(count)} triangle${count === 1 ? '' : 's'}`;

/** The slider's steps are even in the logarithm, from 1,000 to 100,000 in hundreds. */
const raysAt = (step) => Math.round(10 ** (3 + step / 50) / 100) * 100;
const stepOf = (rays) => Math.round(50 * (Math.log10(rays) - 3));

function millisecondsText(ms) {
  if (ms === null) return '…';
  if (ms >= 10_000) return `${counted(Math.round(ms / 1000))} s`;
  return ms >= 100 ? `${counted(Math.round(ms))} ms` : `${ms.toFixed(ms >= 10 ? 1 : 2)} ms`;
}

/** The scale of the bars is logarithmic. */
const [lowest, highest] = [0.1, 1e7];
const share = (ms) => Math.min(1, Math.max(0, Math.log10(ms / lowest) / Math.log10(highest / lowest)));

export class Panel {
  #rows = new Map();

  constructor({ aims, onRays, onAim, onMotion, onView, onUp, onFile }) {
    for (const [name, text] of Object.entries(aims)) element('aim').add(new Option(text, name));
    element('rays').addEventListener('input', () => {
      this.#showRays();
      onRays(this.rays);
    });
    element('aim').addEventListener('change', () => onAim(this.aim));
    element('moves').addEventListener('change', () => onMotion(element('moves').checked));
    element('up').addEventListener('change', () => onUp(element('up').value));
    for (const input of document.querySelectorAll('input[name=view]')) {
      input.addEventListener('change', () => onView(this.view));
    }
    element('file').addEventListener('change', () => {
      const [file] = element('file').files;
      if (file !== undefined) onFile(file);
    });
    document.addEventListener('dragover', (event) => event.preventDefault());
    document.addEventListener('drop', (event) => {
      event.preventDefault();
      const [file] = event.dataTransfer.files;
      if (file !== undefined) onFile(file);
    });
    this.#showRays();
  }

  get rays() { return raysAt(Number(element('rays').value)); }
  set rays(count) {
    element('rays').value = stepOf(count);
    this.#showRays();
  }

  get aim() { return element('aim').value; }
  set aim(name) { element('aim').value = name; }

  get view() { return document.querySelector('input[name=view]:checked').value; }
  set view(name) { document.querySelector(`input[name=view][value=${name}]`).checked = true; }

  set moves(isMoving) { element('moves').checked = isMoving; }
  set up(axis) { element('up').value = axis; }

  #showRays() {
    element('rays-text').textContent = counted(this.rays);
  }

  showMesh({ parts, index }) {
    const ends = [...parts.slice(1).map((part) => part.firstTriangle), index.length / 3];
    element('mesh').textContent =
      parts.map(({ name, firstTriangle }, i) => `${name}: ${trianglesText(ends[i] - firstTriangle)}`).join(' · ');
  }

  /** Says what the program does, or what is wrong. */
  say(text, isError = false) {
    element('message').textContent = text;
    element('message').classList.toggle('error', isError);
    element('message').hidden = text === '';
  }

  showPick(hit, part, point) {
    element('pick').classList.toggle('empty', hit === null);
    const set = (id, text) => { element(id).textContent = hit === null ? '–' : text(); };
    set('triangle', () => counted(hit.triangle));
    element('part').textContent = part?.name ?? '';
    for (const name of ['t', 'u', 'v']) set(name, () => String(hit[name]));
    set('side', () => hit.side);
    set('point', () => point.map((x) => x.toFixed(3)).join(', '));
  }

  showContest(contestants) {
    for (const contestant of contestants) {
      const row = this.#rows.get(contestant.name) ?? this.#addRow(contestant);
      row.time.textContent = (contestant.isSample ? '≈ ' : '') + millisecondsText(contestant.milliseconds);
      row.bar.style.width = `${100 * (contestant.milliseconds === null ? 0 : share(contestant.milliseconds))}%`;
      row.bar.classList.toggle('sample', contestant.isSample);
      const { ask, asked, wrong, farOff } = contestant;
      row.wrong.textContent = ask === null
        ? `exact for ${counted(asked)} rays`
        : `${counted(wrong)} of ${counted(asked)} wrong` + (wrong > 0 ? `, ${counted(farOff)} far off` : '');
      row.wrong.classList.toggle('bad', contestant.wrong > 0);
    }
  }

  #addRow({ name }) {
    const row = element('row').content.cloneNode(true).firstElementChild;
    row.querySelector('.name').textContent = name;
    row.classList.add(name.startsWith('surehit') ? 'ours' : 'theirs');
    element('bars').append(row);
    const parts = {
      time: row.querySelector('.time'), bar: row.querySelector('.fill'), wrong: row.querySelector('.wrong'),
    };
    this.#rows.set(name, parts);
    return parts;
  }
}
