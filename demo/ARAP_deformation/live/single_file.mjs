// Writes the page as one file that needs no server: all that it loads is in it.
// usage: node single_file.mjs FOLDER OUT.html
import { readFileSync, writeFileSync } from 'node:fs';

const [folder, out] = process.argv.slice(2);
const read = (name, coding = 'utf8') => readFileSync(`${folder}/${name}`, coding);
const script = (text) => text.replace(/<\/script/gi, '<\\/script').replace(/<!--/g, '<\\!--');
const replaced = (text, before, after) => {
  if (!text.includes(before)) throw new Error(`index.html has no ${before}`);
  return text.split(before).join(after);
};
const parts = `window.arapParts = () => {
  const worker = URL.createObjectURL(new Blob([document.getElementById('worker').textContent], { type: 'text/javascript' }));
  const code = atob(document.getElementById('wasm').textContent);
  return [new Worker(worker), Promise.resolve(Uint8Array.from(code, (c) => c.charCodeAt(0)).buffer)];
};`;
let page = read('index.html');
page = replaced(page, '<link rel="stylesheet" href="style.css">', `<style>\n${read('style.css')}</style>`);
page = page.replace(/<script>\nwindow\.arapParts[\s\S]*?<\/script>/, () =>
  `<script type="text/plain" id="wasm">${read('arap.wasm', 'base64')}</script>\n` +
  `<script type="text/plain" id="worker">${script(read('worker.js'))}</script>\n<script>${parts}</script>`);
page = replaced(page, '<script src="live.js"></script>', `<script>\n${script(read('live.js'))}</script>`);
writeFileSync(out, page);
