// The energy, in powers of ten, and the milliseconds of the last steps.
export function drawPlot(canvas, history, measured) {
  const c = canvas.getContext('2d'),
    { width: w, height: h } = canvas;
  c.clearRect(0, 0, w, h);
  c.font = '22px system-ui, sans-serif';
  const line = (list, color, low, high) => {
    c.beginPath();
    list.forEach((x, i) =>
      c.lineTo(8 + (i * (w - 16)) / 109, h - 8 - ((h - 48) * (x - low)) / (high - low || 1)),
    );
    c.strokeStyle = color;
    c.lineWidth = 3;
    c.stroke();
  };
  const logs = history.energy.map((e) => Math.log10(Math.max(e, 1e-300))),
    top = Math.max(...logs),
    bottom = Math.max(Math.min(...logs), top - 6);
  line(
    logs.map((x) => Math.max(x, bottom)),
    '#1f6fd6',
    bottom,
    top,
  );
  line(history.milliseconds, '#d97706', 0, Math.max(...history.milliseconds));
  c.fillStyle = '#1f6fd6';
  c.fillText(
    `energy ${Number.isFinite(measured.energy) ? measured.energy.toPrecision(4) : '–'}`,
    8,
    26,
  );
  c.fillStyle = '#b45309';
  const perIteration = measured.milliseconds / Math.max(1, measured.iterations);
  c.fillText(
    `${Number.isFinite(perIteration) ? perIteration.toFixed(1) : '–'} ms/iteration`,
    w - 210,
    26,
  );
}
