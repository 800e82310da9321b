// The keys: those of tools and buttons, and those that move the chosen handle.
import { moveByKey, removeHandle, reset } from './actions.js';
import { FIXED, FREE } from './colors.js';
import { closeHelp, say } from './messages.js';
import { cancelStroke, paintWith, setTool } from './painting.js';
import { actions, tools } from './panel.js';
import { addKey, play, stop } from './playing.js';
import { page } from './state.js';
import { commitNow, inTurn, redo, undo } from './undo.js';

addEventListener(
  'keydown',
  ({ key }) => /^(Arrow|Page|Shift)/.test(key) || inTurn(commitNow),
  true, // before the key does anything
);

addEventListener('keydown', (event) => {
  const key = event.key.length === 1 ? event.key.toLowerCase() : event.key;
  if (!page.shape || page.dragging || event.altKey) return;
  const isCommand = event.ctrlKey || event.metaKey; // menus take all other keys
  if (!isCommand && event.target.closest?.('select')) return;
  if (event.target.closest?.('input') && /^(Arrow|Page)/.test(key)) return;
  if (event.repeat && !isCommand && !/^(Arrow|Page)/.test(key)) return;
  const found = Object.keys(tools).find((id) => tools[id][2] === key);
  if (isCommand) {
    if (key === 'z') (event.shiftKey ? redo : undo)();
    else if (key === 'y') redo();
    else return;
  } else if (found) setTool(found);
  else if (/^\d$/.test(key)) {
    paintWith(key === '0' ? FREE : key === '1' ? FIXED : Number(key));
  } else if (key === 'Escape') {
    cancelStroke();
    if (page.playing) stop();
    say('');
    closeHelp();
  } else if (moveByKey(key, event.shiftKey)) closeHelp();
  else if (key === ' ' && event.target.closest?.('button, input')) return;
  else
    (
      ({
        o: actions.open,
        r: reset,
        v: actions.fit,
        u: actions.up,
        w: actions.moves,
        e: actions.turns,
        k: addKey,
        ' ': () => play(),
        h: actions.more,
        '?': actions.how,
        Delete: removeHandle,
        Backspace: removeHandle,
      })[key] ??
      (() => {
        event.handled = true;
      })
    )();
  if (!event.handled) event.preventDefault();
});
