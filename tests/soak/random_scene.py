# SPDX-FileCopyrightText: The sunload authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A random scene: its files, the section `scene` of the study, and how large it is."""

import math
import os

import scene_files
import shapes

# Map projections with a place of theirs: x, y [m].
MAPS = [("EPSG:25833", 383000, 5511800), ("EPSG:28992", 85000, 446000), ("EPSG:2056", 2600000, 1200000),
        ("EPSG:32756", 334000, 6251000), ("EPSG:3031", 100000, 1500000)]
# Name, parameters, about how wide it is [m], area of all faces [m²].
BUILTIN = [("box_on_plane", {}, 60, 7684), ("canyon", {"height": 12, "width": 15, "length": 60}, 60, 7604),
           ("room", {}, 6, 216), ("cylinder", {}, 32, 2232), ("shadow", {}, 20, 1008), ("emission", {}, 24, 1197),
           ("windows", {}, 40, 3985), ("city", {"triangles": 300}, 60, 8179)]
# A file's colour of the materials that VRML has to tell: diffuse, specular.
GREYS = {"mirror": (0.05, 0.85), "dark": (0.0, 0.0), "light": (0.8, 0.0)}


def random_material(random, kind, allowed):
    """`allowed` has the kinds that the study may hold: emission, bands."""
    share = lambda least, most: round(random.uniform(least, most), 3)
    if kind == "mirror":
        return {"diffuse": share(0, 0.1), "mirror": share(0.2, 0.9)}
    if kind == "glossy":
        return {"diffuse": share(0, 0.3), "glossy": share(0.1, 0.6), "glossy_exponent": random.choice([3, 30, 1000])}
    if kind == "glass":
        return {"diffuse": random.choice([0, 0.02]), "refractive_index": 1.52, "panes": random.choice([1, 2, 3]),
                "absorption_per_m": random.choice([0, 20])}
    if kind == "metal":
        return {"diffuse": 0, "refractive_index": 1.44, "extinction_coefficient": 5.23}
    if kind == "clear":
        return {"diffuse": 0, "normal_transmittance": share(0.3, 0.75), "mirror": share(0, 0.2)}
    if kind == "crown":
        return {"diffuse": share(0.05, 0.3), "transmittance": share(0.05, 0.7), "sides": "two"}
    if kind == "lamp" and "emission" in allowed:
        return {"diffuse": share(0, 0.5), "emission_w_m2": random.choice([0.5, 50, 5000])}
    if kind == "lamp" and "lumens" in allowed:
        return {"diffuse": share(0, 0.5), "emission_lm_m2": random.choice([1, 500, 1e5])}
    if kind == "two":
        return {"diffuse": share(0, 0.9), "sides": "two"}
    if kind == "colour" and "bands" in allowed:
        return {"diffuse": [share(0, 1), share(0, 1), share(0, 1)]}
    if kind == "dark":
        return {"diffuse": 0}
    return {"diffuse": random.choice([share(0, 1), share(0.1, 0.5), 0.95])}


def body(random, size):
    """Name and faces of a body that stands on z = 0, about as wide as `size`."""
    of = lambda least, most: random.uniform(least, most) * size
    return random.choice([
        lambda: ("box", shapes.box(of(0.4, 1), of(0.4, 1), of(0.3, 2))),
        lambda: ("slab", shapes.box(of(0.8, 1.2), of(0.02, 0.1), of(0.5, 1.5))),
        lambda: ("house", shapes.gabled(of(0.6, 1), of(0.5, 0.9), of(0.3, 0.6), of(0.7, 1))),
        lambda: ("court", shapes.court(of(0.9, 1.2), of(0.9, 1.2), of(0.3, 1.2), random.uniform(0.3, 0.8))),
        lambda: ("tower", shapes.tower(of(0.2, 0.4), of(1, 3), random.choice([3, 5, 8]))),
        lambda: ("rock", shapes.tetrahedron(of(0.4, 0.8)))])()


# Ways to put bodies that leave two fronts in one place: undersides in one plane, bodies twice.
COINCIDENT = ("meeting", "nested", "twice")


def arrangement(random, size, count, way):
    """Bodies as (name, faces) on z = 0 that stand apart, touch, meet, hover, lie in one another."""
    bodies, x = [], 0.0
    columns = math.ceil(math.sqrt(count))
    for k in range(count):
        name, faces = body(random, size)
        turn = random.choice([0, 0, 90, random.uniform(0, 360)])
        move = (0.0, 0.0, 0.0)
        if way == "apart":
            move = (k % columns * 1.8 * size, k // columns * 1.8 * size, random.choice([0.0, 0.0, 0.0, 0.2 * size]))
        elif way == "row":  # walls against walls, to the last bit or nearly
            turn = 0
            half = max(p[0] for _, corners in faces for p in corners)
            low = min(p[0] for _, corners in faces for p in corners)
            move, x = (x - low, 0.0, 0.0), x + half - low + random.choice([0.0, 0.0, 1e-4 * size])
        elif way == "piled":
            move = (0.0, 0.0, x)
            x += max(p[2] for _, corners in faces for p in corners) + random.choice([0.0, 0.0, 0.01 * size])
        elif way == "meeting":
            move = (k * 0.6 * size, 0.3 * random.uniform(-1, 1) * size, random.choice([0.0, -0.2 * size]))
        elif way == "nested":
            faces = [(kind, [tuple(c * 0.7 ** k for c in p) for p in corners]) for kind, corners in faces]
        elif way == "twice":
            if k % 2 == 1:
                bodies.append((f"{bodies[-1][0]}_again", bodies[-1][1]))
                continue
            move = (k * size, 0.0, 0.0)
        bodies.append((f"{name}_{k + 1}", shapes.placed(faces, turn, 0, move)))
    return bodies


def extras(random, size, reach):
    """What is no building: crowns, screens, tilted plates, loose triangles."""
    found = []
    for k in range(random.choice([0, 0, 0, 1, 2])):
        at = (random.uniform(-0.5, 0.5) * reach, random.uniform(-0.5, 0.5) * reach, random.uniform(0, 1) * size)
        turn, tilt = random.uniform(0, 360), random.choice([0, 30, 90, 180, random.uniform(0, 360)])
        kind, faces = random.choice([
            lambda: ("crown", shapes.crown(0.3 * size, size)), lambda: ("screen", shapes.screen(size, 0.6 * size)),
            lambda: ("plate", shapes.plate(size, 0.5 * size)), lambda: ("soup", shapes.soup(random, 6, size))])()
        found.append((f"{kind}_{k + 1}", shapes.placed(faces, turn, 0 if kind == "crown" else tilt, at)))
    return found


def dirt(random, objects, is_repaired):
    """What bad models have: faces turned, twice, without area, thin or not plane."""
    kinds = ["turned", "bent", "gone", *(["twice", "degenerate", "thin"] if is_repaired else [])]
    for _, faces in objects:
        k = random.randrange(len(faces))
        kind, corners = faces[k]
        what = random.choice(kinds)
        if what == "turned":
            faces[k] = (kind, corners[::-1])
        elif what == "twice":
            faces.append((kind, list(corners)))
        elif what == "degenerate":
            faces.append((kind, [corners[0], corners[1], corners[0]]))
        elif what == "thin":
            faces.append((kind, [corners[0], corners[1], tuple(c + 1e-7 for c in corners[0])]))
        elif what == "bent" and len(corners) > 3:
            faces[k] = (kind, [*corners[:-1], tuple(c * 1.01 for c in corners[-1])])
        elif what == "gone" and len(faces) > 4:
            del faces[k]


class RandomScene:
    """`section` is that of the study; `low` and `high` bound what the files hold, in the scene's frame;
    `area_m2` with the ground; `city` names a CityJSON file, `crs` the map. Where the scene `is_sound` no two
    fronts lie in one place, nor a front and the inside of a floor: each of two would send on the light that
    falls on the place."""

    def __init__(self, random, folder, allowed):
        self.random, self.folder, self.allowed = random, folder, allowed
        self.crs, self.city, self.is_sound, self.has_plate = None, None, True, False
        self.extent = 10 ** random.choice([random.uniform(0, 3.7), random.uniform(1.3, 2.3)])
        self.section = {"repair": random.choice(["safe", "safe", "safe", "none", "all"]), "materials": {}}
        random.choice([self.builtin, self.raster, self.city_model, *[self.bodies] * 7])()
        self.ground()
        if random.random() < 0.1:
            self.section["orient"] = "keep"

    def builtin(self):
        shining = ("room", "emission", "shadow")
        name, parameters, self.extent, self.area_m2 = self.random.choice(
            [b for b in BUILTIN if "emission" in self.allowed or b[0] not in shining])
        self.section["builtin"] = {"name": name, **parameters}
        self.low, self.high = (0.0, 0.0, 0.0), (self.extent, self.extent, 0.4 * self.extent)

    def raster(self):
        """A terrain, or surface, terrain and crowns of a town."""
        random, count = self.random, self.random.choice([4, 7, 10])
        cell = max(0.01, self.extent / count)
        ground = [[round(0.05 * self.extent * math.sin(0.3 * i + 0.5 * j), 3) for i in range(count)] for j in range(count)]
        self.low, self.high = (0.0, 0.0, -0.05 * self.extent), (self.extent, self.extent, 0.5 * self.extent)
        self.area_m2 = 3 * self.extent ** 2
        scene_files.write_raster(os.path.join(self.folder, "ground.asc"), ground, cell)
        files = {"file": "ground.asc"}
        if random.random() < 0.7:
            roofs = [[h + random.choice([0, 0, 0, max(2.5, 0.3 * self.extent)]) for h in row] for row in ground]
            scene_files.write_raster(os.path.join(self.folder, "roofs.asc"), roofs, cell)
            files = {"file": "roofs.asc", "terrain": "ground.asc"}
            if random.random() < 0.5:
                crowns = [[random.choice([0, 0, 0, 0, 6]) for _ in row] for row in ground]
                scene_files.write_raster(os.path.join(self.folder, "crowns.asc"), crowns, cell)
                files["canopy"] = "crowns.asc"  # whose sides lie against walls
                self.is_sound = False
        self.section["files"] = [files]

    def model(self, objects, materials):
        """Objects with a material for every face, by its kind."""
        of_kind = {kind: self.random.choice(materials) for kind in ("wall", "roof", "floor", "ground", "other")}
        model = []
        for name, faces in objects:
            own = "crown" if name.startswith("crown") else self.random.choice([None, None, *materials])
            model.append((name, [(own or of_kind[kind], kind, corners) for kind, corners in faces]))
        return model

    def materials(self, count):
        kinds = ["matt", "matt", "matt", "dark", "two", "colour", "mirror", "glossy", "glass", "metal", "clear", "lamp"]
        if self.random.random() < 0.4:
            kinds = kinds[:6]
        names = []
        for k in range(count):
            kind = self.random.choice(kinds)
            names.append(f"{kind}_{k}")
            self.section["materials"][names[-1]] = random_material(self.random, kind, self.allowed)
        self.section["materials"]["crown"] = random_material(self.random, "crown", self.allowed)
        self.is_sound &= not any(name.startswith("two") for name in names)
        return names

    def arrangement(self, size, count):
        way = self.random.choice(["apart", "apart", "apart", "row", "row", "piled", "piled", *COINCIDENT])
        self.is_sound &= count == 1 or way not in COINCIDENT
        return arrangement(self.random, size, count, way)

    def moved(self, objects, offset):
        return [(name, shapes.placed(faces, move=offset)) for name, faces in objects]

    def measure(self, objects):
        corners = [c for _, faces in objects for _, face in faces for c in face]
        self.low = tuple(min(c[axis] for c in corners) for axis in range(3))
        self.high = tuple(max(c[axis] for c in corners) for axis in range(3))
        self.area_m2 = sum(shapes.area(face) for _, faces in objects for _, face in faces)

    def offset(self):
        random = self.random
        if random.random() < 0.25:
            self.crs, x, y = random.choice(MAPS)
            return (float(x), float(y), random.choice([0.0, 310.0]))
        return random.choice([(0.0, 0.0, 0.0), (0.0, 0.0, 0.0), (-1234.5, 777.25, 250.0), (4.5e6, 5.5e6, 0.0)])

    def city_model(self):
        """Buildings and trees of a city model."""
        random = self.random
        size = self.extent / 5
        objects = [*self.arrangement(size, random.choice([1, 3, 6])),
                   ("hall", shapes.placed(shapes.box(size, size, size), move=(-2 * size, 0.0, 0.0)))]
        objects = [(name, faces) for name, faces in objects if not name.startswith("rock")]
        if random.random() < 0.4:
            objects.append(("crown_1", shapes.placed(shapes.crown(0.3 * size, size), move=(-size, -size, 0.1 * size))))
        objects = self.moved(objects, self.offset())
        self.measure(objects)
        names = self.materials(2)
        self.section["assign"] = [{"surface": "wall", "material": names[0]}, {"surface": "roof", "material": names[1]},
                                  {"object": "crown_*", "material": "crown"}]
        self.city = os.path.join(self.folder, "town.city.json")
        in_file = self.crs if random.random() < 0.5 else None
        scene_files.write_cityjson(self.city, self.model(objects, names), in_file, random.random() < 0.8)
        self.section["files"] = ["town.city.json"]

    def bodies(self):
        random = self.random
        size = self.extent / random.choice([2, 4, 8])
        objects = self.arrangement(size, random.choice([1, 1, 2, 3, 5, 9])) if random.random() < 0.9 else []
        objects += extras(random, size, self.extent)
        if not objects or random.random() < 0.1:
            objects.append(("soup_0", shapes.soup(random, random.choice([5, 30]), self.extent)))
        way = random.choice(["plate", "plate", "land", "none"])
        if way == "plate":
            objects.append(("land", shapes.placed(shapes.plate(1.5 * self.extent, 1.5 * self.extent),
                                                  move=(0.3 * self.extent, 0.3 * self.extent, random.choice([0.0, -0.01, -0.1 * size])))))
        elif way == "land":
            slope, relief = random.choice([0.0, 0.1, 1.0]), random.choice([0.0, 0.05 * self.extent])
            height = lambda x, y: slope * x + relief * math.sin(6 * y / self.extent)
            objects.append(("land", shapes.land(1.5 * self.extent, random.choice([1, 3, 5]), height)))
        if random.random() < 0.15:
            dirt(random, objects, self.section["repair"] != "none")
        self.has_plate = way != "none"
        objects = self.moved(objects, self.offset())
        self.measure(objects)
        self.write(objects)

    def write(self, objects):
        """As files of some format."""
        random = self.random
        names = self.materials(random.choice([1, 2, 4]))
        model = self.model(objects, names)
        unit_m, up = random.choice([1, 1, 1, 0.001, 0.3048]), random.choice(["z", "z", "y", "x"])
        form = random.choice(["obj", "obj", "obj", "ply", "stl", "off", "wrl"])
        if form in ("stl", "wrl") and max(map(abs, (*self.low, *self.high))) > 1000 * self.extent:
            form = "obj"  # the others, or Coin, which reads them, have floats
        if form == "obj":
            self.write_obj(model, up, unit_m)
        elif form == "wrl":
            self.write_vrml(model, names, up, unit_m)
        else:
            getattr(scene_files, f"write_{form}")(os.path.join(self.folder, f"scene.{form}"), model, up, unit_m)
            self.section["files"] = [f"scene.{form}"]
            self.section["assign"] = [{"surface": s, "material": m} for s, m in zip(("wall", "roof", "ground"), names)]
        if unit_m != 1:
            self.section["unit_m"] = unit_m
        if up != "z" or form == "wrl":
            self.section["up"] = up
        if "emission" in self.allowed and random.random() < 0.08:
            self.parallel_sources(up, unit_m)

    def luminaires(self):
        """Points in and above the scene: a maker's photometry, spots, bare lamps, a row."""
        random = self.random
        with open(os.path.join(self.folder, "lamp.ies"), "w") as file:
            file.write("IESNA:LM-63-2002\nTILT=NONE\n1 1000 1 3 3 1 2 0 0 0\n1 1 40\n0 45 90\n0 30 90\n"
                       "100 90 0\n100 60 10\n100 80 0\n")
        self.section["luminaires"] = []
        for _ in range(random.choice([1, 1, 3])):
            at = [round(random.uniform(low, high), 3) for low, high in zip(self.low, self.high)]
            at[2] = round(self.high[2] + random.uniform(-0.5, 1) * 0.5 * self.extent, 3)
            lamp = {"position_m": at, **random.choice([{"file": "lamp.ies"}, {"file": "lamp.ies", "flux_lm": 5000},
                                                       {"intensity_cd": 300, "beam_deg": random.choice([20, 90, 200])},
                                                       {"flux_lm": 2000}])}
            if random.random() < 0.4:
                lamp.update(towards=[round(random.gauss(0, 1), 2), round(random.gauss(0, 1), 2), -1], turn_deg=random.randint(-180, 180))
            if random.random() < 0.2:
                lamp.update(to_m=[at[0] + self.extent, at[1], at[2]], every_m=max(0.01, round(self.extent / 3, 3)))
            self.section["luminaires"].append(lamp)

    def write_obj(self, model, up, unit_m):
        """One file, or two."""
        parts = [model] if len(model) < 2 or self.random.random() < 0.8 else [model[::2], model[1::2]]
        self.section["files"] = [f"scene_{k}.obj" for k in range(len(parts))]
        for name, part in zip(self.section["files"], parts):
            scene_files.write_obj(os.path.join(self.folder, name), part, up, unit_m)

    def write_vrml(self, model, names, up, unit_m):
        """With colours of its own in place of the study's materials."""
        emits = "emission" in self.allowed and self.random.random() < 0.2
        colours = {n: (*GREYS.get(n.split("_")[0], (0.4, 0.0)), float(emits and n == names[0])) for n in [*names, "crown"]}
        scene_files.write_vrml(os.path.join(self.folder, "scene.wrl"), model, up, unit_m, colours)
        self.section.update(files=["scene.wrl"], materials={}, emission_scale_w=self.random.choice([1, 1e4]))

    def parallel_sources(self, up, unit_m):
        """A panel above all that shines down, as a second file."""
        x, y = ((self.low[axis] + self.high[axis]) / 2 for axis in range(2))
        panel = shapes.placed(shapes.plate(0.5 * self.extent, 0.5 * self.extent), 0, 180,
                              (x, y, self.high[2] + self.extent))
        self.section["materials"]["panel"] = {"diffuse": 0, "emission_w_m2": 100}
        scene_files.write_obj(os.path.join(self.folder, "lamps.obj"),
                              [("panel", [("panel", kind, corners) for kind, corners in panel])], up, unit_m)
        self.section["parallel_sources"] = "lamps.obj"

    def ground(self):
        random = self.random
        if "builtin" in self.section or random.random() < (0.2 if self.city else 0.75 if self.has_plate else 0.4):
            if self.city:
                self.area_m2 += (100 + 3 * self.extent) ** 2
            return
        surface = random.choice(["feet", "feet", "level", "none"])
        self.is_sound &= surface == "none" or not self.has_plate
        if surface == "none":
            self.section["ground"] = random.choice(["none", {"surface": "none"}])
            return
        margin = random.choice([0, 0.1, 1]) * self.extent
        self.section["ground"] = {"surface": surface, "margin_m": margin}
        if surface == "level" and random.random() < 0.5:
            self.section["ground"]["height_m"] = self.low[2] + random.choice([0, -0.1, 0.05]) * self.extent
        width = max(self.high[axis] - self.low[axis] for axis in range(2))
        self.area_m2 += (width + 2 * margin) ** 2
