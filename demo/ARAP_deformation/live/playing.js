// Key frames, and films of them.
import { placeGizmo } from './drawing.js';
import { stopPlaying } from './follow.js';
import { handlesMoved, keyFrames, matrices } from './handles.js';
import { complain, say } from './messages.js';
import { identity, matrixOf, rigidParts } from './motion.js';
import { save } from './saving.js';
import { changed, page, view } from './state.js';
import { commitSoon } from './undo.js';

const sayNoHandle = () => say('There is no handle that could move.', true);

export function addKey() {
  if (!page.shape.handles.length) return sayNoHandle();
  page.keys.push(matrices());
  commitSoon();
}

// The motion up to now is a step that can be undone.
export function stop() {
  stopPlaying();
  commitSoon();
}

export function play(record) {
  if (page.playing) return stop();
  if (!page.shape.handles.length) return sayNoHandle();
  if (!page.keys.length) return say('There is no key frame: move a handle, and choose Add.', true);
  const path = [page.shape.handles.map(identity), ...keyFrames()];
  page.playing = {
    path,
    start: performance.now(),
    seconds: 1.5,
    recorder: record?.(),
  };
  placeGizmo();
  changed();
}

export function playFrame(time) {
  const { path, start, seconds } = page.playing,
    t = (time - start) / 1000 / seconds,
    i = Math.floor(t);
  const isEnd = i >= path.length - 1,
    share = isEnd ? 1 : t - i,
    from = path[isEnd ? path.length - 2 : Math.max(0, i)],
    to = path[isEnd ? path.length - 1 : i + 1];
  page.shape.handles.forEach((handle, k) => {
    const a = rigidParts({ ...handle, matrix: from[k] }),
      b = rigidParts({ ...handle, matrix: to[k] });
    handle.matrix = isEnd
      ? to[k].slice()
      : matrixOf(handle.pivot, a.q.slerp(b.q, share), a.place.lerp(b.place, share));
  });
  handlesMoved();
  if (isEnd) stop();
}

export function film() {
  const type = ['video/webm;codecs=vp9', 'video/webm', 'video/mp4'].find((t) =>
    window.MediaRecorder?.isTypeSupported(t),
  );
  if (!type) return say('This browser cannot record films.', true);
  const { name } = page.shape; // another one may be opened meanwhile
  try {
    play(() => {
      const stream = view.canvas.captureStream(30),
        recorder = new MediaRecorder(stream, { mimeType: type, videoBitsPerSecond: 6e6 }),
        parts = [];
      recorder.ondataavailable = ({ data }) => parts.push(data);
      recorder.onstop = () => {
        stream.getTracks().forEach((track) => track.stop());
        save(
          `${name}.${type.includes('mp4') ? 'mp4' : 'webm'}`,
          new Blob(parts, { type }),
        );
      };
      recorder.start();
      return recorder;
    });
  } catch (error) {
    complain(error); // the browser cannot record this after all
  }
}
