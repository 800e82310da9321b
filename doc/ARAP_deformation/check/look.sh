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
function number_of(page, what) { return page.querySelectorAll(what).length; }
function all_are_set(page) {
  return !/\\[(\[]/.test(text_of(page)) && number_of(page, '.MathJax_SVG') === number_of(page, 'script[type^="math/tex"]');
}
async function look(name) {
  const frame = document.createElement('iframe');
  frame.src = name;
  document.body.append(frame);
  await new Promise(done => frame.onload = done);
  const page = frame.contentDocument;
  for(let k = 0; k < 10000 && !all_are_set(page); ++k) // MathJax comes after the page; this time is virtual
    await new Promise(done => setTimeout(done, 50));
  if(!all_are_set(page)) found.push(name + ': a formula is raw');
  if(page.querySelector('.MathJax_Error, .MathJax_SVG [fill="rgb(204, 0, 0)"]')) // in its red frame
    found.push(name + ': MathJax does not understand a formula');
  for(const image of page.images)
    if(image.naturalWidth === 0) found.push(name + ': does not show ' + image.src);
  for(const drawing of page.querySelectorAll('object')) // SVG
    if(!drawing.contentDocument?.querySelector('svg')) found.push(name + ': does not show ' + drawing.data);
  ++pages;
  formulas += number_of(page, '.MathJax_SVG');
  pictures += page.images.length + number_of(page, 'object');
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
          --host-resolver-rules="MAP * ~NOTFOUND" --virtual-time-budget=100000000 --dump-dom \
          "file://$PWD/look.html" 2>/dev/null | grep -v '^<') || { echo "look.sh: Chromium failed" >&2; exit 1; }
echo "$found"
[[ $found == "looked at "[1-9]*" pages, "[1-9]* ]]
