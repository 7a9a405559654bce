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
  const found = parent.document.createElement('output');
  found.id = `checked-${innerWidth}`;
  found.textContent = `width ${innerWidth}, pictures ${pictures.length}, drawings ${drawings.length}, ` +
      `faults ${faults.length}: ${faults.join('; ')}`;
  parent.document.body.append(found, '\n');
});
