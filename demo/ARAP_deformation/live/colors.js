// The statuses of vertices, as in selection files, and the colors of the page.

export const FIXED = 0,
  FREE = 1,
  HANDLE = 2;
const palette = [
  0xf6c415, 0x2f7fe0, 0x36a852, 0x9b51c9, 0xf08a24, 0x14b8b0, 0xe0569b, 0x8a6d3b,
];
export const gray = 0xc9ced6,
  red = 0xd8302f;
export const colorOf = (status) =>
  status === FIXED ? red : status === FREE ? gray : palette[(status - HANDLE) % palette.length];
export const css = (rgb) => `#${rgb.toString(16).padStart(6, '0')}`;

export const ramp = [
  [0x30, 0x4f, 0x9e],
  [0x4f, 0xb0, 0xc6],
  [0xf2, 0xf0, 0xd0],
  [0xf2, 0x9a, 0x3c],
  [0xb3, 0x13, 0x2b],
];
export function rampColor(t) {
  const x = Math.max(0, Math.min(1, t || 0)) * (ramp.length - 1),
    i = Math.min(ramp.length - 2, Math.floor(x));
  return ramp[i].reduce(
    (rgb, c, k) => (rgb << 8) | Math.round(c + (x - i) * (ramp[i + 1][k] - c)),
    0,
  );
}
