// Players, sliders, and pictures in full size on pages that hold their pictures. The page is whole without it.
'use strict';

function make(tag, properties, parent) {
  return parent.appendChild(Object.assign(document.createElement(tag), properties));
}

function startPlayer(player) {
  const frames = Array.from(player.querySelectorAll('li'));
  const bar = document.createElement('div');
  bar.className = 'controls';
  player.prepend(bar);
  const button = make('button', { type: 'button' }, bar);
  const range = make('input', { type: 'range', min: 0, max: frames.length - 1, value: frames.length - 1 }, bar);
  range.setAttribute('aria-label', 'Instant');
  let timer = 0;
  function show(i) {
    frames.forEach((frame, k) => frame.classList.toggle('current', k === i));
    [i, i + 1].forEach(k => { if (frames[k]) frames[k].querySelector('img').loading = 'eager'; });
    range.value = i;
    range.setAttribute('aria-valuetext', frames[i].querySelector('figcaption').textContent);
  }
  function play(on) {
    clearInterval(timer);
    timer = on ? setInterval(() => show((Number(range.value) + 1) % frames.length), 200) : 0;
    button.textContent = on ? 'Pause' : 'Play';
  }
  button.addEventListener('click', () => {
    if (!timer) frames.forEach(frame => { frame.querySelector('img').loading = 'eager'; });
    play(!timer);
  });
  range.addEventListener('input', () => { play(false); show(Number(range.value)); });
  player.classList.add('on');
  show(frames.length - 1);
  play(false);
}

function startSlider(slider) {
  const upper = slider.querySelectorAll('figure')[1];
  const range = document.createElement('input');
  Object.assign(range, { type: 'range', min: 0, max: 100, step: 0.5, value: 50 });
  range.setAttribute('aria-label', 'Border between the two pictures');
  function move() { upper.querySelector('a').style.clipPath = `inset(0 0 0 ${range.value}%)`; }
  range.addEventListener('input', move);
  slider.append(range);
  slider.classList.add('on');
  move();
}

// Pictures within the page have no file to link to: they open over it.
function openInFull(image) {
  const dialog = make('dialog', {}, document.body);
  make('img', { src: image.src, alt: image.alt }, dialog);
  dialog.addEventListener('click', () => dialog.close());
  dialog.addEventListener('close', () => dialog.remove());
  dialog.showModal();
}

document.querySelectorAll('.player').forEach(startPlayer);
document.querySelectorAll('.slider').forEach(startSlider);
document.querySelectorAll('figure a:not([href]) img').forEach(image => {
  image.style.cursor = 'zoom-in';
  image.addEventListener('click', () => openInFull(image));
});
