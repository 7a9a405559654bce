// Runs inside a copy of the page in a frame: when all of it is there, writes what it finds into the page around.
const faults = [];
window.addEventListener('error', (event) => faults.push(event.message || 'something did not load'), true);
window.addEventListener('load', () => {
  const pictures = [...document.images];
  for (const picture of pictures) {
    if (!picture.complete || picture.naturalWidth === 0) faults.push('not loaded: ' + picture.alt);
    if (picture.alt === '') faults.push('a picture has no alternative text');
  }
  const drawings = [...document.querySelectorAll('svg')];
  for (const details of document.querySelectorAll('details')) details.open = true;
  for (const drawing of drawings) {
    const name = drawing.getAttribute('aria-label');
    if (!name) faults.push('a drawing has no name');
    const box = drawing.getBoundingClientRect();
    if (box.width === 0 || box.height === 0) faults.push('not drawn: ' + name);
    for (const use of drawing.querySelectorAll('use')) {
      const target = use.getAttribute('href') || use.getAttribute('xlink:href');
      if (!drawing.querySelector(target)) faults.push('no such symbol in ' + name + ': ' + target);
    }
  }
  const ids = [...document.querySelectorAll('[id]')].map((element) => element.id);
  if (new Set(ids).size !== ids.length) faults.push('an identifier is there twice');
  const root = document.documentElement;
  if (root.scrollWidth > root.clientWidth) faults.push('wider than the window: ' + root.scrollWidth);
  // What is wider than the window scrolls in its own frame.
  for (const element of document.querySelectorAll('p, dl, pre, figcaption, table, svg, img, .cards td')) {
    if (element.closest('.rows') || element.closest('.drawing') || element.closest('details')) continue;
    if (element.getBoundingClientRect().right > root.clientWidth) faults.push('cut: ' + element.outerHTML.slice(0, 80));
  }
  // Several plots stand side by side in a large window, one takes the whole width of a telephone.
  for (const group of document.querySelectorAll('.plots')) {
    const plots = [...group.querySelectorAll('svg')].map((plot) => plot.getBoundingClientRect());
    const beside = plots.filter((plot) => Math.abs(plot.top - plots[0].top) < 1).length;
    if (beside !== (innerWidth >= 1280 ? Math.min(3, plots.length) : 1)) faults.push('plots side by side: ' + beside);
    if (plots.some((plot) => plot.width < (innerWidth >= 1280 ? 360 : innerWidth - 40)))
      faults.push('a narrow plot: ' + group.querySelector('svg').getAttribute('aria-label'));
  }
  // Letters of a plot are no smaller than 8 pt, as it is printed.
  for (const text of document.querySelectorAll('.plot svg text')) {
    const letters = parseFloat(getComputedStyle(text).fontSize) * text.getScreenCTM().a;
    const upright = Math.hypot(text.getScreenCTM().a, text.getScreenCTM().b);
    if (upright > 0 && letters > 0 && letters < 9.9 && !text.querySelector('tspan')) faults.push(`small letters, ${letters}: ${text.textContent}`);
  }
  // The three questions come first. Each section begins with sentences and ends with commands; so does each part begin.
  const asked = [...document.querySelectorAll('h2')].slice(0, 3).map((title) => title.textContent);
  if (!asked.every((title) => title.endsWith('?'))) faults.push('not the questions: ' + asked);
  for (const question of [...document.querySelectorAll('section')].slice(0, 3)) {
    if (!/\d.*95 %/.test(question.children[1].textContent.split('. ')[0])) faults.push('no figure with its interval: ' + question.children[1].textContent);
  }
  for (const part of document.querySelectorAll('h3')) {
    if (!/^[A-Z].{20,}[.]$/.test(part.nextElementSibling.textContent)) faults.push('no sentence: ' + part.textContent);
  }
  for (const section of document.querySelectorAll('section')) {
    const lead = section.children[1];
    if (!lead.matches('.lead') || !/^[A-Z].{20,}[.]$/.test(lead.textContent)) faults.push('no sentence: ' + section.children[0].textContent);
    if (!/^hitpipe /.test(section.lastElementChild.textContent)) faults.push('no command: ' + section.children[0].textContent);
  }
  // Texts of a plot do not lie on one another.
  for (const svg of document.querySelectorAll('.plot svg')) {
    const texts = [...svg.querySelectorAll('text')].map((text) => [text.textContent, text.getBoundingClientRect()]);
    texts.forEach(([text, a], i) => texts.slice(0, i).forEach(([other, b]) => {
      const width = Math.min(a.right, b.right) - Math.max(a.left, b.left);
      const height = Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top);
      if (width > 1 && height > 3) faults.push(`in ${svg.getAttribute('aria-label')}: "${text}" lies on "${other}"`);
    }));
  }
  // A large window shows all columns.
  for (const frame of document.querySelectorAll('.rows')) {
    if (innerWidth >= 1280 && frame.scrollWidth > frame.clientWidth)
      faults.push('columns are cut off: ' + frame.firstElementChild.getAttribute('aria-label'));
  }
  // The header of a long table stays when its rows scroll.
  for (const frame of document.querySelectorAll('.rows')) {
    const head = frame.querySelector('thead th');
    frame.scrollTop = frame.scrollHeight;
    if (Math.abs(head.getBoundingClientRect().top - frame.getBoundingClientRect().top) > 2)
      faults.push('a header scrolls away: ' + frame.firstElementChild.getAttribute('aria-label'));
    for (const name of frame.querySelectorAll('th')) {
      if (/_(ns|ms|mm2|pct|mhz)\b/.test(name.textContent)) faults.push('no words: ' + name.textContent);
    }
  }
  const found = parent.document.createElement('output');
  found.id = `checked-${innerWidth}`;
  found.textContent = `width ${innerWidth}, pictures ${pictures.length}, drawings ${drawings.length}, ` +
      `faults ${faults.length}: ${faults.join('; ')}`;
  parent.document.body.append(found, '\n');
});
