#!/usr/bin/env python3
"""Draws fig/pipeline.svg: the stages of the conversion, their functions, and what runs between."""
import os

stages = [
    ("mesh, curves", "Boundary_curve_network_3", "loops, chains, corners", "checked input"),
    ("cross field", "compute_cross_field()", "directions and", "singularities"),
    ("integer grid map", "compute_integer_grid_map()", "seamless, injective,", "exact integers"),
    ("quad layout", "extract_quad_layout()", "quads and the way", "back to the mesh"),
    ("target", "Transfinite_patch_network_3", "curves on the boundary,", "mesh in the interior"),
    ("surface", "T_NURCC_surface_3", "control T-mesh,", "C2 almost everywhere"),
    ("fits", "fit_boundary(), fit_interior()", "least squares and", "refinement"),
    ("faces", "extract_NURBS_faces()", "B-spline faces that share", "edges: STEP"),
]
width, height, gap, columns = 208, 96, 34, 4
out = []
for i, (name, function, first, second) in enumerate(stages):
    row, column = divmod(i, columns)
    if row % 2:  # the second row runs backwards, below the end of the first
        column = columns - 1 - column
    x, y = 10 + column * (width + gap), 10 + row * (height + 50)
    fill = "#e8f0fa" if i < 4 else "#faf0e0"
    out.append(f'<rect x="{x}" y="{y}" width="{width}" height="{height}" rx="8" '
               f'fill="{fill}" stroke="#456"/>')
    for k, (text, style) in enumerate([
            (name, 'font-size="16" font-weight="bold"'),
            (function, 'font-size="12" font-family="monospace"'),
            (first, 'font-size="12"'), (second, 'font-size="12"')]):
        out.append(f'<text x="{x + width / 2}" y="{y + (22, 44, 66, 82)[k]}" '
                   f'text-anchor="middle" {style}>{text}</text>')
    if i + 1 < len(stages):
        if i == columns - 1:
            a, b = (x + width / 2, y + height), (x + width / 2, y + height + 44)
        elif row % 2:
            a, b = (x, y + height / 2), (x - gap + 6, y + height / 2)
        else:
            a, b = (x + width, y + height / 2), (x + width + gap - 6, y + height / 2)
        out.append(f'<line x1="{a[0]}" y1="{a[1]}" x2="{b[0]}" y2="{b[1]}" stroke="#456" '
                   f'stroke-width="2" marker-end="url(#arrow)"/>')
w, h = 20 + columns * width + (columns - 1) * gap, 70 + 2 * height
svg = f'''<svg xmlns="http://www.w3.org/2000/svg" width="{w}" height="{h}" font-family="sans-serif">
<defs><marker id="arrow" markerWidth="8" markerHeight="8" refX="6" refY="3" orient="auto">
<path d="M0,0 L6,3 L0,6 z" fill="#456"/></marker></defs>
<rect width="100%" height="100%" fill="white"/>
''' + "\n".join(out) + "\n</svg>\n"
folder = os.path.dirname(os.path.abspath(__file__))
with open(os.path.join(folder, "..", "fig", "pipeline.svg"), "w") as f:
    f.write(svg)
