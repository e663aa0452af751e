# SPDX-FileCopyrightText: The sunload authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Rooms of the house and what they include, read from the sources; for scripts/house."""

import collections
import dataclasses
import pathlib
import posixpath
import re
import subprocess

ROOT = pathlib.Path(__file__).resolve().parent.parent
RINGS = ("geo", "solver", "io")  # from the inside out: each may include itself and those before it
SOURCE = re.compile(r"\.(h|hpp|c|cc|cpp|h\.in)$")
INCLUDE = re.compile(r'^\s*#\s*include\s*"([^"]+)"')
EXACT_CIRCLE = 14  # rooms of one circle up to which the best order is found by trying all


def sources_of_work_tree():
    """Path and text of every source."""
    for ring in RINGS:
        for path in sorted((ROOT / ring).rglob("*")):
            if path.is_file() and SOURCE.search(path.name):
                yield path.relative_to(ROOT).as_posix(), path.read_text(encoding="utf-8", errors="replace")


def sources_of_revision(revision):
    """Path and text of every source of a revision."""
    def git(*words, given=None):
        return subprocess.run(("git", "-C", str(ROOT), *words), input=given, stdout=subprocess.PIPE, check=True).stdout

    commit = git("rev-parse", "--verify", "--end-of-options", revision + "^{commit}").decode().strip()
    paths, blobs = [], []
    for entry in git("ls-tree", "-r", "-z", "--full-tree", commit, "--", *RINGS).split(b"\0"):
        if not entry:
            continue
        words, path = entry.split(b"\t", 1)
        kind, blob = words.split()[1:3]
        if kind == b"blob" and SOURCE.search(path.decode()):
            paths.append(path.decode())
            blobs.append(blob)
    given, at = git("cat-file", "--batch", given=b"".join(blob + b"\n" for blob in blobs)), 0
    for path in paths:  # each: name, kind, size, newline; the text; newline
        end = given.index(b"\n", at)
        size = int(given[at:end].split()[2])
        yield path, given[end + 1:end + 1 + size].decode("utf-8", errors="replace")
        at = end + 1 + size + 1


@dataclasses.dataclass
class Room:
    """A folder with sources of its own."""
    name: str
    files: int = 0
    lines: int = 0
    pairs: list = dataclasses.field(default_factory=list)  # headers and sources of one stem
    in_circles: int = 0                                    # pairs that include each other in a circle

    @property
    def ring(self):
        return self.name.split("/")[0]

    @property
    def label(self):
        return self.name.split("/", 1)[-1]


@dataclasses.dataclass
class House:
    rooms: dict     # name: Room
    arrows: dict    # (from, to): ["file:line includes file"]
    back_up: set    # keys of arrows
    heights: dict   # name: 0 for rooms of a ring that include none of its others, and so on
    circles: list   # of pairs, the largest first

    def lines_back_up(self):
        return sum(len(self.arrows[arrow]) for arrow in self.back_up)


def pair_of(path):
    return SOURCE.sub("", path)


def read_house(sources):
    texts = dict(sources)
    rooms, arrows = {}, collections.defaultdict(list)
    between_pairs = {pair_of(path): set() for path in texts}
    for path in sorted(texts):
        folder = posixpath.dirname(path)
        room = rooms.setdefault(folder, Room(folder))
        lines = texts[path].splitlines()
        room.files += 1
        room.lines += len(lines)
        if pair_of(path) not in room.pairs:
            room.pairs.append(pair_of(path))
        for number, line in enumerate(lines, 1):
            found = INCLUDE.match(line)
            if not found:
                continue
            target = found[1] if found[1] in texts else posixpath.normpath(posixpath.join(folder, found[1]))
            if target not in texts:
                continue  # generated
            between_pairs[pair_of(path)].add(pair_of(target))
            if posixpath.dirname(target) != folder:
                arrows[folder, posixpath.dirname(target)].append(f"{path}:{number} includes {target}")
    circles = [circle for circle in circles_of(between_pairs) if len(circle) > 1]
    for circle in circles:
        for pair in circle:
            rooms[posixpath.dirname(pair)].in_circles += 1
    arrows = {key: arrows[key] for key in sorted(arrows)}
    back_up = back_up_of(rooms, arrows)
    return House(rooms, arrows, back_up, heights_of(rooms, arrows, back_up),
                 sorted(circles, key=lambda circle: (-len(circle), circle)))


def circles_of(graph):
    """Strongly connected components (Tarjan 1972), each sorted, in the order of their least member."""
    index, low, stack, found = {}, {}, [], []
    for start in sorted(graph):
        if start in index:
            continue
        work = [(start, iter(sorted(graph[start])))]
        index[start] = low[start] = len(index)
        stack.append(start)
        while work:
            node, rest = work[-1]
            for other in rest:
                if other not in index:
                    index[other] = low[other] = len(index)
                    stack.append(other)
                    work.append((other, iter(sorted(graph[other]))))
                    break
                if other in stack:
                    low[node] = min(low[node], index[other])
            else:
                work.pop()
                if work:
                    low[work[-1][0]] = min(low[work[-1][0]], low[node])
                if low[node] == index[node]:
                    at = stack.index(node)
                    found.append(sorted(stack[at:]))
                    del stack[at:]
    return sorted(found)


def best_order(names, weight):
    """Names from the lowest to the highest, so that the least weight of arrows runs upwards; where that leaves a
    choice, folders below those that they lie in."""
    names = sorted(names, key=lambda name: (-name.count("/"), name))

    def against(placed, name):  # what `name` includes of those that will stand above it
        return sum(weight.get((name, other), 0) for other in names if other != name and other not in placed)

    def ranked(value):
        return value[0], [names.index(name) for name in value[1]]

    if len(names) <= EXACT_CIRCLE:
        best = {frozenset(): (0, ())}
        for _ in names:  # by the number of rooms already placed, from below
            longer = {}
            for placed, (cost, order) in best.items():
                for name in names:
                    if name in placed:
                        continue
                    key, value = placed | {name}, (cost + against(placed, name), order + (name,))
                    if key not in longer or ranked(value) < ranked(longer[key]):
                        longer[key] = value
            best = longer
        return list(best[frozenset(names)][1])
    order = []
    while len(order) < len(names):  # a good order, not always the best one
        order.append(min((name for name in names if name not in order), key=lambda name: against(order, name)))
    return order


def back_up_of(rooms, arrows):
    """Arrows from an inner ring to an outer one, and within a ring those against the best order."""
    back_up = {(a, b) for a, b in arrows if RINGS.index(rooms[a].ring) < RINGS.index(rooms[b].ring)}
    graph = {name: {b for a, b in arrows if a == name and rooms[b].ring == rooms[a].ring} for name in rooms}
    weight = {arrow: len(lines) for arrow, lines in arrows.items()}
    for circle in circles_of(graph):
        if len(circle) > 1:
            order = best_order(circle, weight)
            back_up |= {(a, b) for a, b in arrows if a in order and b in order and order.index(a) < order.index(b)}
    return back_up


def heights_of(rooms, arrows, back_up):
    heights = {}

    def height(name):
        if name not in heights:
            heights[name] = 1 + max((height(b) for a, b in arrows if a == name and (a, b) not in back_up
                                     and rooms[b].ring == rooms[a].ring), default=-1)
        return heights[name]
    for name in sorted(rooms):
        height(name)
    return heights


def drawn_arrows(house):
    """Arrows that do not follow from others (transitive reduction), and all that run back up."""
    forward = {name: {b for a, b in house.arrows if a == name and (a, b) not in house.back_up} for name in house.rooms}
    reached = {}

    def reach(name):
        if name not in reached:
            reached[name] = set().union(*({other} | reach(other) for other in sorted(forward[name])))
        return reached[name]
    kept = [(a, b) for a in sorted(forward) for b in sorted(forward[a])
            if not any(b in reach(other) for other in forward[a] if other != b)]
    return kept + sorted(house.back_up)


def thin(number):
    """1234567 as 1 234 567."""
    return f"{number:,}".replace(",", "\u202f")


def counts(files, lines):
    return f"{thin(files)} file{'s' if files != 1 else ''}, {thin(lines)} lines"


def totals(house):
    """What the last lines of both table and picture say."""
    within = sum(len(lines) for lines in house.arrows.values())
    texts = [f"{counts(sum(r.files for r in house.rooms.values()), sum(r.lines for r in house.rooms.values()))} "
             f"in {len(house.rooms)} rooms; {thin(within)} include lines from room to room, "
             f"{len(house.arrows)} arrows.",
             f"Back up: {house.lines_back_up()} include lines, {len(house.back_up)} arrows."]
    if house.circles:
        texts.append(f"Headers and sources (one pair per stem) in circles: {sum(map(len, house.circles))}, "
                     f"the largest circle has {len(house.circles[0])}.")
    else:
        texts.append("No headers and sources include each other in a circle.")
    return texts


def from_top(house, names):
    """Rooms from the outermost ring inwards, in each from the highest down."""
    return sorted(names, key=lambda n: (-RINGS.index(house.rooms[n].ring), -house.heights[n], n))
