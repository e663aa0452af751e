# SPDX-FileCopyrightText: The sunload authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The picture of the house: rooms in rows, what includes above what it includes; for scripts/house.

Sugiyama, Tagawa & Toda (1981), Methods for visual understanding of hierarchical system structures: rows by height,
lanes where an arrow passes a row, rows ordered by the mean place of neighbours, then places by least squares.
"""

import collections
import dataclasses
import html
import posixpath

from house_rooms import RINGS, counts, drawn_arrows, from_top, thin, totals

COLOURS = {"geo": ("#e9f3e4", "#5d8a4a"), "solver": ("#fdf3da", "#b08a2e"), "io": ("#e6eef8", "#4a6f9c")}
INK, GREY, PALE, RED = "#1f2933", "#6b7785", "#a3adb8", "#c0182b"  # pale: from ring to ring
FONT = "font-family=\"DejaVu Sans, Verdana, Arial, sans-serif\""
NAME, SMALL, TITLE = 14, 11, 17       # sizes of letters
MARGIN, HEAD = 28, 64                 # about everything, above the first ring
BETWEEN, BETWEEN_RINGS = 36, 36       # rows of one ring, added between two rings
BESIDE, LANE = 22, 12                 # boxes of a row, arrows that pass it
COLUMNS = 6                           # of names in the box of a flat ring


def width_of(text, size):
    """At least what DejaVu Sans, a wide font, takes."""
    return sum(0.36 if c in "ijlftI.,:;'|()/ -\u202f" else 0.98 if c in "mwMW" else 0.68 for c in text) * size


@dataclasses.dataclass
class Spot:
    """A box, or a place where an arrow passes a row."""
    name: str
    row: int
    wide: float = LANE
    high: float = 0
    x: float = 0     # middle
    y: float = 0     # top
    lists: list = dataclasses.field(default_factory=list)  # names of the files in a flat ring

    @property
    def is_box(self):
        return self.high > 0


def box_of(house, name, row):
    room = house.rooms[name]
    texts = [(room.label, NAME), (counts(room.files, room.lines), SMALL)]
    spot = Spot(name, row, high=50)
    if [other for other in house.rooms.values() if other.ring == room.ring] == [room]:
        spot.lists = sorted(posixpath.relpath(pair, name) for pair in room.pairs)
        if room.in_circles:
            texts.append((circles_text(room), SMALL))
    column = max((width_of(text, SMALL) for text in spot.lists), default=0) + 10
    spot.wide = max(max(width_of(*text) for text in texts) + 24, column * COLUMNS + 24 if spot.lists else 0)
    if spot.lists:
        spot.high = 60 + 15 * -(-len(spot.lists) // COLUMNS) + (16 if room.in_circles else 0)
    return spot


def circles_text(room):
    return f"{len(room.pairs)} headers and sources of one stem, {room.in_circles} of them in circles"


def crossings(rows, links):
    """Of links between neighbouring rows."""
    total = 0
    place = {spot.name: at for row in rows for at, spot in enumerate(row)}
    for row in rows:
        names = {spot.name for spot in row}
        ends = sorted((place[a], place[b]) for a, b in links if a in names)
        total += sum(1 for i, (_, low) in enumerate(ends) for _, other in ends[i + 1:] if other < low)
    return total


def untangled(rows, links):
    """Rows in an order with few crossings: each by the mean place of its neighbours, down and up in turn."""
    above, below = collections.defaultdict(list), collections.defaultdict(list)
    for a, b in links:
        below[a].append(b)
        above[b].append(a)
    best, fewest = [list(row) for row in rows], crossings(rows, links)
    for turn in range(48):
        neighbours = below if turn % 2 else above
        for row in (reversed(rows) if turn % 2 else rows):
            place = {spot.name: (at + 0.5) / len(other) for other in rows for at, spot in enumerate(other)}

            def mean(spot):
                near = [place[name] for name in neighbours[spot.name]]
                return (sum(near) / len(near) if near else place[spot.name], place[spot.name])
            row.sort(key=mean)
        now = crossings(rows, links)
        if now < fewest:
            best, fewest = [list(row) for row in rows], now
    return best


def spread(row, wanted):
    """Places of a row nearest to those wanted (least squares) without overlap: pool adjacent violators. Lanes count
    more than boxes, so that long arrows are straight."""
    offsets, at = [], 0.0
    for i, spot in enumerate(row):
        if i:
            both = row[i - 1].is_box and spot.is_box
            at += (row[i - 1].wide + spot.wide) / 2 + (BESIDE if both else LANE)
        offsets.append(at)
    pools = []  # [sum of weighted targets, weight, number]
    for spot, target, offset in zip(row, wanted, offsets):
        weight = 1.0 if spot.is_box else 3.0
        pools.append([(target - offset) * weight, weight, 1])
        while len(pools) > 1 and pools[-2][0] / pools[-2][1] > pools[-1][0] / pools[-1][1]:
            last = pools.pop()
            pools[-1] = [a + b for a, b in zip(pools[-1], last)]
    i = 0
    for total, weight, number in pools:
        for _ in range(number):
            row[i].x = total / weight + offsets[i]
            i += 1


def placed(rows, links):
    """Middles of boxes and lanes."""
    spots = {spot.name: spot for row in rows for spot in row}
    near = collections.defaultdict(list)  # (name, weight)
    for a, b in links:
        weight = (1, 2, 8)[(not spots[a].is_box) + (not spots[b].is_box)]
        near[a].append((b, weight))
        near[b].append((a, weight))

    def wanted(spot):
        some = near[spot.name] or [(spot.name, 1)]
        return sum(spots[name].x * weight for name, weight in some) / sum(weight for _, weight in some)
    for row in rows:
        spread(row, [0.0] * len(row))
    for turn in range(400):
        for row in (rows if turn % 2 else reversed(rows)):
            spread(row, [wanted(spot) for spot in row])
    left = min(spot.x - spot.wide / 2 for spot in spots.values())
    for spot in spots.values():
        spot.x += MARGIN + 110 - left
    return spots


def laid_out(house):
    """Spots by name, rows, and every drawn arrow with the names of the spots it passes, from above to below."""
    rows, row_of = [], {}
    for name in from_top(house, house.rooms):
        key = (house.rooms[name].ring, house.heights[name])
        if not rows or rows[-1][0] != key:
            rows.append((key, []))
        row_of[name] = len(rows) - 1
        rows[-1][1].append(box_of(house, name, row_of[name]))
    rows = [row for _, row in rows]
    ways, links = [], []
    for arrow in drawn_arrows(house):
        high, low = sorted(arrow, key=lambda name: row_of[name])
        way = [high]
        for row in range(row_of[high] + 1, row_of[low]):
            lane = Spot(f"{arrow[0]}>{arrow[1]}@{row}", row)
            rows[row].append(lane)
            way.append(lane.name)
        way.append(low)
        ways.append((arrow, way))
        links += zip(way, way[1:])
    rows = untangled(rows, links)
    spots = placed(rows, links)
    y = HEAD + MARGIN
    for at, row in enumerate(rows):
        boxes = [spot for spot in row if spot.is_box]
        if at and ring_of(house, rows[at - 1]) != ring_of(house, row):
            y += BETWEEN_RINGS
        for spot in row:
            spot.y = y
        y += max(spot.high for spot in boxes) + BETWEEN
    return spots, rows, ways


def ring_of(house, row):
    return next(house.rooms[spot.name].ring for spot in row if spot.is_box)


def number(value):
    return f"{value:.1f}".rstrip("0").rstrip(".")


def text_at(x, y, text, size=SMALL, colour=INK, anchor="start", bold=False):
    weight = ' font-weight="bold"' if bold else ""
    return (f'<text x="{number(x)}" y="{number(y)}" font-size="{size}" fill="{colour}" text-anchor="{anchor}"{weight}>'
            f"{html.escape(text)}</text>")


def ends_of(ways, spots):
    """Where each way leaves its upper and meets its lower box: side by side, in the order of where they go."""
    upper, lower = collections.defaultdict(list), collections.defaultdict(list)
    for at, (_, way) in enumerate(ways):
        upper[way[0]].append((spots[way[1]].x, at))
        lower[way[-1]].append((spots[way[-2]].x, at))
    places = {}
    for side, ends in (("upper", upper), ("lower", lower)):
        for name, some in ends.items():
            box = spots[name]
            step = min(18.0, (box.wide - 24) / max(len(some) - 1, 1))
            for place, (_, at) in enumerate(sorted(some)):
                places[at, side] = box.x + (place - (len(some) - 1) / 2) * step
    return places


def arrow_svg(house, arrow, way, spots, rows, start, end):
    """A line from box to box, by the lanes in between; the head is where the included room is."""
    row_high = [max(spot.high for spot in row) for row in rows]
    points = [(start, spots[way[0]].y + spots[way[0]].high)]
    for name in way[1:-1]:
        lane = spots[name]
        points += [(lane.x, lane.y), (lane.x, lane.y + row_high[lane.row])]
    points.append((end, spots[way[-1]].y))
    back = arrow in house.back_up
    upwards = arrow[0] != way[0]
    if upwards:
        points.reverse()
    path = f"M{number(points[0][0])} {number(points[0][1])}"
    for i in range(0, len(points) - 1):
        (x0, y0), (x1, y1) = points[i], points[i + 1]
        if abs(x1 - x0) < 0.05:
            path += f" V{number(y1)}"
        else:
            bend = (y1 - y0) * 0.5
            path += f" C{number(x0)} {number(y0 + bend)} {number(x1)} {number(y1 - bend)} {number(x1)} {number(y1)}"
    lines = house.arrows[arrow]
    wide = 1.1 + min(len(lines), 40) / 16
    within = house.rooms[arrow[0]].ring == house.rooms[arrow[1]].ring
    colour, head = (RED, "back") if back else (GREY, "head") if within else (PALE, "down")
    told = "\n".join([f"{arrow[0]} → {arrow[1]}: {len(lines)} include lines", *(lines if back else [])])
    return (f'<path d="{path}" fill="none" stroke="{colour}" stroke-width="{number(wide)}" '
            f'marker-end="url(#{head})"><title>{html.escape(told)}</title></path>')


def box_svg(house, spot):
    room, (fill, edge) = house.rooms[spot.name], COLOURS[house.rooms[spot.name].ring]
    left = spot.x - spot.wide / 2
    out = [f'<rect x="{number(left)}" y="{number(spot.y)}" width="{number(spot.wide)}" height="{number(spot.high)}" '
           f'rx="6" fill="#ffffff" stroke="{edge}" stroke-width="1.4"/>',
           text_at(spot.x, spot.y + 21, room.label, NAME, anchor="middle", bold=True),
           text_at(spot.x, spot.y + 39, counts(room.files, room.lines), colour=GREY, anchor="middle")]
    if spot.lists:
        y = spot.y + 56
        if room.in_circles:
            out.append(text_at(spot.x, y, circles_text(room), colour=RED, anchor="middle"))
            y += 16
        high = -(-len(spot.lists) // COLUMNS)
        column = (spot.wide - 24) / COLUMNS
        for at, name in enumerate(spot.lists):
            out.append(text_at(left + 14 + at // high * column, y + 8 + at % high * 15, name, colour=edge))
    return out


def foot_lines(house):
    """Legend's words: [(text, colour)]."""
    lines = [(text, RED if text.startswith("Back up") and house.back_up else INK) for text in totals(house)]
    arrows = sorted(house.back_up, key=lambda arrow: (-len(house.arrows[arrow]), arrow))
    shown = [f"{a} → {b}: {len(house.arrows[a, b])}" for a, b in arrows]
    return lines + [("    " + text, RED) for text in shown]


def picture(house, title):
    spots, rows, ways = laid_out(house)
    foot = foot_lines(house)
    right = max(spot.x + spot.wide / 2 for spot in spots.values()) + MARGIN
    words = max(width_of(text, SMALL) for text, _ in foot) + 2 * MARGIN
    width = max(right + 12, words, 760)
    shift = (width - 12 - right) / 2  # what stands to the right of the rings' names is centred
    for spot in spots.values():
        spot.x += shift
    body, bottom = [], 0
    for ring in reversed(RINGS):
        mine = [spot for row in rows for spot in row if ring_of(house, row) == ring]
        if not mine:
            continue
        top = mine[0].y - 22
        bottom = max(spot.y + spot.high for spot in mine) + 22
        fill, edge = COLOURS[ring]
        rooms = [room for room in house.rooms.values() if room.ring == ring]
        body.append(f'<rect x="12" y="{number(top)}" width="{number(width - 24)}" height="{number(bottom - top)}" '
                    f'rx="10" fill="{fill}"/>')
        body.append(text_at(26, top + 26, ring + "/", TITLE, edge, bold=True))
        for at, text in enumerate((f"{len(rooms)} room" + ("s" if len(rooms) > 1 else ""),
                                   *counts(sum(r.files for r in rooms), sum(r.lines for r in rooms)).split(", "))):
            body.append(text_at(26, top + 45 + 15 * at, text, colour=GREY))
    places = ends_of(ways, spots)
    for at, (arrow, way) in enumerate(ways):
        body.append(arrow_svg(house, arrow, way, spots, rows, places[at, "upper"], places[at, "lower"]))
    for row in rows:
        for spot in row:
            if spot.is_box:
                body += box_svg(house, spot)
    y = bottom + 34
    body.append(f'<path d="M26 {number(y - 4)} H66" stroke="{GREY}" stroke-width="1.6" marker-end="url(#head)"/>')
    body.append(text_at(82, y, "includes; the thicker, the more lines; an arrow that follows from others is left out"))
    for colour, head, words in ((PALE, "down", "the same, from ring to ring"),
                                (RED, "back", "runs back up: against the rings, or the order of rooms in a ring")):
        y += 18
        body.append(f'<path d="M26 {number(y - 4)} H66" stroke="{colour}" stroke-width="1.6" '
                    f'marker-end="url(#{head})"/>')
        body.append(text_at(82, y, words))
    y += 28
    for text, colour in foot:
        body.append(text_at(26, y, text, colour=colour))
        y += 17
    high = y + 6
    heads = "".join(f'<marker id="{name}" markerUnits="userSpaceOnUse" markerWidth="9" markerHeight="9" refX="8" '
                    f'refY="4" orient="auto"><path d="M0 0 L9 4 L0 8 z" fill="{colour}"/></marker>'
                    for name, colour in (("head", GREY), ("down", PALE), ("back", RED)))
    return "\n".join([
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{number(width)}" height="{number(high)}" '
        f'viewBox="0 0 {number(width)} {number(high)}" {FONT}>',
        f"<title>{html.escape(title)}</title>", f"<defs>{heads}</defs>",
        f'<rect width="{number(width)}" height="{number(high)}" fill="#ffffff"/>',
        text_at(26, 36, title, TITLE + 3, bold=True),
        text_at(26, 56, "What includes stands above what it includes.", colour=GREY),
        *body, "</svg>", ""])
