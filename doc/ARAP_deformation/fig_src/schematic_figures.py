#!/usr/bin/env python3
"""Draws the schematic figures of the manual: arap_region.svg and arap_cells.svg, into ../fig."""

import math
import pathlib

RED, YELLOW, WHITE, BLUE = '#d02020', '#f0b400', '#ffffff', '#1f5fbf'
STEP = 34  # an edge, in pixels


class Lattice:
    """A patch of a triangle mesh: the vertices (i, j) of a lattice, which the tests accept."""

    def __init__(self, nodes, is_inside, origin):
        self.nodes = [n for n in nodes if is_inside(n)]
        self.origin = origin
        inside = set(self.nodes)
        self.triangles = [t for i, j in nodes
                          for t in (((i, j), (i + 1, j), (i, j + 1)),
                                    ((i + 1, j), (i + 1, j + 1), (i, j + 1)))
                          if inside.issuperset(t)]
        self.edges = sorted({tuple(sorted(e)) for t in self.triangles for e in edges_of(t)})

    def place(self, node):
        """The node in the picture; a little out of the lattice, so that it looks like a mesh."""
        i, j = node
        x, y = i + j / 2, j * math.sqrt(3) / 2
        x += 0.10 * math.sin(3.1 * i + 1.7 * j)
        y += 0.10 * math.cos(2.3 * i - 1.9 * j)
        return self.origin[0] + STEP * x, self.origin[1] - STEP * y

    def draw(self, shaded=(), bold=()):
        """Triangles, of which some are shaded, and edges, of which some are bold."""
        parts = []
        for t in self.triangles:
            corners = ' '.join('%.1f,%.1f' % self.place(n) for n in t)
            fill = '#cfe0f5' if t in shaded else '#f2f2f2'
            parts.append(f'<polygon points="{corners}" fill="{fill}"/>')
        parts += [line(self.place(a), self.place(b), '#a0a0a0', 1) for a, b in self.edges]
        parts += [line(self.place(a), self.place(b), BLUE, 4) for a, b in sorted(bold)]
        return parts


def edges_of(triangle):
    a, b, c = triangle
    return (a, b), (b, c), (a, c)


def line(p, q, color, width):
    return (f'<line x1="{p[0]:.1f}" y1="{p[1]:.1f}" x2="{q[0]:.1f}" y2="{q[1]:.1f}" '
            f'stroke="{color}" stroke-width="{width}" stroke-linecap="round"/>')


def dot(p, color, radius=6):
    return (f'<circle cx="{p[0]:.1f}" cy="{p[1]:.1f}" r="{radius}" fill="{color}" '
            'stroke="#303030" stroke-width="1.2"/>')


def cross(p):
    (x, y), d = p, 5
    return (line((x - d, y - d), (x + d, y + d), '#303030', 2) +
            line((x - d, y + d), (x + d, y - d), '#303030', 2))


def text(p, words, anchor='middle'):
    return (f'<text x="{p[0]:.1f}" y="{p[1]:.1f}" font-family="sans-serif" font-size="15" '
            f'text-anchor="{anchor}" fill="#202020">{words}</text>')


def distance(a, b):
    """The number of edges between two nodes."""
    i, j = a[0] - b[0], a[1] - b[1]
    return max(abs(i), abs(j), abs(i + j))


def write(name, width, height, parts):
    file = pathlib.Path(__file__).parent.parent / 'fig' / name
    file.write_text('\n'.join(
        [f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" '
         f'viewBox="0 0 {width} {height}">', '<rect width="100%" height="100%" fill="#ffffff"/>']
        + parts + ['</svg>', '']))


def draw_cells():
    parts = []
    center = (0, 0)
    for k, name in enumerate(['spokes', 'spokes and rims', 'elements', '1-ring']):
        nodes = [(i, j) for i in range(-3, 3) for j in range(-3, 3)]
        mesh = Lattice(nodes, lambda n: distance(n, center) <= 2, (105 + 210 * k, 92))
        if name == 'elements':
            chosen = [((0, 0), (1, 0), (0, 1))]
        else:
            chosen = [t for t in mesh.triangles if center in t]
        bold = {tuple(sorted(e)) for t in chosen for e in edges_of(t)}
        if name == 'spokes':
            bold = {e for e in bold if center in e}
        if name == '1-ring':
            bold = {e for e in mesh.edges if min(distance(n, center) for n in e) <= 1}
        parts += mesh.draw(shaded=chosen if name in ('spokes and rims', 'elements') else (), bold=bold)
        if name != 'elements':
            parts.append(dot(mesh.place(center), WHITE, 7))
        parts.append(text((105 + 210 * k, 190), name))
    write('arap_cells.svg', 840, 205, parts)


def draw_region():
    def across(node):
        return node[0] + node[1] / 2

    mesh = Lattice([(i, j) for i in range(-4, 15) for j in range(-1, 6)],
                   lambda n: 0 <= across(n) <= 13 and 0 <= n[1] <= 5, (40, 270))
    region = {n for n in mesh.nodes if across(n) >= 4}
    handle = {n for n in region if across(n) >= 11.8 and 1 <= n[1] <= 4}
    shaded = [t for t in mesh.triangles if region.issuperset(t)]
    parts = ['<defs><marker id="tip" markerWidth="9" markerHeight="9" refX="7" refY="4" orient="auto">'
             '<path d="M0,0 L8,4 L0,8 z" fill="#303030"/></marker></defs>']
    parts += mesh.draw(shaded=shaded)
    for n in sorted(handle):
        x, y = mesh.place(n)
        parts.append(f'<line x1="{x:.1f}" y1="{y:.1f}" x2="{x + 134:.1f}" y2="{y - 57:.1f}" '
                     'stroke="#303030" stroke-width="1.3" marker-end="url(#tip)"/>')
        parts.append(cross((x + 140, y - 60)))
    for n in mesh.nodes:
        parts.append(dot(mesh.place(n), YELLOW if n in handle else WHITE if n in region else RED))
    for k, words in enumerate(['fixed, outside of the region', 'free', 'control vertex', 'its target']):
        at = (60 + 190 * k + (60 if k else 0) - (60 if k > 1 else 0), 318)
        parts.append(cross(at) if k == 3 else dot(at, (RED, WHITE, YELLOW)[k]))
        parts.append(text((at[0] + 14, at[1] + 5), words, 'start'))
    write('arap_region.svg', 760, 335, parts)


draw_cells()
draw_region()
