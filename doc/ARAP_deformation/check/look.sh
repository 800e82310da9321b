#!/usr/bin/env bash
# Loads each page of the manual in FOLDER in Chromium without a network. Fails if a formula stays raw, is
# not understood, or if a picture is not shown.
# usage: look.sh FOLDER
set -euo pipefail
cd "$1"
trap 'rm -f look.html' EXIT
cat >look.html <<'END'
<script>
const found = [];
let pages = 0, formulas = 0, pictures = 0;

function text_of(page) { // without what is code
  const text = page.body.cloneNode(true);
  text.querySelectorAll('pre, code, div.fragment, script').forEach(element => element.remove());
  return text.textContent;
}
function formulas_are_set(window) { // MathJax is loaded after the page
  return new Promise(done => {
    const wait = () => window.MathJax?.isReady ? window.MathJax.Hub.Queue(done) : setTimeout(wait, 20);
    setTimeout(done, 60000); // of Chromium's virtual time
    wait();
  });
}
async function look(name) {
  const frame = document.createElement('iframe');
  frame.src = name;
  document.body.append(frame);
  await new Promise(done => frame.onload = done);
  const page = frame.contentDocument;
  if(/\\[(\[]/.test(text_of(page))) await formulas_are_set(frame.contentWindow);
  if(/\\[(\[]/.test(text_of(page))) found.push(name + ': a formula is raw');
  if(page.querySelector('.MathJax_Error, .MathJax_SVG [fill="rgb(204, 0, 0)"]')) // in its red frame
    found.push(name + ': MathJax does not understand a formula');
  for(const image of page.images)
    if(image.naturalWidth === 0) found.push(name + ': does not show ' + image.src);
  ++pages;
  formulas += page.querySelectorAll('.MathJax_SVG').length;
  pictures += page.images.length;
  frame.remove();
}
async function look_at_all(names) {
  for(const name of names) await look(name);
  found.push(`looked at ${pages} pages, ${formulas} formulas, ${pictures} pictures`);
  document.documentElement.textContent = found.map(line => '\n' + line).join('') + '\n';
}
END
{ printf "addEventListener('load', () => look_at_all(["; printf "'%s'," *.html; echo "].filter(name => name != 'look.html')));</script>"; } >>look.html
found=$(chromium --headless --no-sandbox --disable-gpu --allow-file-access-from-files \
          --host-resolver-rules="MAP * ~NOTFOUND" --virtual-time-budget=3600000 --dump-dom \
          "file://$PWD/look.html" 2>/dev/null | grep -v '^<')
echo "$found"
[[ $found == "looked at "* ]]
