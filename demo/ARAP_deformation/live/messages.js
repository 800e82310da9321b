// What the page says: sentences at the foot of the view, what it is busy with, and the help.
import { $, view } from './state.js';

let messageTimer = 0;

export function say(sentence, isError = false) {
  clearTimeout(messageTimer);
  $('message').hidden = !sentence;
  $('message').className = isError ? 'error' : '';
  $('message').firstElementChild.textContent = $('spoken').textContent = sentence;
  if (sentence && !isError) messageTimer = setTimeout(() => say(''), 6000);
}

$('message').lastElementChild.onclick = () => say('');

const sentence = ({ message }) =>
  // names of files keep their letters
  (/^[a-z]+[ ,]/.test(message) ? message[0].toUpperCase() : message[0]) +
  message.slice(1) +
  (/[.!?]$/.test(message) ? '' : '.');

export const complain = (error) => say(sentence(error), true);

let work = 0;

// two frames are drawn, if the page is seen
const drawn = () =>
  new Promise((done) => {
    requestAnimationFrame(() => requestAnimationFrame(done));
    setTimeout(done, 1000);
  });

// `blocks`: f keeps the page from drawing, so the message is drawn first
export async function busy(what, f, blocks = false) {
  ++work;
  $('busy').textContent = what;
  const show = () => {
    $('busy').hidden = false;
    $('spoken').textContent = what;
  };
  const timer = setTimeout(show, 150);
  try {
    if (blocks) {
      show();
      await drawn();
    }
    return await f();
  } finally {
    clearTimeout(timer);
    if (!--work) $('busy').hidden = true;
  }
}

export function closeHelp() {
  if ($('help').contains(document.activeElement)) view.canvas.focus({ preventScroll: true });
  $('help').hidden = true;
  try {
    localStorage.setItem('arap-help', 'seen');
  } catch {
    /* not allowed for files */
  }
}
