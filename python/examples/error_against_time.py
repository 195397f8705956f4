"""A figure of error against time: what a frame costs with each technique and layout, and how far its picture is from the truth.

    ./run python python/examples/error_against_time.py SCENE FIGURE.svg [FRAMES [WIDTHxHEIGHT]]

Needs nothing but the module: the figure is written as SVG.
"""

import html
import math
import sys

import tessera

WIDTH, HEIGHT, MARGIN = 720, 440, 64
COLOURS = ["#4477aa", "#ee6677", "#228833", "#ccbb44", "#66ccee", "#aa3377", "#777777", "#000000"]


def scale(values, begin, end):
    """A logarithmic axis over the values: where one lies between two places, and the powers of ten within."""
    low, high = math.log10(min(values)) - 0.1, math.log10(max(values)) + 0.1
    place = lambda value: begin + (math.log10(value) - low) / (high - low) * (end - begin)
    return place, [10.0**power for power in range(math.ceil(low), math.floor(high) + 1)]


def figure(points, title):
    """The points as SVG: x is ms a frame, y the relative mean square error; exact ones lie on the lower edge."""
    errors = [point["error"]["relMse"] for point in points]
    least = min((error for error in errors if error > 0), default=1e-12) / 10
    x, xTicks = scale([point["cpuMs"]["median"] for point in points], MARGIN, WIDTH - MARGIN)
    y, yTicks = scale([least, *(max(error, least) for error in errors)], HEIGHT - MARGIN, MARGIN)
    techniques = list(dict.fromkeys(point["technique"] for point in points))
    parts = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" font-family="sans-serif" font-size="12">',
             f'<rect width="{WIDTH}" height="{HEIGHT}" fill="white"/>',
             f'<text x="{MARGIN}" y="24" font-size="15">{html.escape(title)}</text>',
             f'<text x="{WIDTH / 2}" y="{HEIGHT - 16}" text-anchor="middle">ms a frame</text>',
             f'<text transform="translate(16 {HEIGHT / 2}) rotate(-90)" text-anchor="middle">relMSE</text>']
    for tick in xTicks:
        parts.append(f'<path d="M{x(tick):.1f} {MARGIN}V{HEIGHT - MARGIN}" stroke="#ddd"/>'
                     f'<text x="{x(tick):.1f}" y="{HEIGHT - MARGIN + 16}" text-anchor="middle">{tick:g}</text>')
    for tick in yTicks:
        parts.append(f'<path d="M{MARGIN} {y(tick):.1f}H{WIDTH - MARGIN}" stroke="#ddd"/>'
                     f'<text x="{MARGIN - 6}" y="{y(tick) + 4:.1f}" text-anchor="end">{tick:.0e}</text>')
    for point, error in zip(points, errors):
        colour = COLOURS[techniques.index(point["technique"]) % len(COLOURS)]
        name = html.escape(f'{point["technique"]}, {point["culling"]}, {point["layout"]}: {error:.2g}')
        parts.append(f'<circle cx="{x(point["cpuMs"]["median"]):.1f}" cy="{y(max(error, least)):.1f}" r="5" fill="{colour}">'
                     f"<title>{name}</title></circle>")
    for row, technique in enumerate(techniques):
        colour = COLOURS[row % len(COLOURS)]
        parts.append(f'<circle cx="{WIDTH - 170}" cy="{40 + 16 * row}" r="5" fill="{colour}"/>'
                     f'<text x="{WIDTH - 160}" y="{44 + 16 * row}">{html.escape(technique)}</text>')
    return "\n".join([*parts, "</svg>\n"])


def main():
    scene, path, *rest = sys.argv[1:]
    record = tessera.bench(scene, matrix={"layout": ["exact", "packed", "slim"]}, frames=int(rest[0]) if rest else 5,
                           size=rest[1] if len(rest) > 1 else (320, 180))
    points = [point for point in record["points"] if point["error"] and point["error"]["relMse"] is not None]
    with open(path, "w", encoding="utf-8") as file:
        file.write(figure(points, f"{scene} on {record['renderer']}"))
    print(f"{path}: {len(points)} points")
    for advice in record["recommendations"]:
        print(advice["text"])


if __name__ == "__main__":
    main()
