// Writes the page as one file that needs no server: all that it loads is in it.
// usage: node single_file.mjs FOLDER OUT.html
import { readFileSync, writeFileSync } from 'node:fs';

const [folder, out] = process.argv.slice(2);
const read = (name, coding = 'utf8') => readFileSync(`${folder}/${name}`, coding);
const script = (name) =>
  read(name)
    .replace(/<\/script/gi, '<\\/script')
    .replace(/<!--/g, '<\\!--');

const parts = `window.arapParts = () => {
  const text = (id) => document.getElementById(id).textContent;
  const worker = new Blob([text('worker')], { type: 'text/javascript' });
  const code = Uint8Array.from(atob(text('wasm')), (c) => c.charCodeAt(0));
  return [new Worker(URL.createObjectURL(worker)), Promise.resolve(code.buffer)];
};`;

let page = read('index.html');
for (const [pattern, text] of [
  [/<link rel="stylesheet" href="style\.css" \/>/, `<style>\n${read('style.css')}</style>`],
  [
    /<script>\s*window\.arapParts[\s\S]*?<\/script>/,
    `<script type="text/plain" id="wasm">${read('arap.wasm', 'base64')}</script>\n` +
      `<script type="text/plain" id="worker">${script('worker.js')}</script>\n` +
      `<script>${parts}</script>`,
  ],
  [/<script src="live\.js"><\/script>/, `<script>\n${script('live.js')}</script>`],
]) {
  if (!pattern.test(page)) throw new Error(`index.html has no ${pattern}`);
  page = page.replace(pattern, () => text);
}
writeFileSync(out, page);
